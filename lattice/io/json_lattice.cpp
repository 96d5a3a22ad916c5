#include "lattice/io/json_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/io/number_text.h"

namespace espalier {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kFormat = "espalier/1";
constexpr std::string_view kType = "subdivision";
constexpr std::array<std::string_view, 9> kOwnKeys = {"format",      "type",           "scheme",
                                                      "vertices",    "faces",          "cells",
                                                      "sharp_edges", "sharp_vertices", "pose"};
/// Half-faces are counted in 32 bits.
constexpr std::size_t kMostElements = std::size_t{1} << 30;

/// A text cut to a length that fits a message, never inside a character.
std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 120;
  if (text.size() > kLongest) {
    text.resize(kLongest);
    while (!text.empty() && (text.back() & 0x80) != 0) {
      text.pop_back();
    }
    text += "…";
  }
  return text;
}

/// Builds the document tree and refuses what a plain parse would accept: keys given twice and
/// nesting so deep that walking the tree would exhaust the stack.
class TreeBuilder final : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  [[nodiscard]] Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const auto [member, is_new] = open_.back()->get_ref<Json::object_t&>().emplace(name, nullptr);
    if (!is_new) {
      throw FileError(path_, fmt::format("the key \"{}\" is given twice", shortened(name)));
    }
    member_ = &member->second;
    return true;
  }

  bool parse_error(std::size_t place, const std::string&,
                   const nlohmann::detail::exception& error) override {
    const auto end = text_.begin() +
                     static_cast<std::ptrdiff_t>(std::min(place > 0 ? place - 1 : 0, text_.size()));
    const auto line = static_cast<std::size_t>(std::count(text_.begin(), end, '\n')) + 1;
    std::string what = error.what();
    for (const std::string_view start : {": syntax error", "number overflow"}) {
      if (const std::size_t at = what.find(start); at != std::string::npos) {
        what.erase(0, what.find_first_not_of(": ", at));
        break;
      }
    }
    throw FileError(path_, line, "is not valid JSON: " + shortened(std::move(what)));
  }

 private:
  Json& place_for_value() {
    if (open_.empty()) {
      return root_;
    }
    if (open_.back()->is_object()) {
      return *member_;
    }
    return open_.back()->get_ref<Json::array_t&>().emplace_back();
  }
  template <class Value>
  bool add(Value&& value) {
    place_for_value() = std::forward<Value>(value);
    return true;
  }
  bool open(Json&& container) {
    constexpr std::size_t kDeepest = 100;
    if (open_.size() == kDeepest) {
      throw FileError(path_, fmt::format("is nested deeper than {} levels", kDeepest));
    }
    Json& place = place_for_value();
    place = std::move(container);
    open_.push_back(&place);
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& path_;
  std::string_view text_;
  Json root_;
  std::vector<Json*> open_;
  Json* member_ = nullptr;
};

Json parse_object(const std::string& path, std::string_view text) {
  TreeBuilder builder(path, text);
  Json::sax_parse(text, &builder);
  Json root = builder.take();
  if (!root.is_object()) {
    throw FileError(path, fmt::format("holds {} {}, not a JSON object",
                                      root.is_array() ? "an" : "a", root.type_name()));
  }
  return root;
}

/// Walks the document; errors name where in it they are.
class Reader {
 public:
  Reader(const std::string& path, const Json& root) : path_(path), root_(root) {}

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
  [[noreturn]] void fail(std::string_view where, std::string_view what) const {
    throw FileError(path_, fmt::format("{}: {}", where, what));
  }

  [[nodiscard]] static std::string place(std::string_view key, std::size_t i) {
    return fmt::format("{}[{}]", key, i);
  }
  [[nodiscard]] static std::string place(std::string_view key, std::size_t i, std::size_t j) {
    return fmt::format("{}[{}][{}]", key, i, j);
  }
  /// A value as a message shows it.
  [[nodiscard]] static std::string shown(const Json& value) {
    return value.is_structured() ? value.type_name() : shortened(value.dump());
  }

  void check_kind() const {
    const auto format = root_.find("format");
    if (format == root_.end()) {
      throw FileError(path_, fmt::format("is no lattice: \"format\": \"{}\" is missing", kFormat));
    }
    if (*format != kFormat) {
      fail("format", fmt::format("is {}, this version reads \"{}\"", shown(*format), kFormat));
    }
    const auto type = root_.find("type");
    if (type == root_.end()) {
      throw FileError(path_, fmt::format("\"type\": \"{}\" is missing", kType));
    }
    if (*type != kType) {
      fail("type", fmt::format("is {}, this version reads \"{}\" only", shown(*type), kType));
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

  [[nodiscard]] const Json& array(std::string_view key) const {
    const auto found = root_.find(key);
    if (found == root_.end()) {
      throw FileError(path_, fmt::format("\"{}\" is missing", key));
    }
    if (!found->is_array()) {
      fail(key, fmt::format("is {}, not a list", shown(*found)));
    }
    if (found->size() > kMostElements) {
      fail(key, fmt::format("has {} elements, at most 2^30 are supported", found->size()));
    }
    return *found;
  }

  /// Element i of a list, itself a list of n values.
  [[nodiscard]] const Json& tuple(std::string_view key, const Json& list, std::size_t i,
                                  std::size_t n, std::string_view form) const {
    const Json& element = list[i];
    if (!element.is_array()) {
      fail(place(key, i), fmt::format("is {}, not {}", shown(element), form));
    }
    if (element.size() != n) {
      fail(place(key, i), fmt::format("has {} values, needs {}", element.size(), form));
    }
    return element;
  }

  [[nodiscard]] std::vector<glm::dvec3> read_points(std::string_view key) const {
    const Json& list = array(key);
    std::vector<glm::dvec3> points(list.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Json& element = tuple(key, list, i, 3, "[x, y, z]");
      for (std::size_t j = 0; j < 3; ++j) {
        if (!element[j].is_number()) {
          fail(place(key, i, j), fmt::format("is {}, not a number", shown(element[j])));
        }
        const auto number = element[j].get<double>();
        if (!(std::abs(number) <= kLargestCoordinate)) {
          fail(place(key, i, j),
               fmt::format("is {}, beyond the largest coordinate, 1e18", shown(element[j])));
        }
        points[i][static_cast<int>(j)] = number;
      }
    }
    return points;
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

  const std::string& path_;
  const Json& root_;
  std::size_t n_vertices_ = 0;
};

bool is_own_key(std::string_view key) {
  return std::find(kOwnKeys.begin(), kOwnKeys.end(), key) != kOwnKeys.end();
}

std::string dump_foreign_keys(const Json& root) {
  Json foreign = Json::object();
  for (const auto& [key, value] : root.items()) {
    if (!is_own_key(key)) {
      foreign[key] = value;
    }
  }
  return foreign.empty() ? "" : foreign.dump();
}

/// Appends `,\n"key": [`, n lines by `append_element(i)`, and `]`.
template <class Append>
void append_list(std::string& text, std::string_view key, std::size_t n, const Append& append) {
  text += fmt::format(",\n  \"{}\": [", key);
  for (std::size_t i = 0; i < n; ++i) {
    text += i == 0 ? "\n    [" : ",\n    [";
    append(i);
    text += ']';
  }
  text += n == 0 ? "]" : "\n  ]";
}

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
    append_list(text, "sharp_edges", edges.size(), [&](std::size_t i) {
      const auto& ends = complex.vertices(edges[i]);
      text += fmt::format("{},{},", ends[0].value, ends[1].value);
      append_number(text, lattice.sharpness.edges[edges[i]]);
    });
  }
  if (lattice.sharpness.vertices != automatic.vertices) {
    std::vector<VertexId> vertices;
    std::copy_if(complex.vertices().begin(), complex.vertices().end(), std::back_inserter(vertices),
                 [&](VertexId vertex) { return lattice.sharpness.vertices[vertex] > 0; });
    append_list(text, "sharp_vertices", vertices.size(), [&](std::size_t i) {
      text += fmt::format("{},", vertices[i].value);
      append_number(text, lattice.sharpness.vertices[vertices[i]]);
    });
  }
}

void append_extra_keys(std::string& text, const std::string& extra_json) {
  if (extra_json.empty()) {
    return;
  }
  Json extra;
  try {
    extra = parse_object("extra_json", extra_json);
  } catch (const FileError& error) {
    throw LatticeError(error.what());
  }
  for (const auto& [key, value] : extra.items()) {
    if (!is_own_key(key)) {
      text += ",\n  " + Json(key).dump() + ": " + value.dump();
    }
  }
}

}  // namespace

RawLattice parse_json_lattice(const std::string& path, std::string_view text) {
  const Json root = parse_object(path, text);
  RawLattice raw = Reader(path, root).read();
  raw.extra_json = dump_foreign_keys(root);
  return raw;
}

std::string json_text(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  std::string text = fmt::format("{{\n  \"format\": \"{}\",\n  \"type\": \"{}\"", kFormat, kType);
  text += fmt::format(",\n  \"scheme\": \"{}\"", name_of(lattice.scheme));
  append_list(text, "vertices", lattice.rest.size(),
              [&](std::size_t i) { append_point(text, lattice.rest[i], ','); });
  append_list(text, "faces", complex.n_faces(), [&](std::size_t i) {
    append_indices(text, complex.vertices(FaceId{static_cast<std::int32_t>(i)}),
                   [](VertexId vertex) { return vertex.value; });
  });
  append_list(text, "cells", complex.n_cells(), [&](std::size_t i) {
    append_indices(text, complex.half_faces(CellId{static_cast<std::int32_t>(i)}),
                   [](HalfFaceId half_face) { return half_face.face().value; });
  });
  append_sharpness(text, lattice);
  if (!lattice.pose.empty()) {
    append_list(text, "pose", lattice.pose.size(),
                [&](std::size_t i) { append_point(text, lattice.pose[i], ','); });
  }
  append_extra_keys(text, lattice.extra_json);
  return text + "\n}\n";
}

std::string foreign_keys(const std::string& path, std::string_view text) {
  return dump_foreign_keys(parse_object(path, text));
}

}  // namespace espalier
