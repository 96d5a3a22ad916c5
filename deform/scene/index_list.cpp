#include "deform/scene/index_list.h"

#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

constexpr std::int64_t kLargestIndex = 2'000'000'000;
constexpr std::int64_t kLongestRange = 10'000'000;

}  // namespace

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

std::optional<std::vector<std::int32_t>> parse_indices(const std::string& word) {
  std::vector<std::int32_t> indices;
  for (const std::string& part : words_between(word, '-')) {
    std::int64_t index = -1;
    if (!parse_integer(part, index) || index < 0 || index > kLargestIndex) {
      return std::nullopt;
    }
    indices.push_back(static_cast<std::int32_t>(index));
  }
  return indices.size() <= 2 ? std::optional(indices) : std::nullopt;
}

std::optional<std::vector<std::int32_t>> parse_index_list(const std::string& text) {
  std::vector<std::int32_t> indices;
  for (const std::string& word : words_between(text, ',')) {
    const auto ends = parse_indices(word);
    if (!ends || ends->back() < ends->front() || ends->back() - ends->front() > kLongestRange) {
      return std::nullopt;
    }
    for (std::int32_t index = ends->front(); index <= ends->back(); ++index) {
      indices.push_back(index);
    }
  }
  return indices;
}

}  // namespace espalier
