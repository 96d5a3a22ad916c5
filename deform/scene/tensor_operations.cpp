/// Operations that make Bézier, B-spline, NURBS and hierarchical lattices.

#include <algorithm>
#include <array>
#include <utility>

#include "deform/scene/fitting.h"
#include "deform/scene/index_list.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

using Type = ParameterType;
using Integers = std::vector<std::int64_t>;

constexpr int kUsualDegree = 3;

/// The numbers of a parameter, one an axis, each from `least` to `most`.
std::array<int, 3> axis_numbers(const Arguments& arguments, const std::string& name, int least,
                                int most) {
  const Integers numbers = arguments.integers(name);
  std::array<int, 3> result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (numbers[axis] < least || numbers[axis] > most) {
      throw ParameterError("'" + name + "' must be three numbers from " + std::to_string(least) +
                           " to " + std::to_string(most));
    }
    result[axis] = static_cast<int>(numbers[axis]);
  }
  return result;
}

std::array<int, 3> counts_of(const Arguments& arguments) {
  return axis_numbers(arguments, "counts", 1, kMostControlsOnAxis);
}

/// Three where nothing else is asked for, or what the control points allow.
std::array<int, 3> degree_of(const Arguments& arguments, const std::array<int, 3>& counts) {
  if (arguments.has("degree")) {
    return axis_numbers(arguments, "degree", 0, kMostDegree);
  }
  std::array<int, 3> degree{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    degree[axis] = std::min(kUsualDegree, counts[axis] - 1);
  }
  return degree;
}

/// One word for all axes, or three with commas between.
std::array<Ends, 3> ends_of(const Arguments& arguments) {
  const std::string& text = arguments.text("ends");
  std::vector<Ends> ends;
  for (const std::string& word : words_between(text, ',')) {
    const auto named = ends_named(word);
    if (!named || *named == Ends::Explicit) {
      ends.clear();
      break;
    }
    ends.push_back(*named);
  }
  if (ends.size() != 1 && ends.size() != 3) {
    throw ParameterError("'ends' is " + quoted(text) +
                         ", must be open, uniform, natural, tripled or periodic, or three of these "
                         "with commas between, one an axis");
  }
  return {ends.front(), ends[ends.size() / 2], ends.back()};
}

/// One control point is an axis of its own.
TensorAxis axis_of(int axis, int n_controls, int degree, Ends ends) {
  if (n_controls == 1 && degree == 0) {
    return {};
  }
  try {
    return TensorAxis::make(n_controls, degree, ends);
  } catch (const ParameterError& error) {
    throw ParameterError(std::string("'counts' and --degree along ") + "uvw"[axis] + ": " +
                         error.what());
  }
}

/// Where --fit stands in for the corners.
const FitKind kFit = {.places = {"min", "max"}, .has_axes = true};

OrientedBox box_of(const Scene& scene, const Arguments& arguments) {
  if (arguments.has("fit")) {
    const FitRequest request = fit_request(scene, arguments, kFit);
    return fitted_box_of(request.points, request.options, request.padding);
  }
  require_no_fit_options(arguments);
  const glm::dvec3 low = arguments.has("min") ? arguments.vector("min") : glm::dvec3(0);
  const glm::dvec3 high = arguments.has("max") ? arguments.vector("max") : glm::dvec3(1);
  if (!(low.x < high.x && low.y < high.y && low.z < high.z)) {
    throw ParameterError("'min' must be below --max along x, y and z");
  }
  Box box;
  box.add(low);
  box.add(high);
  return oriented(box);
}

TensorLattice tensor_lattice(TensorKind kind, const Scene& scene, const Arguments& arguments,
                             const std::array<int, 3>& degree, const std::array<Ends, 3>& ends) {
  const std::array<int, 3> counts = counts_of(arguments);
  std::array<TensorAxis, 3> axes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    axes[i] = axis_of(axis, counts[i], degree[i], ends[i]);
  }
  return make_tensor_lattice(kind, axes, box_of(scene, arguments), BoxFilling::Volume);
}

TensorLattice new_bezier(const Scene& scene, const Arguments& arguments) {
  const std::array<int, 3> counts = counts_of(arguments);
  return tensor_lattice(TensorKind::Bezier, scene, arguments,
                        {counts[0] - 1, counts[1] - 1, counts[2] - 1},
                        {Ends::Open, Ends::Open, Ends::Open});
}

TensorLattice new_spline(TensorKind kind, const Scene& scene, const Arguments& arguments) {
  return tensor_lattice(kind, scene, arguments, degree_of(arguments, counts_of(arguments)),
                        ends_of(arguments));
}

ThbLattice new_thb(const Scene& scene, const Arguments& arguments) {
  const std::array<int, 3> counts = counts_of(arguments);
  return make_thb_lattice(counts, degree_of(arguments, counts), box_of(scene, arguments));
}

Parameter counts_parameter(std::int64_t n) {
  const std::string word = std::to_string(n);
  return {.name = "counts",
          .type = Type::Integers,
          .help = "control points along u, v, w (default " + word + " " + word + " " + word + ")",
          .count = 3,
          .fallback = Value(Integers{n, n, n})};
}

Parameter degree_parameter() {
  return {.name = "degree",
          .type = Type::Integers,
          .help = "along u, v, w (default 3, or less for fewer than four control points)",
          .count = 3};
}

Parameter ends_parameter() {
  return {.name = "ends",
          .type = Type::Text,
          .help =
              "open, uniform, natural, tripled or periodic, or one an axis with commas between "
              "(default open)",
          .fallback = Value(std::string("open"))};
}

/// `more` and what all of these lattices have in common.
std::vector<Parameter> box_parameters(std::vector<Parameter> more) {
  std::vector<Parameter> parameters = std::move(more);
  const std::vector<Parameter> common = {
      {.name = "min",
       .type = Type::Numbers,
       .help = "lowest corner of what it fills (default 0 0 0)",
       .count = 3},
      {.name = "max", .type = Type::Numbers, .help = "highest corner (default 1 1 1)", .count = 3}};
  parameters.insert(parameters.end(), common.begin(), common.end());
  const std::vector<Parameter> fit = fit_parameters(kFit);
  parameters.insert(parameters.end(), fit.begin(), fit.end());
  parameters.push_back(result_parameter("the lattice, .json"));
  return parameters;
}

/// An operation that adds the lattice that `make` makes.
template <class Make>
Operation making(const char* name, const char* summary, std::vector<Parameter> parameters,
                 const Make& make) {
  return {name, summary, box_parameters(std::move(parameters)),
          [make](const Scene& scene, const Arguments& arguments, const Progress&) {
            return with_lattice(scene, arguments.text("output"), make(scene, arguments));
          }};
}

}  // namespace

std::vector<Operation> tensor_operations() {
  const auto spline = [](TensorKind kind) {
    return [kind](const Scene& scene, const Arguments& arguments) {
      return new_spline(kind, scene, arguments);
    };
  };
  return {
      making("new bezier", "Make a box of control points of one polynomial", {counts_parameter(4)},
             new_bezier),
      making("new bspline", "Make a box of control points of a B-spline",
             {counts_parameter(6), degree_parameter(), ends_parameter()},
             spline(TensorKind::BSpline)),
      making("new nurbs", "Make a box of control points with weights, all 1 to begin with",
             {counts_parameter(6), degree_parameter(), ends_parameter()},
             spline(TensorKind::Nurbs)),
      making("new thb", "Make a box of control points to refine where it matters",
             {counts_parameter(6), degree_parameter()}, new_thb),
  };
}

}  // namespace espalier
