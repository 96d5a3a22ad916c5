#pragma once

/// Tying models of a scene to its lattices.

#include <memory>
#include <string>

#include "deform/scene/scene.h"
#include "lattice/core/progress.h"

namespace espalier {

/// The volume of a lattice at rest. option: "adaptive", "adaptive:TOLERANCE",
/// "adaptive:TOLERANCE:TOLERANCE_OF_DERIVATIVES" (see AdaptiveOptions) or "uniform:N", which says
/// how subdivision lattices freeze; the other types freeze exactly. Throws ParameterError for
/// another one.
[[nodiscard]] Volume freeze(const Lattice& lattice, const std::string& option,
                            const Progress& progress = {});

/// How a model is bound.
struct BindOptions {
  std::string freeze = "adaptive";  ///< as freeze() takes it
  std::string outside = "keep";     ///< what outside points do: "keep" their place, or
                                    ///< "falloff:DISTANCE": see make_fringe()
};

/// The scene with the model bound to the lattice, unless it is bound so already. Throws
/// ParameterError for an option that is none.
[[nodiscard]] Scene with_bound(const Scene& scene, const std::string& model,
                               const std::string& lattice, const BindOptions& options,
                               const Progress& progress = {});

/// Writes the binding of a bound model to `path`, with fingerprints of what it depends on. Throws
/// FileError if it cannot be written.
void save_binding(const Scene& scene, const std::string& model, const std::string& lattice,
                  const std::string& path);

/// As with_bound(), with the places read from a file that save_binding() wrote; the lattice is
/// frozen as it was then. options: "" to take the file's. Throws FileError, saying what differs,
/// unless the file was made for this model, this lattice at rest, and these options.
[[nodiscard]] Scene with_saved_binding(const Scene& scene, const std::string& model,
                                       const std::string& lattice, const std::string& path,
                                       const BindOptions& options, const Progress& progress = {});

}  // namespace espalier
