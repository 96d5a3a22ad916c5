#pragma once

/// Bound points laid out as the kernels read them: made once, read every frame.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/evaluate/axis_polynomial.h"
#include "lattice/core/cache_aligned.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// Points of a model in the order of their patches, as embedding sorts them. All: #points.
struct BoundPoints {
  std::span<const std::int32_t> patches;  ///< ascending
  std::span<const glm::dvec3> uvw;        ///< as in Binding
  std::span<const glm::dvec3> rest_points =
      {};                                     ///< empty: zeros, so that points become displacements
  std::span<const glm::dvec3> normals = {};   ///< of length 1; empty: none will be asked for
  std::span<const glm::dvec3> tangents = {};  ///< empty: none will be asked for
  bool has_gradients = false;  ///< gradients and determinants will be asked for; normals and
                               ///< tangents need them in any case
};

/// Points of one patch that are evaluated together.
struct PointRun {
  std::int32_t patch = 0;
  std::uint32_t n_points = 0;
  std::uint32_t first_point = 0;        ///< the run is the points from here on, in their order,
  std::uint32_t first_target = 0;       ///< or, if scattered, those of `targets` from here on
  std::uint32_t first_block = 0;        ///< of the block arrays
  std::uint32_t first_exact = 0;        ///< of exact_uvw, if it has any there
  std::array<std::uint16_t, 3> axes{};  ///< of `polynomials`
  bool is_scattered = false;
  bool is_general = false;  ///< rational, or of a degree that no kernel knows
  bool is_pyramid = false;  ///< whose derivatives no kernel knows
};

/// The points' numbers in blocks (kernels.h).
template <class Real>
struct PointRuns {
  std::size_t n_points = 0;
  std::vector<PointRun> runs;
  std::vector<std::uint32_t> chunks;  ///< runs between which the work is divided: #chunks + 1
  std::vector<std::uint32_t> targets;
  std::vector<glm::dvec3> exact_uvw;  ///< of general runs and pyramids
  std::vector<AxisPolynomial<Real>> polynomials;

  AlignedVector<Real> places, slopes, normals, tangents;

  [[nodiscard]] std::size_t bytes() const;
};

/// Throws ParameterError for arrays of different lengths, patches that the volume has not or that
/// do not ascend. O(#points).
///
/// Points within 1e-6 of an end 1 of their cube get a run of their own, that sees the patch from
/// there: plain powers would leave round-off of what does not reach the end at all.
template <class Real>
[[nodiscard]] PointRuns<Real> make_point_runs(const Volume& volume, const BoundPoints& points);

}  // namespace espalier
