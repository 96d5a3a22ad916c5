#pragma once

/// Moving bound points with their lattice.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "deform/embed/embed.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// x' = x + Σ w_i (P_i − P_i^rest): where the bound points go. A point that no moved control point
/// reaches keeps its bits, and so does every point that no patch holds and that is in no fringe.
/// rest_points: #points, those that were bound; displacements: as Volume::displacements() makes
/// them. The same bits for any number of threads.
///
/// pose_weights: positive, of a rational volume's points in the pose; empty: those at rest. Where
/// they differ from those at rest, x' = x + X_pose(u) − X_rest(u). Throws ParameterError as
/// VolumeMotion::set().
[[nodiscard]] std::vector<glm::dvec3> displaced_points(const Volume& volume, const Binding& binding,
                                                       std::span<const glm::dvec3> rest_points,
                                                       std::span<const glm::dvec3> displacements,
                                                       std::span<const double> pose_weights = {});

/// x' − x of every bound point, before it is rounded into x'; zero where displaced_points() keeps
/// the bits. #points.
[[nodiscard]] std::vector<glm::dvec3> point_displacements(
    const Volume& volume, const Binding& binding, std::span<const glm::dvec3> displacements,
    std::span<const double> pose_weights = {});

/// ∂x'/∂x at the bound points, the identity where nothing moves a point. #points; column b is the
/// derivative along axis b.
[[nodiscard]] std::vector<glm::dmat3> deformation_gradients(
    const Volume& volume, const Binding& binding, std::span<const glm::dvec3> displacements,
    std::span<const double> pose_weights = {});

/// cof(J) n, of unit length: how a normal turns. Safe where J is singular; zero if it vanishes.
[[nodiscard]] glm::dvec3 turned_normal(const glm::dmat3& J, const glm::dvec3& normal);

}  // namespace espalier
