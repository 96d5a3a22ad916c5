/// Operations that bring files into the scene and objects out of it.

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "deform/model/model_file.h"
#include "deform/scene/bind.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "deform/scene/pose.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice_file.h"
#include "lattice/io/vtu_writer.h"

namespace espalier {
namespace {

std::string kind_of(const std::string& path) {
  return is_lattice_path(path) ? "lattice" : "model";
}

Scene open(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& path = arguments.text("path");
  const std::string& name = arguments.has("as") ? arguments.text("as") : path;
  const std::string kind = arguments.has("kind") ? arguments.text("kind") : kind_of(path);
  if (kind == "model") {
    return with_model(scene, name, read_model(path));
  }
  if (kind == "lattice") {
    return with_lattice(scene, name, read_any_lattice(path, progress));
  }
  Scene result = scene;
  result.poses.insert_or_assign(name, std::make_shared<const Pose>(read_pose(path)));
  return result;
}

/// Throws ParameterError, with what would be right, for a volume that makes a huge file though
/// nobody asked for just that. What a number of patches takes is known from wraps.
void refuse_huge_file(const Volume& volume, const Arguments& arguments, const std::string& name,
                      bool is_subdivision) {
  constexpr double kMostBytes = 5e8;
  constexpr double kBytesPerPoint = 33;  // of a patch: its index, and its share of the coordinates
  double bytes = 0;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const auto [p, q, r] = volume.degree(i);
    bytes += kBytesPerPoint * (p + 1) * (q + 1) * (r + 1);
  }
  if (bytes > kMostBytes && arguments.text("freeze") == "adaptive") {
    throw ParameterError(fmt::format(
        "{}: the frozen volume has {} patches, a file of about {:.1f} GB: {}--freeze adaptive:1e-5 "
        "writes it all the same",
        name, volume.n_patches(), bytes / 1e9,
        is_subdivision ? "--freeze adaptive:1e-3 makes a smaller one to look at, " : ""));
  }
}

/// What VTK is to draw of a lattice.
std::string vtu_of(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("name");
  const Lattice& lattice = lattice_in(scene, name);
  const bool is_rest = arguments.flag("rest");
  const auto controls = is_rest ? lattice.rest_points() : lattice.posed_points();
  if (!arguments.flag("volume")) {
    return lattice.visit([&](const auto& held) {
      if constexpr (requires { *held.complex; }) {
        return vtu_text(*held.complex, controls);
      } else {
        return vtu_text(control_net(held), controls);
      }
    });
  }
  const Volume volume = freeze(lattice, arguments.text("freeze"), progress);
  refuse_huge_file(volume, arguments, name, lattice.as<SubdivisionLattice>() != nullptr);
  const auto* tensor = lattice.as<TensorLattice>();
  const bool has_weights = tensor != nullptr && !is_rest;
  return vtu_text(
      volume, volume.points(controls),
      has_weights ? point_weights(volume, tensor->posed_weights()) : std::vector<double>());
}

Scene save(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("name");
  const std::string& path = arguments.has("path") ? arguments.text("path") : name;
  const bool is_vtu = scene.lattices.contains(name) && is_vtu_path(path);
  for (const char* option : {"volume", "rest"}) {
    if (arguments.flag(option) && !is_vtu) {
      throw ParameterError(std::string("'") + option + "' is for lattices that become .vtu files");
    }
  }
  if (is_vtu) {
    write_file(path, vtu_of(scene, arguments, progress));
  } else if (scene.lattices.contains(name)) {
    write_any_lattice(path, lattice_in(scene, name));
  } else {
    write_model(path, model_in(scene, name));
  }
  return scene;
}

}  // namespace

std::vector<Operation> file_operations() {
  using Type = ParameterType;
  return {
      {"open",
       "Read a model, a lattice or a pose from a file",
       {{.name = "path", .type = Type::Path, .help = "the file", .is_required = true},
        {.name = "as", .type = Type::Text, .help = "its name in the scene (default: the path)"},
        {.name = "kind",
         .type = Type::Choice,
         .help = "what to read it as (default: by its extension)",
         .choices = {"model", "lattice", "pose"}}},
       open},
      {"save",
       "Write a model or a lattice to a file",
       {{.name = "name",
         .type = Type::ModelOrLattice,
         .help = "what to write",
         .is_required = true},
        {.name = "path",
         .type = Type::Path,
         .help = "the file (default: the name); .vtu: a lattice's cells, for VTK"},
        {.name = "volume",
         .type = Type::Flag,
         .help = ".vtu: the frozen volume, curved, instead of the control cells"},
        {.name = "rest", .type = Type::Flag, .help = ".vtu: at rest instead of posed"},
        freeze_parameter()},
       save,
       false},
  };
}

}  // namespace espalier
