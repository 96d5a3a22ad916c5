#pragma once

/// Motions that spread evenly over the lattice.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "deform/direct/motion_energy.h"
#include "lattice/io/lattice.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Neighbours that should move alike: a row each, √weight · (one − the other), over control points.
///
/// Those of a lattice's net, all of weight 1; of a hierarchical lattice, whose net is one of each
/// level, the neighbouring coefficients of every patch, of weight 2^−level: as Σ |δ|² h is ∫ |∇Δ|²
/// for cells of size h. volume: what the lattice froze into.
[[nodiscard]] StencilTable neighbour_differences(const Lattice& lattice, const Volume& volume);

/// Σ |differences · ΔP|²: motions bend the lattice as little as they can, and move it as it is for
/// nothing; a part of it that is pinned nowhere and that no row sees stays. rows: those that will
/// be asked for. mobilities: #controls, 0: pinned, else 1 / stiffness, which the differences that a
/// control point has a part in are multiplied by, by the mean of several; or empty: all 1. Throws
/// as smallest_motion(). A sparse Cholesky factorisation.
[[nodiscard]] std::shared_ptr<const MotionEnergy> smooth_motion(
    const StencilTable& rows, const StencilTable& differences,
    std::span<const double> mobilities = {});

}  // namespace espalier
