#include "deform/model/ply_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "deform/model/ply_body.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

void read(PlyBody& body, const PlyProperty& property, PlyValues& values) {
  values.numbers.clear();
  std::size_t n = 1;
  const auto take = [&values](const BytePlace& place, bool is_first) {
    values.begin = is_first ? place.begin() : values.begin;
    values.end = place.begin() + place.length();
  };
  if (property.count_type) {
    const PlacedNumber length = body.next(*property.count_type, property.name);
    n = static_cast<std::size_t>(length.value);
    take(length.place, true);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const PlacedNumber number = body.next(property.type, property.name);
    values.numbers.push_back(number.value);
    take(number.place, !property.count_type);
  }
}

}  // namespace

bool is_ply_corners(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

PlyRows::PlyRows(const Model& model)
    : model_(model), scanner_(model.path(), model.bytes()), header_(read_ply_header(scanner_)) {
  std::ptrdiff_t n_lists = 0;
  for (const PlyElement& element : header_.elements) {
    n_lists +=
        element.name == "face" ? std::ranges::count_if(element.properties, is_ply_corners) : 0;
  }
  if (n_lists > 1) {
    throw ParameterError(fmt::format(
        "{} lists the corners of its faces {} times: they can be rewritten only where it does once",
        model.path(), n_lists));
  }
}

const PlyElement& PlyRows::vertex() const {
  return *std::ranges::find(header_.elements, "vertex", &PlyElement::name);
}

void PlyRows::for_each(const Visit& visit) const {
  PlyBody body(model_.path(), model_.bytes(), scanner_, header_.encoding);
  for (const PlyElement& element : header_.elements) {
    std::vector<PlyValues> row(element.properties.size());
    for (std::int64_t i = 0; i < element.count && !row.empty(); ++i) {
      body.begin_element(element, i);
      for (std::size_t k = 0; k < row.size(); ++k) {
        read(body, element.properties[k], row[k]);
      }
      visit(element, row);
    }
  }
}

void PlyRows::for_each_face(const VisitFace& visit) const {
  std::size_t face = 0;
  for_each([&](const PlyElement& element, Row row) {
    const auto corners = std::ranges::find_if(element.properties, is_ply_corners);
    if (element.name != "face" || corners == element.properties.end()) {
      return;
    }
    const auto k = static_cast<std::size_t>(corners - element.properties.begin());
    if (row[k].numbers.size() >= 3) {
      visit(face++, element, row);
    }
  });
}

std::size_t PlyRows::end_of_line(std::size_t at) const {
  return header_.encoding == PlyEncoding::Text
             ? std::min(model_.bytes().find_first_of("\r\n", at), model_.bytes().size())
             : at;
}

void PlyRows::replace_count(std::string_view name, std::size_t n_more, Splices& splices) const {
  for (const PlyElement& element : header_.elements) {
    if (element.name == name) {
      const auto begin =
          static_cast<std::size_t>(element.count_word.data() - model_.bytes().data());
      splices.replace(BytePlace(begin, element.count_word.size()),
                      std::to_string(static_cast<std::size_t>(element.count) + n_more));
      return;
    }
  }
}

void PlyRows::require_room(const PlyProperty& corners, std::size_t n_points, std::string_view task,
                           std::string_view advice) const {
  if (static_cast<double>(n_points) - 1 > greatest_of(corners.type)) {
    throw ParameterError(fmt::format(
        "{}: {} numbers points in a type that ends at {:.0f}, and {} are needed: {}, or a file "
        "with int {}",
        task, model_.path(), greatest_of(corners.type), n_points, advice, corners.name));
  }
}

}  // namespace espalier
