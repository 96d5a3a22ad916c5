#pragma once

/// Where the rows of a PLY file stand.

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "deform/model/model.h"
#include "deform/model/ply_header.h"
#include "deform/model/ply_writer.h"
#include "deform/model/splices.h"

namespace espalier {

/// The numbers of one property of an element, the length of a list left out, and where all stands.
struct PlyValues {
  std::vector<double> numbers;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Whether it lists the corners of a face.
[[nodiscard]] bool is_ply_corners(const PlyProperty& property);

/// The rows of a model's file, read again whenever they are asked for.
class PlyRows {
 public:
  using Row = std::span<const PlyValues>;
  using Visit = std::function<void(const PlyElement& element, Row row)>;
  using VisitFace = std::function<void(std::size_t face, const PlyElement& element, Row row)>;

  /// model: of a PLY file; must outlive this. Throws ParameterError if it has several lists of
  /// corners.
  explicit PlyRows(const Model& model);

  [[nodiscard]] const PlyHeader& header() const { return header_; }
  /// That of points.
  [[nodiscard]] const PlyElement& vertex() const;

  /// Of every element with properties, in the file's order.
  void for_each(const Visit& visit) const;
  /// Of those that are faces to the model.
  void for_each_face(const VisitFace& visit) const;

  /// In a text, the end of the line in which `at` stands; else `at`: where more rows may stand.
  [[nodiscard]] std::size_t end_of_line(std::size_t at) const;

  /// Writes how many elements of a name there are.
  void replace_count(std::string_view name, std::size_t n_more, Splices& splices) const;

  /// Throws ParameterError, beginning with `task` and ending with `advice`, if a list of corners
  /// cannot number so many points.
  void require_room(const PlyProperty& corners, std::size_t n_points, std::string_view task,
                    std::string_view advice) const;

 private:
  const Model& model_;
  TextScanner scanner_;  // at the end of the header
  PlyHeader header_;
};

}  // namespace espalier
