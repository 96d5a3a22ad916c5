#pragma once

/// What a user works on, as a value: models, lattices, poses, and models tied to lattices.

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "deform/embed/crossings.h"
#include "deform/embed/embed.h"
#include "deform/evaluate/combine.h"
#include "deform/fit/conversion.h"
#include "deform/model/model.h"
#include "lattice/io/lattice.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Control points to move a lattice to, with the lattice they are meant for: of a subdivision
/// lattice its cells. They may fold.
struct Pose {
  std::variant<CellComplex, TensorLattice, ThbLattice> lattice;
  std::vector<glm::dvec3> points;  ///< #controls, model units
};

/// Boundary faces of a lattice at which the model must join what stays: the first layers of control
/// points there count as unmoved in every pose.
struct Lock {
  std::string option = "none";         ///< as with_lock() takes it
  std::vector<std::int32_t> faces;     ///< ascending
  std::vector<std::int32_t> controls;  ///< that count as unmoved, ascending
};

/// A model tied to a lattice at rest. It stands for these very values: an operation that replaces
/// the model or the lattice drops it.
struct BoundModel {
  std::string freeze;  ///< the options it was bound with, see BindOptions
  std::string outside;
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const Binding> binding;
  std::shared_ptr<const Crossings> crossings = nullptr;  ///< none until they are asked for
  Lock lock = {};
};

/// How much of what its lattices do a model follows, as `deform` takes it.
struct ModelInfluence {
  double strength = 1;
  std::vector<std::string> only;  ///< groups, or lists of indices
  std::string weights;            ///< a file, or none
  Influence influence;            ///< what they come to: of the model's points
};

/// Copies are cheap: they share everything that did not change. Names are those of the files, or
/// any others.
struct Scene {
  std::map<std::string, Model> models;
  std::map<std::string, Lattice> lattices;
  std::map<std::string, std::shared_ptr<const Pose>> poses;
  std::map<std::pair<std::string, std::string>, BoundModel> bound;          ///< by (model, lattice)
  std::map<std::string, std::shared_ptr<const ModelInfluence>> influences;  ///< by model; absent:
                                                                            ///< all of it
  /// By model that a lattice deformed: how many faces it tore where they leave it; absent: none.
  std::map<std::string, std::size_t> torn_faces;
  /// By lattice that was made from a mesh: what there is to tell about it.
  std::map<std::string, Conversion> conversions;
};

/// The named object. Throw ParameterError if the scene has none of that name.
[[nodiscard]] const Model& model_in(const Scene& scene, const std::string& name);
[[nodiscard]] const Lattice& lattice_in(const Scene& scene, const std::string& name);
[[nodiscard]] const Pose& pose_in(const Scene& scene, const std::string& name);

/// The named lattice for what only subdivision lattices can do. what: names that in the
/// ParameterError for a lattice of another type.
[[nodiscard]] const SubdivisionLattice& subdivision_lattice_in(const Scene& scene,
                                                               const std::string& name,
                                                               std::string_view what = "this");

/// The scene with an object added or replaced.
[[nodiscard]] Scene with_model(Scene scene, const std::string& name, Model model);
[[nodiscard]] Scene with_lattice(Scene scene, const std::string& name, Lattice lattice);
/// The scene with a lattice posed, or at rest if `pose` is empty; what is bound stays bound. pose:
/// #controls. Throws ParameterError for another number of points, or one that is not finite or
/// beyond kLargestCoordinate.
[[nodiscard]] Scene with_pose(Scene scene, const std::string& lattice,
                              std::vector<glm::dvec3> pose);

}  // namespace espalier
