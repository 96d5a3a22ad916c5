#pragma once

/// Models made denser for the lattices that bend them.

#include <string>
#include <vector>

#include "deform/embed/embed.h"
#include "deform/model/dense_mesh.h"
#include "deform/scene/bind.h"
#include "deform/scene/scene.h"
#include "lattice/io/lattice.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// The finest spacing of control points under a model: the shortest line of the lattice's net
/// between control points that both move points of the model. Lines without length, as where border
/// points coincide, do not count. volume: what the lattice froze into; binding: of the model to it.
/// Throws ParameterError if no point of the model is inside.
[[nodiscard]] double finest_spacing(const Lattice& lattice, const Volume& volume,
                                    const Binding& binding);

/// What `densify` options say: "METHOD" or "METHOD:LENGTH", METHOD midpoint, loop or catmull-clark.
struct DensifyOptions {
  DensifyMethod method = DensifyMethod::Midpoint;
  double length = 0;  ///< 0: the finest spacing under the model
};

/// Throws ParameterError for another word.
[[nodiscard]] DensifyOptions parse_densify(const std::string& word);

/// The scene with a model made denser, under the name `output`, which may be its own; as it is if
/// its edges are short already. lattices: those that give the length where the options do not,
/// until the denser model shows none that is finer. Throws ParameterError as dense_model() and
/// finest_spacing().
[[nodiscard]] Scene with_dense_model(Scene scene, const std::string& model,
                                     const std::vector<std::string>& lattices,
                                     const DensifyOptions& options, const BindOptions& binding,
                                     const std::string& output, const Progress& progress);

}  // namespace espalier
