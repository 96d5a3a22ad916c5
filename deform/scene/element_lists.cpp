#include "deform/scene/element_lists.h"

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

using Indices = std::vector<std::int32_t>;

constexpr std::int64_t kLargestIndex = 2'000'000'000;
constexpr std::int64_t kLongestRange = 10'000'000;

std::vector<std::string> words_between(const std::string& text, char separator) {
  std::vector<std::string> words = {""};
  for (const char c : text) {
    if (c == separator) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// One index or two with a dash between; false for anything else.
bool parse_indices(const std::string& word, Indices& indices) {
  indices.clear();
  for (const std::string& part : words_between(word, '-')) {
    std::int64_t index = -1;
    if (!parse_integer(part, index) || index < 0 || index > kLargestIndex) {
      return false;
    }
    indices.push_back(static_cast<std::int32_t>(index));
  }
  return indices.size() <= 2;
}

}  // namespace

std::vector<std::int32_t> indices_of(const Arguments& arguments, const std::string& name) {
  Indices indices;
  if (!arguments.has(name)) {
    return indices;
  }
  for (const std::string& word : words_between(arguments.text(name), ',')) {
    Indices ends;
    if (!parse_indices(word, ends) || ends.back() < ends.front() ||
        ends.back() - ends.front() > kLongestRange) {
      throw ParameterError("'" + name + "' is " + quoted(arguments.text(name)) +
                           ", must be indices such as 0,3,7-9");
    }
    for (std::int32_t index = ends.front(); index <= ends.back(); ++index) {
      indices.push_back(index);
    }
  }
  return indices;
}

std::vector<std::array<std::int32_t, 2>> edges_of(const Arguments& arguments,
                                                  const std::string& name) {
  std::vector<std::array<std::int32_t, 2>> edges;
  if (!arguments.has(name)) {
    return edges;
  }
  for (const std::string& word : words_between(arguments.text(name), ',')) {
    Indices ends;
    if (!parse_indices(word, ends) || ends.size() != 2) {
      throw ParameterError("'" + name + "' is " + quoted(arguments.text(name)) +
                           ", must be edges by their vertices, such as 0-1,4-5");
    }
    edges.push_back({ends[0], ends[1]});
  }
  return edges;
}

}  // namespace espalier
