#include "deform/scene/densify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "deform/model/dense_model.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr double kNoLength = 1e-9;  // of the lattice's diagonal
constexpr int kMostRounds = 8;

constexpr std::array<std::pair<std::string_view, DensifyMethod>, 3> kMethods = {
    {{"midpoint", DensifyMethod::Midpoint},
     {"loop", DensifyMethod::Loop},
     {"catmull-clark", DensifyMethod::CatmullClark}}};

/// #controls: whether a control point moves a patch that holds points.
std::vector<char> controls_under(const Volume& volume, const Binding& binding) {
  std::vector<char> is_under(volume.n_controls(), 0);
  std::vector<char> is_seen(volume.n_patches(), 0);
  for (const std::int32_t patch : binding.patches) {
    if (std::exchange(is_seen[static_cast<std::size_t>(patch)], 1) != 0) {
      continue;
    }
    for (const std::int32_t point : volume.block(static_cast<std::size_t>(patch))) {
      for (const std::int32_t control :
           volume.stencils()[static_cast<std::size_t>(point)].indices) {
        is_under[static_cast<std::size_t>(control)] = 1;
      }
    }
  }
  return is_under;
}

}  // namespace

double finest_spacing(const Lattice& lattice, const Volume& volume, const Binding& binding) {
  const std::vector<char> is_under = controls_under(volume, binding);
  const std::span<const glm::dvec3> rest = lattice.rest_points();
  double finest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : lattice.net()) {
    const auto i = static_cast<std::size_t>(a);
    const auto k = static_cast<std::size_t>(b);
    const double length = glm::distance(rest[i], rest[k]);
    if (is_under[i] != 0 && is_under[k] != 0 && length > kNoLength * volume.diagonal()) {
      finest = std::min(finest, length);
    }
  }
  if (!std::isfinite(finest)) {
    throw ParameterError(
        "densify: no point of the model is inside the lattice, so it gives no length: give one");
  }
  return finest;
}

DensifyOptions parse_densify(const std::string& word) {
  const std::size_t colon = word.find(':');
  DensifyOptions options;
  const auto* found = std::find_if(kMethods.begin(), kMethods.end(), [&](const auto& method) {
    return method.first == word.substr(0, colon);
  });
  const bool is_length = colon == std::string::npos ||
                         (parse_number(std::string_view(word).substr(colon + 1), options.length) &&
                          options.length > 0 && std::isfinite(options.length));
  if (found == kMethods.end() || !is_length) {
    throw ParameterError("'densify' is '" + word +
                         "', must be midpoint, loop or catmull-clark, or one of these with a "
                         "positive length, as in midpoint:0.1");
  }
  options.method = found->second;
  return options;
}

namespace {

/// Of all lattices, to which the scene's model is bound; the scene keeps that.
double finest_spacing(Scene& scene, const std::string& model,
                      const std::vector<std::string>& lattices, const BindOptions& options,
                      const Progress& progress) {
  if (lattices.empty()) {
    throw ParameterError("densify: give a length, or a lattice that it is for");
  }
  double finest = std::numeric_limits<double>::infinity();
  for (const std::string& lattice : lattices) {
    scene = with_bound(scene, model, lattice, options, progress);
    const BoundModel& bound = scene.bound.at({model, lattice});
    finest =
        std::min(finest, finest_spacing(lattice_in(scene, lattice), *bound.volume, *bound.binding));
  }
  return finest;
}

}  // namespace

Scene with_dense_model(Scene scene, const std::string& model,
                       const std::vector<std::string>& lattices, const DensifyOptions& options,
                       const BindOptions& binding, const std::string& output,
                       const Progress& progress) {
  const Model source = model_in(scene, model);
  Scene work = scene;
  // More points may show finer control points under the model.
  for (int round = 0; round < kMostRounds; ++round) {
    const double length = options.length > 0
                              ? options.length
                              : finest_spacing(work, model, lattices, binding, progress);
    const Model before = model_in(work, model);
    Model dense = dense_model(before, options.method, length, source.path(), progress);
    if (dense.bytes().data() == before.bytes().data()) {
      break;
    }
    work = with_model(std::move(work), model, std::move(dense));
  }
  if (output == model) {
    return work;
  }
  return with_model(std::move(scene), output, model_in(work, model));
}

}  // namespace espalier
