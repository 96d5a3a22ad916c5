#pragma once

/// Moving, turning and scaling points by mouse, axis keys and numbers.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "viewer/interact/drag_motion.h"
#include "viewer/interact/lattice_elements.h"
#include "viewer/interact/view.h"

namespace espalier::viewer {

/// Extrude moves as Move does, but along `normal` unless an axis is locked.
enum class TransformKind { Move, Turn, Scale, Extrude };

/// Which axes a transform may use: all, along one, or the two of a plane.
struct AxisLock {
  int axis = -1;          ///< 0 x, 1 y, 2 z; -1: none
  bool is_plane = false;  ///< all but the axis
};

/// A transform in progress; a value.
struct Transform {
  TransformKind kind = TransformKind::Move;
  AxisLock lock{};
  std::string number;                ///< as typed so far; empty: the mouse decides
  glm::dvec2 from{0.0};              ///< where the mouse was at first, pixels
  glm::dvec2 at{0.0};                ///< where it is
  glm::dvec3 pivot{0.0};             ///< model units
  glm::dvec3 normal{0.0};            ///< unit; of Extrude
  bool is_held = false;              ///< ends when the mouse button is released
  std::vector<glm::dvec3> pivots{};  ///< #points: their own; empty: `pivot` for all

  /// Types a digit, point or minus, or takes one back ("backspace"); false for another key.
  bool type(const std::string& key);
  /// Locks an axis, or frees it if it was locked so.
  void toggle(const AxisLock& wanted);

  /// Where the points go. weights: #points in [0, 1]. O(#points).
  [[nodiscard]] std::vector<glm::dvec3> apply(const View& view, std::span<const glm::dvec3> points,
                                              std::span<const double> weights) const;
  /// What moves points of weight 1: all of them, but that Turn gives a point of weight w the turn
  /// by w of the angle.
  [[nodiscard]] DragMotion motion(const View& view) const;
  /// How far Move and Extrude go.
  [[nodiscard]] glm::dvec3 offset(const View& view) const;
  /// How far along its normal Extrude goes.
  [[nodiscard]] double distance(const View& view) const;
  /// What it does, for the status line: "move along x: 1.5".
  [[nodiscard]] std::string text(const View& view) const;

 private:
  [[nodiscard]] double angle(const View& view) const;
  [[nodiscard]] double factor(const View& view) const;
  [[nodiscard]] bool scales(int axis) const {
    return lock.axis < 0 || (lock.axis == axis) != lock.is_plane;
  }
  [[nodiscard]] glm::dvec3 turn_axis(const View& view) const;
};

/// How much each point follows: 1 if selected; else by its distance d from the nearest selected one
/// (1 − (d / radius)²)², and 0 from the radius on. radius: model units; 0: only the selected.
[[nodiscard]] std::vector<double> soft_weights(std::span<const glm::dvec3> points,
                                               const Selection& selected, double radius);

}  // namespace espalier::viewer
