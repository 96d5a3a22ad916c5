#pragma once

/// Lists, as users write them: "0,3,7-9".

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier {

/// The parts of a text between separators; one or more, which may be empty.
[[nodiscard]] std::vector<std::string> words_between(const std::string& text, char separator);

/// One index, or two with a dash between; nothing for any other word.
[[nodiscard]] std::optional<std::vector<std::int32_t>> parse_indices(const std::string& word);

/// Indices and ranges of them with commas between; nothing for any other text.
[[nodiscard]] std::optional<std::vector<std::int32_t>> parse_index_list(const std::string& text);

}  // namespace espalier
