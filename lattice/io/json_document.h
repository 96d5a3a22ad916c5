#pragma once

/// JSON documents as a tree, and readers whose errors name the place. A header for sources of this
/// folder only: it includes the JSON library.

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

using Json = nlohmann::json;

inline constexpr std::string_view kJsonFormat = "espalier/1";

/// A JSON object. Throws FileError naming the line of a syntax error, and for keys given twice,
/// nesting deeper than 100 levels, and documents that are no object.
[[nodiscard]] Json parse_json_object(const std::string& path, std::string_view text);

/// A value as a message shows it.
[[nodiscard]] std::string shown(const Json& value);

/// Reads values of an object; errors name where in it they are.
class JsonReader {
 public:
  JsonReader(const std::string& path, const Json& root) : path_(path), root_(root) {}

 protected:
  [[noreturn]] void fail(std::string_view where, std::string_view what) const;

  [[nodiscard]] static std::string place(std::string_view key, std::size_t i) {
    return fmt::format("{}[{}]", key, i);
  }
  [[nodiscard]] static std::string place(std::string_view key, std::size_t i, std::size_t j) {
    return fmt::format("{}[{}][{}]", key, i, j);
  }

  /// Throws unless the object is of this format and has a type; the type's value.
  [[nodiscard]] const Json& type() const;

  /// The list of a key, of at most 2^30 elements.
  [[nodiscard]] const Json& array(std::string_view key) const;

  /// Element i of a list, itself a list of n values.
  [[nodiscard]] const Json& tuple(std::string_view key, const Json& list, std::size_t i,
                                  std::size_t n, std::string_view form) const;

  /// A number up to the largest coordinate, 1e18.
  template <class Where>
  [[nodiscard]] double coordinate(const Json& value, const Where& where) const {
    if (!value.is_number()) {
      fail(where(), fmt::format("is {}, not a number", shown(value)));
    }
    const auto number = value.get<double>();
    if (!(number >= -1e18 && number <= 1e18)) {
      fail(where(), fmt::format("is {}, beyond the largest coordinate, 1e18", shown(value)));
    }
    return number;
  }

  [[nodiscard]] std::vector<glm::dvec3> read_points(std::string_view key) const;

  const std::string& path_;
  const Json& root_;
};

/// All keys of an object but `own` ones, as a compact object; empty if there are none.
[[nodiscard]] std::string dump_foreign_keys(const Json& root,
                                            std::span<const std::string_view> own);

/// Appends those of `extra_json` that are not `own`, each on a line after a comma. Throws
/// LatticeError if it is no JSON object; empty: none.
void append_extra_keys(std::string& text, const std::string& extra_json,
                       std::span<const std::string_view> own);

/// Appends `,\n"key": [`, n lines by `append_element(i)`, and `]`.
template <class Append>
void append_json_list(std::string& text, std::string_view key, std::size_t n,
                      const Append& append_element) {
  text += fmt::format(",\n  \"{}\": [", key);
  for (std::size_t i = 0; i < n; ++i) {
    text += i == 0 ? "\n    [" : ",\n    [";
    append_element(i);
    text += ']';
  }
  text += n == 0 ? "]" : "\n  ]";
}

}  // namespace espalier
