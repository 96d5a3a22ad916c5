#pragma once

/// How often a line's extraordinary corners are isolated, and how exact that makes what is left.

namespace espalier {

/// By what factor a level of isolation changes a leaf at an extraordinary line.
struct IsolationRates {
  double position;  ///< its error in x'
  double gradient;  ///< its error in ∂x'/∂x; 1: nothing is asked of it
  double size;      ///< its extent
};

/// From the eigenvalues of Catmull-Clark subdivision [DS78]. n_cells: at the line, three or more;
/// at a smooth boundary, with n cells, positions converge as inside with 2n, but derivatives only
/// by 0.82 a level with three cells, and not at all with more: leaves would become too small.
[[nodiscard]] IsolationRates isolation_rates(int n_cells, bool is_boundary);

/// What leaves are to be.
struct LeafAccuracy {
  double tolerance;           ///< of x', in cells of size 1
  double gradient_tolerance;  ///< of ∂x'/∂x
  double coordinate_scale;    ///< the largest coordinate of the rest points, in cells
};

/// Levels of isolation that make x' and ∂x'/∂x as exact, 1 to 60: of ∂x'/∂x until the coordinates'
/// round-off is as large as what is missed.
[[nodiscard]] int isolation_levels(const IsolationRates& rates, const LeafAccuracy& accuracy);

/// The error of ∂x'/∂x that leaves have after some levels, for moves of about a cell.
[[nodiscard]] double leaf_gradient_error(const IsolationRates& rates, int levels);

/// Levels that divide an error by a rate each until it is within the tolerance.
[[nodiscard]] double levels_within(double tolerance, double error, double rate);

}  // namespace espalier
