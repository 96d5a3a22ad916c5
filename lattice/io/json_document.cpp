// JSON trees with errors fit for users.

#include "lattice/io/json_document.h"

#include <algorithm>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

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

}  // namespace

Json parse_json_object(const std::string& path, std::string_view text) {
  TreeBuilder builder(path, text);
  Json::sax_parse(text, &builder);
  Json root = builder.take();
  if (!root.is_object()) {
    throw FileError(path, fmt::format("holds {} {}, not a JSON object",
                                      root.is_array() ? "an" : "a", root.type_name()));
  }
  return root;
}

std::string shown(const Json& value) {
  return value.is_structured() ? value.type_name() : shortened(value.dump());
}

void JsonReader::fail(std::string_view where, std::string_view what) const {
  throw FileError(path_, fmt::format("{}: {}", where, what));
}

const Json& JsonReader::type() const {
  const auto format = root_.find("format");
  if (format == root_.end()) {
    throw FileError(path_,
                    fmt::format("is no lattice: \"format\": \"{}\" is missing", kJsonFormat));
  }
  if (*format != kJsonFormat) {
    fail("format", fmt::format("is {}, this version reads \"{}\"", shown(*format), kJsonFormat));
  }
  const auto found = root_.find("type");
  if (found == root_.end()) {
    throw FileError(path_, "\"type\" is missing: subdivision, bezier, bspline, nurbs or thb");
  }
  return *found;
}

const Json& JsonReader::array(std::string_view key) const {
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

const Json& JsonReader::tuple(std::string_view key, const Json& list, std::size_t i, std::size_t n,
                              std::string_view form) const {
  const Json& element = list[i];
  if (!element.is_array()) {
    fail(place(key, i), fmt::format("is {}, not {}", shown(element), form));
  }
  if (element.size() != n) {
    fail(place(key, i), fmt::format("has {} values, needs {}", element.size(), form));
  }
  return element;
}

std::vector<glm::dvec3> JsonReader::read_points(std::string_view key) const {
  const Json& list = array(key);
  std::vector<glm::dvec3> points(list.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Json& element = tuple(key, list, i, 3, "[x, y, z]");
    for (std::size_t j = 0; j < 3; ++j) {
      points[i][static_cast<int>(j)] = coordinate(element[j], [&] { return place(key, i, j); });
    }
  }
  return points;
}

std::string dump_foreign_keys(const Json& root, std::span<const std::string_view> own) {
  Json foreign = Json::object();
  for (const auto& [key, value] : root.items()) {
    if (std::find(own.begin(), own.end(), key) == own.end()) {
      foreign[key] = value;
    }
  }
  return foreign.empty() ? "" : foreign.dump();
}

void append_extra_keys(std::string& text, const std::string& extra_json,
                       std::span<const std::string_view> own) {
  if (extra_json.empty()) {
    return;
  }
  Json extra;
  try {
    extra = parse_json_object("extra_json", extra_json);
  } catch (const FileError& error) {
    throw LatticeError(error.what());
  }
  for (const auto& [key, value] : extra.items()) {
    if (std::find(own.begin(), own.end(), key) == own.end()) {
      text += ",\n  " + Json(key).dump() + ": " + value.dump();
    }
  }
}

}  // namespace espalier
