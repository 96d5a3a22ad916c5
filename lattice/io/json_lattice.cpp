#include "lattice/io/json_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/io/json_document.h"
#include "lattice/io/number_text.h"

namespace espalier {
namespace {

constexpr std::string_view kType = "subdivision";
constexpr std::array<std::string_view, 9> kOwnKeys = {"format",      "type",           "scheme",
                                                      "vertices",    "faces",          "cells",
                                                      "sharp_edges", "sharp_vertices", "pose"};

/// Walks the document; errors name where in it they are.
class Reader : public JsonReader {
 public:
  using JsonReader::JsonReader;

  RawLattice read() {
    check_kind();
    RawLattice raw;
    raw.scheme = read_scheme();
    raw.rest = read_points("vertices");
    n_vertices_ = raw.rest.size();
    CompressedRows<std::int32_t> faces = read_rows("faces", "vertex", n_vertices_);
    const std::size_t n_faces = faces.n_rows();
    raw.polyhedra = polyhedra_from_faces(static_cast<std::int32_t>(n_vertices_), std::move(faces),
                                         read_rows("cells", "face", n_faces));
    read_sharpness(raw);
    if (root_.contains("pose")) {
      raw.pose = read_points("pose");
      if (raw.pose.size() != n_vertices_) {
        fail("pose",
             fmt::format("has {} points, needs {}, one a vertex", raw.pose.size(), n_vertices_));
      }
    }
    orient(raw.polyhedra, raw.rest);
    return raw;
  }

 private:
  void check_kind() const {
    if (type() != kType) {
      fail("type", fmt::format("is {}, not {}; grids are of type bezier, bspline, nurbs or thb",
                               shown(type()), kType));
    }
  }

  [[nodiscard]] Scheme read_scheme() const {
    const auto found = root_.find("scheme");
    if (found == root_.end()) {
      return Scheme::CatmullClark;
    }
    const auto scheme =
        found->is_string() ? scheme_named(found->get_ref<const std::string&>()) : std::nullopt;
    if (!scheme) {
      fail("scheme", fmt::format("is {}, not \"catmull-clark\" or \"mj96\"", shown(*found)));
    }
    return *scheme;
  }

  /// An index below n of what `element` names; -1 and 3.5 are none, 3.0 is.
  template <class Where>
  [[nodiscard]] std::int32_t read_index(const Json& value, std::string_view element, std::size_t n,
                                        const Where& where) const {
    const double number = value.is_number() ? value.get<double>() : 0.5;
    if (number != std::floor(number)) {
      fail(where(), fmt::format("is {}, not a whole number", shown(value)));
    }
    if (number < 0 || number >= static_cast<double>(n)) {
      const std::string range = n == 0 ? "" : fmt::format(" (0…{})", n - 1);
      fail(where(),
           fmt::format("{} {} does not exist, there are {}{}", element, shown(value), n, range));
    }
    return static_cast<std::int32_t>(number);
  }

  [[nodiscard]] CompressedRows<std::int32_t> read_rows(std::string_view key,
                                                       std::string_view element,
                                                       std::size_t n) const {
    const Json& list = array(key);
    CompressedRows<std::int32_t> rows;
    std::vector<std::int32_t> row;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].is_array()) {
        fail(place(key, i), fmt::format("is {}, not a list", shown(list[i])));
      }
      row.clear();
      for (std::size_t j = 0; j < list[i].size(); ++j) {
        row.push_back(read_index(list[i][j], element, n, [&] { return place(key, i, j); }));
      }
      rows.push_back(row);
    }
    return rows;
  }

  template <class Where>
  [[nodiscard]] float read_sharp(const Json& value, const Where& where) const {
    const double sharpness = value.is_number() ? value.get<double>() : -1.0;
    if (!(sharpness >= 0) || sharpness > static_cast<double>(std::numeric_limits<float>::max())) {
      fail(where(), fmt::format("sharpness {} is not a finite number from 0 up", shown(value)));
    }
    return static_cast<float>(sharpness);
  }

  void read_sharpness(RawLattice& raw) const {
    if (root_.contains("sharp_edges")) {
      constexpr std::string_view kKey = "sharp_edges";
      const Json& list = array(kKey);
      raw.sharp_edges.emplace(list.size());
      for (std::size_t i = 0; i < list.size(); ++i) {
        const Json& element = tuple(kKey, list, i, 3, "[vertex, vertex, sharpness]");
        SharpEdge& edge = (*raw.sharp_edges)[i];
        for (std::size_t j = 0; j < 2; ++j) {
          edge.vertices[j] =
              read_index(element[j], "vertex", n_vertices_, [&] { return place(kKey, i, j); });
        }
        edge.sharpness = read_sharp(element[2], [&] { return place(kKey, i, 2); });
      }
    }
    if (root_.contains("sharp_vertices")) {
      constexpr std::string_view kKey = "sharp_vertices";
      const Json& list = array(kKey);
      raw.sharp_vertices.emplace(list.size());
      for (std::size_t i = 0; i < list.size(); ++i) {
        const Json& element = tuple(kKey, list, i, 2, "[vertex, sharpness]");
        (*raw.sharp_vertices)[i] = {
            read_index(element[0], "vertex", n_vertices_, [&] { return place(kKey, i, 0); }),
            read_sharp(element[1], [&] { return place(kKey, i, 1); })};
      }
    }
  }

  std::size_t n_vertices_ = 0;
};

template <class Range, class ToInt>
void append_indices(std::string& text, const Range& range, const ToInt& to_int) {
  bool is_first = true;
  for (const auto& element : range) {
    if (!is_first) {
      text += ',';
    }
    is_first = false;
    text += fmt::format_int(to_int(element)).c_str();
  }
}

void append_sharpness(std::string& text, const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  const Sharpness automatic = automatic_sharpness(complex);
  if (lattice.sharpness.edges != automatic.edges) {
    std::vector<EdgeId> edges;
    std::copy_if(complex.edges().begin(), complex.edges().end(), std::back_inserter(edges),
                 [&](EdgeId edge) { return lattice.sharpness.edges[edge] > 0; });
    append_json_list(text, "sharp_edges", edges.size(), [&](std::size_t i) {
      const auto& ends = complex.vertices(edges[i]);
      text += fmt::format("{},{},", ends[0].value, ends[1].value);
      append_number(text, lattice.sharpness.edges[edges[i]]);
    });
  }
  if (lattice.sharpness.vertices != automatic.vertices) {
    std::vector<VertexId> vertices;
    std::copy_if(complex.vertices().begin(), complex.vertices().end(), std::back_inserter(vertices),
                 [&](VertexId vertex) { return lattice.sharpness.vertices[vertex] > 0; });
    append_json_list(text, "sharp_vertices", vertices.size(), [&](std::size_t i) {
      text += fmt::format("{},", vertices[i].value);
      append_number(text, lattice.sharpness.vertices[vertices[i]]);
    });
  }
}

}  // namespace

RawLattice parse_json_lattice(const std::string& path, std::string_view text) {
  const Json root = parse_json_object(path, text);
  RawLattice raw = Reader(path, root).read();
  raw.extra_json = dump_foreign_keys(root, kOwnKeys);
  return raw;
}

std::string json_text(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  std::string text =
      fmt::format("{{\n  \"format\": \"{}\",\n  \"type\": \"{}\"", kJsonFormat, kType);
  text += fmt::format(",\n  \"scheme\": \"{}\"", name_of(lattice.scheme));
  append_json_list(text, "vertices", lattice.rest.size(),
                   [&](std::size_t i) { append_point(text, lattice.rest[i], ','); });
  append_json_list(text, "faces", complex.n_faces(), [&](std::size_t i) {
    append_indices(text, complex.vertices(FaceId{static_cast<std::int32_t>(i)}),
                   [](VertexId vertex) { return vertex.value; });
  });
  append_json_list(text, "cells", complex.n_cells(), [&](std::size_t i) {
    append_indices(text, complex.half_faces(CellId{static_cast<std::int32_t>(i)}),
                   [](HalfFaceId half_face) { return half_face.face().value; });
  });
  append_sharpness(text, lattice);
  if (!lattice.pose.empty()) {
    append_json_list(text, "pose", lattice.pose.size(),
                     [&](std::size_t i) { append_point(text, lattice.pose[i], ','); });
  }
  append_extra_keys(text, lattice.extra_json, kOwnKeys);
  return text + "\n}\n";
}

std::string foreign_keys(const std::string& path, std::string_view text) {
  return dump_foreign_keys(parse_json_object(path, text), kOwnKeys);
}

}  // namespace espalier
