/// espalier eval: where a posed lattice takes points, as CSV.

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deform/evaluate/displace.h"
#include "deform/scene/bind.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/pose.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice.h"
#include "tools/command.h"
#include "tools/csv_points.h"

namespace espalier::tools {
namespace {

constexpr const char* kHeader = "x,y,z,status,j00,j01,j02,j10,j11,j12,j20,j21,j22\n";

void add_row(const glm::dvec3& point, PointStatus status, const glm::dmat3& gradient,
             std::string& text) {
  fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{}", point.x, point.y, point.z,
                 name_of(status));
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      fmt::format_to(std::back_inserter(text), ",{:.17g}", gradient[b][a]);
    }
  }
  text += '\n';
}

std::vector<glm::dvec3> read_points(const std::string& path,
                                    const std::array<std::string_view, 3>& columns) {
  return parse_csv_points(path, read_file(path == "-" ? "/dev/stdin" : path), columns);
}

/// Where rest points go.
std::string evaluated_points(const Lattice& lattice, const Arguments& arguments,
                             const Session& session) {
  const std::vector<glm::dvec3> points = read_points(arguments.text("at"), {"x", "y", "z"});
  const ControlPose pose = own_pose(lattice);
  const Volume volume = freeze(lattice, arguments.text("freeze"), session.progress);
  const Binding binding = embed(volume, points, session.progress);
  const auto displacements = volume.displacements(pose.points);
  const auto weights = point_weights(volume, pose.weights);
  const auto moved = displaced_points(volume, binding, points, displacements, weights);
  const auto gradients = deformation_gradients(volume, binding, displacements, weights);
  std::string text = kHeader;
  for (std::size_t i = 0; i < points.size(); ++i) {
    add_row(moved[i], binding.status[i], gradients[i], text);
  }
  return text;
}

/// The posed volume at places of the whole lattice, its weights those of the pose. place_of: their
/// patches.
template <class PlaceOf>
std::string evaluated_places(const Lattice& lattice, std::span<const double> weights,
                             std::span<const glm::dvec3> places, const PlaceOf& place_of) {
  const Volume volume = lattice.freeze();
  const std::vector<glm::dvec3> points = volume.points(lattice.posed_points());
  std::string text = kHeader;
  BezierPatch patch;
  for (const glm::dvec3& uvw : places) {
    const PatchPlace place = place_of(uvw);
    volume.bezier(place.patch, points, weights, patch);
    glm::dvec3 point(0);
    glm::dmat3 derivative(0);
    patch.view().evaluate(place.uvw, point, derivative);
    bool is_border = false;
    for (int axis = 0; axis < 3; ++axis) {
      derivative[axis] *= place.scale[axis];
      is_border = is_border || uvw[axis] == 0 || uvw[axis] == 1;
    }
    add_row(point, is_border ? PointStatus::Border : PointStatus::Inside, derivative, text);
  }
  return text;
}

/// Throws FileError for a place outside [0,1]³.
std::vector<glm::dvec3> read_places(const std::string& path) {
  std::vector<glm::dvec3> places = read_points(path, {"u", "v", "w"});
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(places[i][axis] >= 0 && places[i][axis] <= 1)) {
        throw FileError(path, fmt::format("place {} has {} = {}, must be from 0 to 1", i,
                                          "uvw"[axis], places[i][axis]));
      }
    }
  }
  return places;
}

/// Where places of the whole lattice are.
std::string evaluated_places(const Lattice& lattice, const Arguments& arguments) {
  if (const auto* tensor = lattice.as<TensorLattice>()) {
    return evaluated_places(lattice, tensor->posed_weights(), read_places(arguments.text("uvw")),
                            [&](const glm::dvec3& uvw) { return place_of(*tensor, uvw); });
  }
  if (const auto* thb = lattice.as<ThbLattice>()) {
    const std::vector<ThbCell> leaves = thb->hierarchy->leaves();
    return evaluated_places(
        lattice, {}, read_places(arguments.text("uvw")),
        [&](const glm::dvec3& uvw) { return place_of(*thb->hierarchy, leaves, uvw); });
  }
  throw ParameterError(
      "'uvw' is for bezier, bspline, nurbs and thb lattices: a subdivision lattice has no u, v, w "
      "throughout; give --at");
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  if (arguments.has("at") == arguments.has("uvw")) {
    throw ParameterError("'at' or --uvw must be given, and not both");
  }
  const Lattice lattice = read_any_lattice(arguments.text("lattice"), session.progress);
  const std::string text = arguments.has("at") ? evaluated_points(lattice, arguments, session)
                                               : evaluated_places(lattice, arguments);
  std::fputs(text.c_str(), stdout);
  return ExitStatus::Done;
}

}  // namespace

Command eval_command() {
  return {"eval",
          "Print where points go with a posed lattice, and the Jacobian there, as CSV",
          {{.name = "lattice",
            .type = ParameterType::Path,
            .help = "the lattice and its pose (.json, .ovm)",
            .is_required = true,
            .is_positional = true},
           {.name = "at",
            .type = ParameterType::Path,
            .help = "CSV of rest points with a header line x,y,z; - for standard input"},
           {.name = "uvw",
            .type = ParameterType::Path,
            .help = "instead, of a bezier, bspline, nurbs or thb lattice: CSV with a header line "
                    "u,v,w of places from 0 to 1 in the whole range of its knots; the Jacobian is "
                    "by them"},
           freeze_parameter()},
          run,
          false};
}

}  // namespace espalier::tools
