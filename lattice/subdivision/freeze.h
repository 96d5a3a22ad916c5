#pragma once

/// Freezing a Catmull-Clark lattice into a volume.

#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// [MJ96]'s own method: `levels` refinements everywhere, then every hexahedron is one trilinear
/// patch, and every other cell, of type n, 2n pyramids from its faces to its centroid. A pyramid
/// over the bilinear face meets its neighbours exactly, where the paper's tetrahedra leave slits.
/// The error falls by about 4 a level, the cells grow by 8. Throws ParameterError unless levels is
/// 1 to 8. Tells `progress` "refine".
[[nodiscard]] Volume freeze_uniform(const SubdivisionLattice& lattice, int levels,
                                    const Progress& progress = {});

/// What freeze_uniform() makes without the control points' places: for shaping one lattice.
[[nodiscard]] VolumeTables uniform_tables(const SubdivisionLattice& lattice, int levels,
                                          const Progress& progress = {});

/// Without a gradient tolerance of its own, ∂x'/∂x is to be within this many tolerances.
inline constexpr double kGradientToleranceFactor = 1000;

/// How exact an adaptive freeze is, leaves and jumps across the borders of patches included. Where
/// points go, x', is within the tolerance; ∂x'/∂x, whose error falls more slowly, within the
/// gradient tolerance along inner lines. Leaves end where round-off of coordinates is as large: at
/// about 1e-6 for the valence 5, 1e-4 for 8. Nothing is promised of ∂x'/∂x where three or more
/// cells meet at a smooth boundary: there the subdivision surface's own derivative converges
/// slowly, or, in a fan of more and at some nodes, to no limit. With three its error stays below
/// 0.3. With most_levels reached (with 8, about 2e-6 at nodes of hexahedra, 1e-5 at finite creases
/// and 2e-5 in pyramids) x' is only as exact as these levels, and ∂x'/∂x, at inner nodes, to about
/// 0.3 · 0.7^levels. The volume's boundary at leaves is as exact as x'.
struct AdaptiveOptions {
  double tolerance = 1e-5;  ///< of positions, relative to the lattice's diagonal, for moves of
                            ///< about a cell; 1e-12 to 1e-1
  double gradient_tolerance = 0;  ///< of ∂x'/∂x for the same moves; 1e-12 to 1, or 0: a thousand
                                  ///< times the tolerance
  int most_levels = 8;  ///< of refinement in all directions, 1 to 8
  /// Refinement in all directions also ends before the stencils of a level may have more weights
  /// than this, of twelve bytes each: cells with many faces, whose points depend on every control
  /// point, would fill any memory.
  std::size_t most_weights = 60'000'000;
};

/// Regular cells become one tricubic patch, exactly. Line cells (scheme catmull-clark) become
/// bicubic × cubic patches, exactly but for small leaves at their extraordinary corners, isolated
/// across the line only: patches grow linearly with −log(tolerance). Other cells are refined in all
/// directions, as often as the tolerance asks, and most_levels and most_weights allow, down to
/// trilinear patches and pyramids; Volume::freeze_error() and gradient_error() tell what misses the
/// tolerances. Throws
/// ParameterError for options out of range. Tells `progress` "freeze".
[[nodiscard]] Volume freeze_adaptive(const SubdivisionLattice& lattice,
                                     const AdaptiveOptions& options = {},
                                     const Progress& progress = {});

}  // namespace espalier
