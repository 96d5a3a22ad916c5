// Reading and writing lattices on grids of knots.

#include "lattice/io/tensor_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/io/json_document.h"
#include "lattice/io/number_text.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, 11> kTensorKeys = {
    "format", "type",      "counts", "degree",  "ends",        "knots",
    "pose",   "thickness", "rest",   "weights", "pose_weights"};
constexpr std::array<std::string_view, 6> kThbKeys = {"format", "type",   "counts",
                                                      "degree", "levels", "points"};
constexpr std::string_view kThbType = "thb";
/// A THB file without points may ask for so many, and for so many cells beyond its points.
constexpr std::size_t kMostUnwritten = 1000000;

/// Walks the document of either type.
class Reader : public JsonReader {
 public:
  using JsonReader::JsonReader;

  std::variant<TensorLattice, ThbLattice> read() {
    if (type() == kThbType) {
      return read_thb();
    }
    const auto kind =
        type().is_string() ? tensor_kind_named(type().get_ref<const std::string&>()) : std::nullopt;
    if (!kind) {
      fail("type", fmt::format("is {}, not bezier, bspline, nurbs or thb", shown(type())));
    }
    return read_tensor(*kind);
  }

 private:
  /// Runs `work`; what it finds wrong is at `where` in the file.
  template <class Work>
  auto at(std::string_view where, const Work& work) const {
    try {
      return work();
    } catch (const LatticeError& error) {
      fail(where, error.what());
    } catch (const ParameterError& error) {
      fail(where, error.what());
    }
  }

  template <class Where>
  [[nodiscard]] int whole(const Json& value, int least, int most, const Where& where) const {
    const double number = value.is_number() ? value.get<double>() : 0.5;
    if (!(number == std::floor(number) && number >= least && number <= most)) {
      fail(where(),
           fmt::format("is {}, not a whole number from {} to {}", shown(value), least, most));
    }
    return static_cast<int>(number);
  }

  [[nodiscard]] std::array<int, 3> three(std::string_view key, int least, int most) const {
    const Json& list = array(key);
    if (list.size() != 3) {
      fail(key, fmt::format("has {} values, needs 3, one an axis", list.size()));
    }
    std::array<int, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = whole(list[i], least, most, [&] { return place(key, i); });
    }
    return result;
  }

  [[nodiscard]] std::vector<double> numbers(std::string_view key, const Json& list, bool is_nested,
                                            std::size_t axis) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < list.size(); ++i) {
      result.push_back(
          coordinate(list[i], [&] { return is_nested ? place(key, axis, i) : place(key, i); }));
    }
    return result;
  }

  [[nodiscard]] Ends read_ends(std::size_t axis) const {
    const auto found = root_.find("ends");
    if (found == root_.end()) {
      return Ends::Open;
    }
    if (found->is_array() && found->size() != 3) {
      fail("ends", fmt::format("has {} values, needs a word, or 3, one an axis", found->size()));
    }
    const Json& word = found->is_array() ? (*found)[axis] : *found;
    const auto ends =
        word.is_string() ? ends_named(word.get_ref<const std::string&>()) : std::nullopt;
    if (!ends) {
      fail(found->is_array() ? place("ends", axis) : "ends",
           fmt::format("is {}, not open, uniform, natural, tripled or periodic", shown(word)));
    }
    return *ends;
  }

  [[nodiscard]] TensorAxis read_axis(std::size_t axis, int n, int degree) const {
    const Ends ends = read_ends(axis);
    if (root_.contains("knots")) {
      const Json& lists = array("knots");
      if (lists.size() != 3 || !lists[axis].is_array()) {
        fail("knots", "is not three lists, one an axis");
      }
      if (!lists[axis].empty()) {
        std::vector<double> knots = numbers("knots", lists[axis], true, axis);
        const std::size_t n_wanted =
            static_cast<std::size_t>(n) + static_cast<std::size_t>(degree) + 1;
        if (knots.size() != n_wanted) {
          fail(place("knots", axis),
               fmt::format("has {} knots, {} control points of degree {} need {}", knots.size(), n,
                           degree, n_wanted));
        }
        return at(place("knots", axis),
                  [&] { return TensorAxis::from_knots(degree, std::move(knots)); });
      }
    }
    return at(place("counts", axis), [&] { return TensorAxis::make(n, degree, ends); });
  }

  [[nodiscard]] std::array<int, 3> read_degree(TensorKind kind,
                                               const std::array<int, 3>& counts) const {
    if (kind == TensorKind::Bezier && !root_.contains("degree")) {
      return {counts[0] - 1, counts[1] - 1, counts[2] - 1};
    }
    return three("degree", 0, kMostDegree);
  }

  [[nodiscard]] TensorLattice read_tensor(TensorKind kind) const {
    TensorLattice lattice;
    lattice.kind = kind;
    const std::array<int, 3> counts = three("counts", 1, kMostControlsOnAxis);
    const std::array<int, 3> degree = read_degree(kind, counts);
    lattice.rest = read_points("rest");
    const double n = static_cast<double>(counts[0]) * counts[1] * counts[2];
    if (static_cast<double>(lattice.rest.size()) != n) {
      fail("rest", fmt::format("has {} points, counts {} × {} × {} need {}", lattice.rest.size(),
                               counts[0], counts[1], counts[2], n));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lattice.axes[axis] = read_axis(axis, counts[axis], degree[axis]);
    }
    if (root_.contains("pose")) {
      lattice.pose = read_points("pose");
    }
    if (kind == TensorKind::Nurbs || root_.contains("weights")) {
      lattice.weights = numbers("weights", array("weights"), false, 0);
    }
    if (root_.contains("pose_weights")) {
      lattice.pose_weights = numbers("pose_weights", array("pose_weights"), false, 0);
    }
    read_thickness(lattice);
    lattice.extra_json = dump_foreign_keys(root_, kTensorKeys);
    try {
      require_valid(lattice);
    } catch (const LatticeError& error) {
      throw FileError(path_, error.what());
    }
    return lattice;
  }

  void read_thickness(TensorLattice& lattice) const {
    if (!root_.contains("thickness")) {
      return;
    }
    const Json& list = array("thickness");
    if (list.size() != 3) {
      fail("thickness", fmt::format("has {} values, needs 3, one an axis", list.size()));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!list[axis].is_null()) {
        const Json& vector = tuple("thickness", list, axis, 3, "[x, y, z] or null");
        for (std::size_t i = 0; i < 3; ++i) {
          lattice.thickness[axis][static_cast<int>(i)] =
              coordinate(vector[i], [&] { return place("thickness", axis, i); });
        }
      }
    }
  }

  [[nodiscard]] ThbLattice read_thb() const {
    const std::array<int, 3> counts = three("counts", 2, kMostControlsOnAxis);
    const std::array<int, 3> degree = three("degree", 1, 5);
    const std::size_t n_points = root_.contains("points") ? array("points").size() : kMostUnwritten;
    const double n = static_cast<double>(counts[0]) * counts[1] * counts[2];
    if (n > static_cast<double>(n_points)) {  // refining never leaves fewer control points
      fail("counts", fmt::format("ask for {} control points or more, {}", n,
                                 root_.contains("points")
                                     ? fmt::format("there are {}", n_points)
                                     : fmt::format("without points at most {}", kMostUnwritten)));
    }
    auto hierarchy = std::make_shared<const ThbHierarchy>(
        at("counts", [&] { return ThbHierarchy(counts, degree); }));
    if (root_.contains("levels")) {
      hierarchy = read_levels(*hierarchy, n_points);
    }
    ThbLattice lattice;
    if (root_.contains("points")) {
      lattice.hierarchy = std::move(hierarchy);
      read_thb_points(lattice);
    } else {
      lattice = refined_to(make_thb_lattice(counts, degree, {}), std::move(hierarchy));
    }
    lattice.extra_json = dump_foreign_keys(root_, kThbKeys);
    return lattice;
  }

  /// Lists of boxes; the first is that of level 1.
  [[nodiscard]] std::shared_ptr<const ThbHierarchy> read_levels(const ThbHierarchy& root,
                                                                std::size_t n_points) const {
    const Json& levels = array("levels");
    if (levels.size() >= static_cast<std::size_t>(kMostThbLevels)) {
      fail("levels", fmt::format("has {} lists, at most {}", levels.size(), kMostThbLevels - 1));
    }
    double n_cells = 0;
    std::vector<std::vector<GridIndex>> domains(levels.size());
    for (std::size_t l = 0; l < levels.size(); ++l) {
      if (!levels[l].is_array()) {
        fail(place("levels", l), fmt::format("is {}, not a list of boxes", shown(levels[l])));
      }
      std::array<int, 3> n = root.n_cells(0);
      for (int& n_along : n) {
        n_along <<= l;
      }
      for (std::size_t b = 0; b < levels[l].size(); ++b) {
        const auto [low, high] = read_box(levels[l][b], l, b);
        const glm::dvec3 size = (high - low) * glm::dvec3(n[0], n[1], n[2]);
        n_cells += std::abs(size.x * size.y * size.z);
        if (n_cells > static_cast<double>(std::max(kMostUnwritten, 8 * n_points))) {
          fail(place("levels", l, b), fmt::format("brings the cells to {:.0f}, too many", n_cells));
        }
        const auto cells = at(place("levels", l, b),
                              [&, low = low, high = high] { return cells_of_box(n, low, high); });
        domains[l].insert(domains[l].end(), cells.begin(), cells.end());
      }
    }
    return at("levels", [&] {
      return std::make_shared<const ThbHierarchy>(root.counts(), root.degree(), std::move(domains));
    });
  }

  [[nodiscard]] std::pair<glm::dvec3, glm::dvec3> read_box(const Json& box, std::size_t level,
                                                           std::size_t number) const {
    std::array<glm::dvec3, 2> corners{};
    const auto where = [&] { return place("levels", level, number); };
    const bool is_box = box.is_array() && box.size() == 2 &&
                        std::all_of(box.begin(), box.end(), [](const Json& corner) {
                          return corner.is_array() && corner.size() == 3;
                        });
    if (!is_box) {
      fail(where(), "is not a box: [[u0, v0, w0], [u1, v1, w1]]");
    }
    for (std::size_t end = 0; end < 2; ++end) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[end][static_cast<int>(axis)] = coordinate(box[end][axis], where);
      }
    }
    return {corners[0], corners[1]};
  }

  /// Each control point of the hierarchy once.
  void read_thb_points(ThbLattice& lattice) const {
    constexpr std::string_view kForm = "[level, i, j, k, rx, ry, rz, px, py, pz]";
    const Json& list = array("points");
    const auto& controls = lattice.hierarchy->controls();
    if (list.size() != controls.size()) {
      fail("points",
           fmt::format("has {} control points, the levels have {}", list.size(), controls.size()));
    }
    lattice.rest.resize(controls.size());
    lattice.pose.resize(controls.size());
    std::vector<bool> is_given(controls.size(), false);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Json& row = tuple("points", list, i, 10, kForm);
      std::array<int, 4> index{};
      for (std::size_t j = 0; j < 4; ++j) {
        index[j] = whole(row[j], 0, 1 << 21, [&] { return place("points", i, j); });
      }
      const std::size_t control = find(lattice, index, i);
      if (is_given[control]) {
        fail(place("points", i), "is given twice");
      }
      is_given[control] = true;
      for (std::size_t j = 4; j < 10; ++j) {
        auto& points = j < 7 ? lattice.rest : lattice.pose;
        points[control][static_cast<int>((j - 4) % 3)] =
            coordinate(row[j], [&] { return place("points", i, j); });
      }
    }
    if (lattice.pose == lattice.rest) {
      lattice.pose.clear();
    }
  }

  [[nodiscard]] std::size_t find(const ThbLattice& lattice, const std::array<int, 4>& index,
                                 std::size_t row) const {
    const auto& controls = lattice.hierarchy->controls();
    const ThbFunction wanted = {index[0], {index[1], index[2], index[3]}};
    const auto found = std::lower_bound(
        controls.begin(), controls.end(), wanted, [](const ThbFunction& a, const ThbFunction& b) {
          return a.level != b.level ? a.level < b.level : a.index < b.index;
        });
    if (found == controls.end() || *found != wanted) {
      fail(place("points", row), fmt::format("({}, {}, {}) is no control point of level {}",
                                             index[1], index[2], index[3], index[0]));
    }
    return static_cast<std::size_t>(found - controls.begin());
  }
};

void append_start(std::string& text, std::string_view type, const std::array<int, 3>& counts,
                  const std::array<int, 3>& degree) {
  text += fmt::format("{{\n  \"format\": \"{}\",\n  \"type\": \"{}\"", kJsonFormat, type);
  text += fmt::format(",\n  \"counts\": [{},{},{}]", counts[0], counts[1], counts[2]);
  text += fmt::format(",\n  \"degree\": [{},{},{}]", degree[0], degree[1], degree[2]);
}

void append_points(std::string& text, std::string_view key, const std::vector<glm::dvec3>& points) {
  append_json_list(text, key, points.size(),
                   [&](std::size_t i) { append_point(text, points[i], ','); });
}

void append_numbers(std::string& text, std::span<const double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += i == 0 ? "" : ",";
    append_number(text, numbers[i]);
  }
}

void append_axes(std::string& text, const TensorLattice& lattice) {
  std::string ends;
  std::string knots;
  std::string thickness;
  bool has_knots = false;
  bool has_thickness = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const TensorAxis& along = lattice.axes[axis];
    const bool is_explicit = along.ends() == Ends::Explicit;
    const std::string comma = axis == 0 ? "" : ",";
    ends += fmt::format("{}\"{}\"", comma, name_of(is_explicit ? Ends::Open : along.ends()));
    knots += comma + "[";
    if (is_explicit) {
      append_numbers(knots, along.knots());
      has_knots = true;
    }
    knots += "]";
    const bool is_thick = lattice.thickness[axis] != glm::dvec3(0);
    thickness += comma + (is_thick ? "[" : "null");
    if (is_thick) {
      append_point(thickness, lattice.thickness[axis], ',');
      thickness += "]";
      has_thickness = true;
    }
  }
  text += ",\n  \"ends\": [" + ends + "]";
  text += has_knots ? ",\n  \"knots\": [" + knots + "]" : "";
  text += has_thickness ? ",\n  \"thickness\": [" + thickness + "]" : "";
}

/// Cells of one domain as few boxes: runs along u, joined along v and then along w.
struct CellBox {
  GridIndex low;
  GridIndex high;  // the last cell
};

std::vector<CellBox> boxes_of(std::span<const GridIndex> cells) {
  std::vector<CellBox> runs;
  for (const GridIndex& cell : cells) {
    const bool goes_on = !runs.empty() && runs.back().high.j == cell.j &&
                         runs.back().high.k == cell.k && runs.back().high.i + 1 == cell.i;
    if (goes_on) {
      runs.back().high.i = cell.i;
    } else {
      runs.push_back({cell, cell});
    }
  }
  const auto joined = [](std::vector<CellBox> boxes, std::size_t axis) {
    const auto key = [axis](const CellBox& box) {
      const std::size_t other = axis == 1 ? 2 : 1;
      return std::array{box.low.i, box.high.i, box.low[other], box.high[other], box.low[axis]};
    };
    std::sort(boxes.begin(), boxes.end(),
              [&](const CellBox& a, const CellBox& b) { return key(a) < key(b); });
    std::vector<CellBox> result;
    for (const CellBox& box : boxes) {
      if (!result.empty()) {
        auto last = key(result.back());
        auto next = key(box);
        last[4] = result.back().high[axis] + 1;
        if (last == next) {
          result.back().high = box.high;
          continue;
        }
      }
      result.push_back(box);
    }
    return result;
  };
  return joined(joined(std::move(runs), 1), 2);
}

void append_levels(std::string& text, const ThbHierarchy& hierarchy) {
  append_json_list(
      text, "levels", static_cast<std::size_t>(hierarchy.n_levels() - 1), [&](std::size_t i) {
        const int level = static_cast<int>(i) + 1;
        const std::array<int, 3> n = hierarchy.n_cells(level - 1);
        bool is_first = true;
        for (const CellBox& box : boxes_of(hierarchy.domain(level))) {
          text += is_first ? "[[" : ",[[";
          is_first = false;
          const glm::dvec3 size(n[0], n[1], n[2]);
          append_point(text, glm::dvec3(box.low.i, box.low.j, box.low.k) / size, ',');
          text += "],[";
          append_point(text, glm::dvec3(box.high.i + 1, box.high.j + 1, box.high.k + 1) / size,
                       ',');
          text += "]]";
        }
      });
}

}  // namespace

bool is_tensor_json(const std::string& path, std::string_view text) {
  const Json root = parse_json_object(path, text);
  const auto type = root.find("type");
  return type != root.end() && type->is_string() &&
         (*type == kThbType || tensor_kind_named(type->get_ref<const std::string&>()));
}

std::variant<TensorLattice, ThbLattice> parse_json_tensor(const std::string& path,
                                                          std::string_view text) {
  const Json root = parse_json_object(path, text);
  return Reader(path, root).read();
}

std::string json_text(const TensorLattice& lattice) {
  require_valid(lattice);
  std::string text;
  append_start(text, name_of(lattice.kind), lattice.counts(),
               {lattice.axes[0].degree(), lattice.axes[1].degree(), lattice.axes[2].degree()});
  append_axes(text, lattice);
  append_points(text, "rest", lattice.rest);
  if (!lattice.pose.empty()) {
    append_points(text, "pose", lattice.pose);
  }
  for (const auto& [key, weights] :
       {std::pair("weights", &lattice.weights), std::pair("pose_weights", &lattice.pose_weights)}) {
    if (!weights->empty()) {
      text += fmt::format(",\n  \"{}\": [", key);
      append_numbers(text, *weights);
      text += "]";
    }
  }
  append_extra_keys(text, lattice.extra_json, kTensorKeys);
  return text + "\n}\n";
}

std::string json_text(const ThbLattice& lattice) {
  require_valid(lattice);
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  std::string text;
  append_start(text, kThbType, hierarchy.counts(), hierarchy.degree());
  append_levels(text, hierarchy);
  append_json_list(text, "points", lattice.rest.size(), [&](std::size_t i) {
    const ThbFunction& control = hierarchy.controls()[i];
    text += fmt::format("{},{},{},{},", control.level, control.index.i, control.index.j,
                        control.index.k);
    append_point(text, lattice.rest[i], ',');
    text += ',';
    append_point(text, lattice.posed_points()[i], ',');
  });
  append_extra_keys(text, lattice.extra_json, kThbKeys);
  return text + "\n}\n";
}

}  // namespace espalier
