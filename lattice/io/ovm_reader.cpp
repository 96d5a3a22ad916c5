#include "lattice/io/ovm_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lattice/core/text_scanner.h"
#include "lattice/io/json_lattice.h"

namespace espalier {
namespace {

/// Fewest bytes of a line of each section but for its end: "0 0 0", "0 1", "3 0 2 4", "4 0 2 4 6".
constexpr std::size_t kVertexBytes = 5;
constexpr std::size_t kEdgeBytes = 3;
constexpr std::size_t kFaceBytes = 1;
constexpr std::size_t kCellBytes = 1;

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

/// How the values of a property type are laid out.
enum class Layout { Line, Character, String, List, ListOfLists, Map };

Layout layout_of(std::string_view type) {
  if (type == "string") {
    return Layout::String;
  }
  if (type == "char" || type == "uchar") {
    return Layout::Character;
  }
  if (type == "map_he_int" || type == "map_heh_int") {
    return Layout::Map;
  }
  if (type.starts_with("vector_vector_")) {
    return Layout::ListOfLists;
  }
  return type.starts_with("vector_") ? Layout::List : Layout::Line;
}

/// Reads one file from top to bottom.
class OvmReader {
 public:
  OvmReader(const std::string& path, std::string_view text) : path_(path), scanner_(path, text) {}

  RawLattice read() {
    read_header();
    read_vertices();
    read_edges();
    read_faces();
    read_cells();
    while (next_content_line()) {
      read_property();
    }
    orient(raw_.polyhedra, raw_.rest);
    return std::move(raw_);
  }

 private:
  // Lines.

  /// Moves to the next line that is neither blank nor a comment.
  bool next_content_line() {
    while (scanner_.next_line()) {
      const std::size_t begin = scanner_.line().find_first_not_of(" \t\f\v");
      if (begin != std::string_view::npos && scanner_.line()[begin] != '#') {
        return true;
      }
    }
    return false;
  }
  bool next_nonblank_line() {
    while (scanner_.next_line()) {
      if (scanner_.line().find_first_not_of(" \t\f\v") != std::string_view::npos) {
        return true;
      }
    }
    return false;
  }
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> what, Args&&... args) const {
    scanner_.fail(fmt::format(what, std::forward<Args>(args)...));
  }
  void expect_element(std::string_view name, std::size_t i, std::size_t n) {
    if (!next_content_line()) {
      fail("the file ends after {} of {} {}", i, n, name);
    }
  }

  void read_header() {
    if (!next_content_line()) {
      throw FileError(path_, "is empty, needs the header \"OVM ASCII\"");
    }
    const std::string kind = lower_case(scanner_.next_word());
    const std::string coding = lower_case(scanner_.next_word());
    if (kind.starts_with("ovmb") || (kind == "ovm" && coding == "binary")) {
      throw FileError(path_, "is binary OpenVolumeMesh; only \"OVM ASCII\" is read");
    }
    if (kind != "ovm" || coding != "ascii") {
      fail("is no OpenVolumeMesh file: needs the header \"OVM ASCII\"");
    }
    scanner_.expect_end_of_line("the header");
  }

  /// Reads "NAME" and the count on the next line, which the bytes left must allow.
  std::size_t read_section(std::string_view name, std::size_t fewest_bytes) {
    if (!next_content_line()) {
      fail("the file ends before the section {}", name);
    }
    const std::string_view word = scanner_.next_word();
    if (lower_case(word) != lower_case(name)) {
      fail("expected the section {}", name);
    }
    scanner_.expect_end_of_line(name);
    if (!next_content_line()) {
      fail("the file ends before the number of {}", lower_case(name));
    }
    const std::int64_t n = scanner_.next_integer(fmt::format("number of {}", lower_case(name)));
    scanner_.expect_end_of_line("a number of elements");
    if (n < 0) {
      fail("number of {} is negative: {}", lower_case(name), n);
    }
    const std::size_t most =
        std::min(scanner_.bytes_left() / (fewest_bytes + 1) + 1, std::size_t{1} << 30);
    if (static_cast<std::size_t>(n) > most) {
      fail("announces {} {}, more than the {} bytes left can hold", n, lower_case(name),
           scanner_.bytes_left());
    }
    return static_cast<std::size_t>(n);
  }

  /// An index below n of what `element` names.
  std::int32_t read_index(std::string_view element, std::size_t n) {
    const std::int64_t index = scanner_.next_integer(element);
    if (index < 0 || index >= static_cast<std::int64_t>(n)) {
      fail("{} {} does not exist, there are {}{}", element, index, n,
           n == 0 ? "" : fmt::format(" (0…{})", n - 1));
    }
    return static_cast<std::int32_t>(index);
  }

  glm::dvec3 read_point() {
    glm::dvec3 point;
    point.x = scanner_.next_coordinate("x");
    point.y = scanner_.next_coordinate("y");
    point.z = scanner_.next_coordinate("z");
    scanner_.expect_end_of_line("a point");
    return point;
  }

  // Sections.

  void read_vertices() {
    const std::size_t n = read_section("Vertices", kVertexBytes);
    raw_.rest.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      expect_element("vertices", i, n);
      raw_.rest.push_back(read_point());
    }
  }

  void read_edges() {
    const std::size_t n = read_section("Edges", kEdgeBytes);
    edges_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      expect_element("edges", i, n);
      const std::int32_t from = read_index("vertex", raw_.rest.size());
      const std::int32_t to = read_index("vertex", raw_.rest.size());
      if (from == to) {
        fail("edge {} joins vertex {} to itself", i, from);
      }
      scanner_.expect_end_of_line("an edge");
      edges_.push_back({from, to});
    }
    expect_distinct_edges();
  }

  void expect_distinct_edges() const {
    std::vector<std::array<std::int32_t, 3>> sorted;
    sorted.reserve(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto [a, b] = std::minmax(edges_[i][0], edges_[i][1]);
      sorted.push_back({a, b, static_cast<std::int32_t>(i)});
    }
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(
        sorted.begin(), sorted.end(),
        [](const auto& a, const auto& b) { return a[0] == b[0] && a[1] == b[1]; });
    if (twice != sorted.end()) {
      throw FileError(path_, fmt::format("edges {} and {} both join vertices {} and {}",
                                         (*twice)[2], twice[1][2], (*twice)[0], (*twice)[1]));
    }
  }

  void read_faces() {
    const std::size_t n = read_section("Faces", kFaceBytes);
    std::vector<bool> is_used(edges_.size(), false);
    std::vector<std::int32_t> loop;
    for (std::size_t i = 0; i < n; ++i) {
      expect_element("faces", i, n);
      read_loop(i, loop, is_used);
      raw_.polyhedra.faces.push_back(loop);
    }
    const auto unused = std::find(is_used.begin(), is_used.end(), false);
    if (unused != is_used.end()) {
      const auto& ends = edges_[static_cast<std::size_t>(unused - is_used.begin())];
      throw FileError(path_, fmt::format("edge {} ({}-{}) belongs to no face",
                                         unused - is_used.begin(), ends[0], ends[1]));
    }
  }

  /// Half-edges as the loop of the vertices where they begin; each must begin where the one before
  /// it ends.
  void read_loop(std::size_t face, std::vector<std::int32_t>& loop, std::vector<bool>& is_used) {
    const std::int64_t n = scanner_.next_integer("number of half-edges");
    loop.clear();
    std::int32_t end = -1;
    for (std::int64_t j = 0; j < n; ++j) {
      const auto half_edge = static_cast<std::size_t>(read_index("half-edge", 2 * edges_.size()));
      const auto& ends = edges_[half_edge / 2];
      is_used[half_edge / 2] = true;
      const std::int32_t begin = ends[half_edge % 2];
      if (j > 0 && begin != end) {
        fail("face {}: half-edge {} begins at vertex {}, the one before it ends at {}", face,
             half_edge, begin, end);
      }
      end = ends[1 - half_edge % 2];
      loop.push_back(begin);
    }
    if (n > 0 && end != loop.front()) {
      fail("face {}: its half-edges end at vertex {}, not at {} where they began", face, end,
           loop.front());
    }
    scanner_.expect_end_of_line("the half-edges of a face");
  }

  void read_cells() {
    const std::size_t n = read_section("Polyhedra", kCellBytes);
    const std::size_t n_faces = raw_.polyhedra.faces.n_rows();
    CompressedRows<std::int32_t> cells;
    std::vector<std::int32_t> row;
    for (std::size_t i = 0; i < n; ++i) {
      expect_element("polyhedra", i, n);
      const std::int64_t n_half_faces = scanner_.next_integer("number of half-faces");
      row.clear();
      for (std::int64_t j = 0; j < n_half_faces; ++j) {
        row.push_back(read_index("half-face", 2 * n_faces) / 2);
      }
      scanner_.expect_end_of_line("the half-faces of a cell");
      cells.push_back(row);
    }
    n_cells_ = n;
    raw_.polyhedra = polyhedra_from_faces(static_cast<std::int32_t>(raw_.rest.size()),
                                          std::move(raw_.polyhedra.faces), cells);
  }

  // Properties.

  /// Values that a property of this kind of element has.
  [[nodiscard]] std::size_t n_values(std::string_view entity) const {
    const std::size_t n_faces = raw_.polyhedra.faces.n_rows();
    const std::array<std::pair<std::string_view, std::size_t>, 7> counts = {
        {{"vprop", raw_.rest.size()},
         {"eprop", edges_.size()},
         {"heprop", 2 * edges_.size()},
         {"fprop", n_faces},
         {"hfprop", 2 * n_faces},
         {"cprop", n_cells_},
         {"mprop", 1}}};
    for (const auto& [name, n] : counts) {
      if (name == entity) {
        return n;
      }
    }
    fail("expected a property (VProp, EProp, HEProp, FProp, HFProp, CProp or MProp) or the end");
  }

  void read_property() {
    const std::string entity = lower_case(scanner_.next_word());
    const std::size_t n = n_values(entity);
    const std::string type = lower_case(scanner_.next_word());
    const std::string_view line = scanner_.line();
    const std::size_t begin = line.find('"');
    const std::size_t end = line.rfind('"');
    if (type.empty() || begin == end) {
      fail("a property needs a type and a name in double quotes");
    }
    const std::string_view name = line.substr(begin + 1, end - begin - 1);
    if (!name.starts_with("espalier:") || !read_own_property(entity, type, name, n)) {
      skip_values(type, name, n);
    }
  }

  /// Reads a property of ours; false if it is none.
  bool read_own_property(std::string_view entity, std::string_view type, std::string_view name,
                         std::size_t n) {
    const bool is_number = type == "float" || type == "double";
    const auto is = [&](std::string_view its_entity, std::string_view its_name) {
      return entity == its_entity && name == its_name;
    };
    if (is("mprop", "espalier:scheme") && type == "string") {
      read_scheme(read_string(name));
    } else if (is("mprop", "espalier:extra") && type == "string") {
      raw_.extra_json = foreign_keys(path_, read_string(name));
    } else if (is("eprop", "espalier:sharpness") && is_number) {
      raw_.sharp_edges.emplace();
      read_sharpness(name, n, [&](std::size_t i, float sharpness) {
        raw_.sharp_edges->push_back({edges_[i], sharpness});
      });
    } else if (is("vprop", "espalier:sharpness") && is_number) {
      raw_.sharp_vertices.emplace();
      read_sharpness(name, n, [&](std::size_t i, float sharpness) {
        raw_.sharp_vertices->push_back({static_cast<std::int32_t>(i), sharpness});
      });
    } else if (is("vprop", "espalier:pose") && (type == "vec3d" || type == "vec3f")) {
      raw_.pose.clear();
      for (std::size_t i = 0; i < n; ++i) {
        expect_value(name, i, n);
        raw_.pose.push_back(read_point());
      }
    } else {
      return false;
    }
    return true;
  }

  void expect_value(std::string_view name, std::size_t i, std::size_t n) {
    if (!next_nonblank_line()) {
      fail("the file ends after {} of {} values of property \"{}\"", i, n, name);
    }
  }

  void read_scheme(std::string_view name) {
    const std::optional<Scheme> scheme = scheme_named(name);
    if (!scheme) {
      fail("the scheme is neither catmull-clark nor mj96");
    }
    raw_.scheme = *scheme;
  }

  /// Calls add(i, sharpness) for every value but zero.
  template <class Add>
  void read_sharpness(std::string_view name, std::size_t n, const Add& add) {
    for (std::size_t i = 0; i < n; ++i) {
      expect_value(name, i, n);
      const double sharpness = scanner_.next_number("sharpness");
      scanner_.expect_end_of_line("a sharpness");
      if (!(sharpness >= 0) || sharpness > static_cast<double>(std::numeric_limits<float>::max())) {
        fail("sharpness {} is not a finite number from 0 up", sharpness);
      }
      if (sharpness > 0) {
        add(i, static_cast<float>(sharpness));
      }
    }
  }

  /// The one string of a property of the mesh.
  std::string_view read_string(std::string_view name) {
    expect_value(name, 0, 1);
    const std::string_view value = next_string(name);
    scanner_.expect_end_of_line("a string");
    return value;
  }

  /// "LENGTH:BYTES" from the current place; the bytes may hold line ends.
  std::string_view next_string(std::string_view name) {
    const std::string_view line = scanner_.line();
    const std::size_t colon = line.find(':');
    const std::size_t begin = std::min(line.find_first_not_of(" \t\f\v"), line.size());
    std::int64_t length = 0;
    if (colon == std::string_view::npos ||
        !parse_integer(line.substr(begin, colon - begin), length) || length < 0) {
      fail("property \"{}\": expected a string as LENGTH:TEXT", name);
    }
    (void)scanner_.next_bytes(colon + 1);
    if (static_cast<std::size_t>(length) > scanner_.bytes_left()) {
      fail("property \"{}\": the file ends inside a string of {} bytes", name, length);
    }
    return scanner_.next_bytes(static_cast<std::size_t>(length));
  }

  void skip_values(std::string_view type, std::string_view name, std::size_t n) {
    const Layout layout = layout_of(type);
    for (std::size_t i = 0; i < n; ++i) {
      if (layout == Layout::Character ? !scanner_.next_line() : !next_nonblank_line()) {
        fail("the file ends after {} of {} values of property \"{}\"", i, n, name);
      }
      if (layout == Layout::String) {
        (void)next_string(name);
      } else if (layout != Layout::Line && layout != Layout::Character) {
        skip_list(layout, name);
      }
    }
  }

  /// Skips a length and as many entries, by words and lines alike.
  void skip_list(Layout layout, std::string_view name) {
    const std::size_t n = next_length(name);
    for (std::size_t i = 0; i < n; ++i) {
      if (layout == Layout::ListOfLists) {
        skip_list(Layout::List, name);
        continue;
      }
      (void)next_word_anywhere(name);
      if (layout == Layout::Map) {
        (void)next_word_anywhere(name);
      }
    }
  }

  std::size_t next_length(std::string_view name) {
    std::int64_t n = -1;
    if (!parse_integer(next_word_anywhere(name), n) || n < 0) {
      fail("property \"{}\": expected the length of a list", name);
    }
    return static_cast<std::size_t>(n);
  }

  std::string_view next_word_anywhere(std::string_view name) {
    while (true) {
      if (const std::string_view word = scanner_.next_word(); !word.empty()) {
        return word;
      }
      if (!scanner_.next_line()) {
        fail("the file ends inside property \"{}\"", name);
      }
    }
  }

  const std::string& path_;
  TextScanner scanner_;
  RawLattice raw_;
  std::vector<std::array<std::int32_t, 2>> edges_;
  std::size_t n_cells_ = 0;
};

}  // namespace

RawLattice parse_ovm(const std::string& path, std::string_view text) {
  return OvmReader(path, text).read();
}

}  // namespace espalier
