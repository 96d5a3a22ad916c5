#pragma once

/// A model is its file: the bytes, the geometry found in them, and the place of every number.

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "deform/model/model_layout.h"
#include "lattice/core/compressed_rows.h"

namespace espalier {

enum class ModelFormat : std::uint8_t { Obj, Off, Ply, Stl };

/// A polygon model as read from a file. A value: immutable, and copies share everything.
class Model {
 public:
  /// For scanners; `layout` describes `bytes`.
  Model(std::string path, ModelFormat format, std::string bytes, ModelLayout layout);

  /// The name it was read under, for messages.
  [[nodiscard]] const std::string& path() const { return data_->path; }
  [[nodiscard]] ModelFormat format() const { return data_->format; }
  /// The whole file.
  [[nodiscard]] std::string_view bytes() const { return data_->bytes; }

  /// #P × 3, model units, all finite. At least one.
  [[nodiscard]] std::span<const glm::dvec3> points() const { return data_->layout.points; }
  /// #N × 3, as written: of any length, not always unit.
  [[nodiscard]] std::span<const glm::dvec3> normals() const { return data_->layout.normals; }
  /// Polygons of three or more corners: indices of points, in the file's order and winding.
  [[nodiscard]] const CompressedRows<std::int32_t>& faces() const { return data_->layout.faces; }
  /// Polylines: indices of points, as many as the file names, in its order.
  [[nodiscard]] const CompressedRows<std::int32_t>& lines() const { return data_->layout.lines; }
  /// The (point, normal) pairs that occur at corners, sorted by point, then normal. A normal that
  /// is used at several points deforms differently at each: pairs are what deforms.
  [[nodiscard]] std::span<const PointNormal> pairs() const { return data_->layout.pairs; }
  /// #corners, parallel to faces().values(): the pair at each corner, -1 at a corner without
  /// normal. Empty if no corner has one.
  [[nodiscard]] std::span<const std::int32_t> corner_pairs() const {
    return data_->layout.corners.pairs;
  }
  /// Named groups and objects, with the faces in them.
  [[nodiscard]] std::span<const FaceGroup> groups() const { return data_->layout.groups; }

  /// What the writer needs beyond the geometry.
  [[nodiscard]] const ModelLayout& layout() const { return data_->layout; }

 private:
  struct Data {
    std::string path;
    ModelFormat format;
    std::string bytes;
    ModelLayout layout;
  };
  std::shared_ptr<const Data> data_;
};

}  // namespace espalier
