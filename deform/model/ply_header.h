#pragma once

/// The header of a PLY file: which elements follow, and what each is made of.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/core/text_scanner.h"

namespace espalier {

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

/// Bytes of a value in a binary file.
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float;
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::string_view count_word;  ///< where the scanned text has it
  std::vector<PlyProperty> properties;
  std::string_view last_line;  ///< that of its last property, there
};

enum class PlyEncoding : std::uint8_t { Text, Little, Big };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Text;
  std::vector<PlyElement> elements;
};

/// Reads up to and with the line "end_header". Throws FileError naming the line.
[[nodiscard]] PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace espalier
