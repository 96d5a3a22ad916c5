/// G. Turk, "The PLY polygon file format", 1994.

#include "deform/model/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

namespace espalier {
namespace {

struct TypeNames {
  PlyType type;
  std::string_view name;
  std::string_view sized_name;
  std::size_t size;
};

constexpr std::array<TypeNames, 8> kTypes = {{
    {PlyType::Int8, "char", "int8", 1},
    {PlyType::Uint8, "uchar", "uint8", 1},
    {PlyType::Int16, "short", "int16", 2},
    {PlyType::Uint16, "ushort", "uint16", 2},
    {PlyType::Int32, "int", "int32", 4},
    {PlyType::Uint32, "uint", "uint32", 4},
    {PlyType::Float, "float", "float32", 4},
    {PlyType::Double, "double", "float64", 8},
}};

PlyType read_type(TextScanner& scanner) {
  const std::string_view word = scanner.next_word();
  const auto* const found = std::ranges::find_if(kTypes, [word](const TypeNames& names) {
    return word == names.name || word == names.sized_name;
  });
  if (found == kTypes.end()) {
    scanner.fail(
        fmt::format("a property has the type {}, must be char, uchar, short, ushort, int, "
                    "uint, float or double",
                    quoted(word)));
  }
  return found->type;
}

PlyEncoding read_encoding(TextScanner& scanner) {
  const std::string_view word = scanner.next_word();
  if (word == "ascii") {
    return PlyEncoding::Text;
  }
  if (word == "binary_little_endian") {
    return PlyEncoding::Little;
  }
  if (word == "binary_big_endian") {
    return PlyEncoding::Big;
  }
  scanner.fail(
      fmt::format("the format is {}, must be ascii, binary_little_endian or "
                  "binary_big_endian",
                  quoted(word)));
}

PlyElement read_element(TextScanner& scanner) {
  PlyElement element;
  element.name = scanner.next_word();
  TextScanner ahead = scanner;
  element.count_word = ahead.next_word();
  element.count = scanner.next_integer("the number of elements");
  if (element.count < 0 || element.count > std::numeric_limits<std::int32_t>::max()) {
    scanner.fail(fmt::format("{} elements '{}' are announced, must be 0 to 2147483647",
                             element.count, element.name));
  }
  return element;
}

PlyProperty read_property(TextScanner& scanner) {
  PlyProperty property;
  TextScanner after_list = scanner;
  if (after_list.next_word() == "list") {
    scanner = after_list;
    property.count_type = read_type(scanner);
    if (property.count_type == PlyType::Float || property.count_type == PlyType::Double) {
      scanner.fail("the length of a list must have an integer type");
    }
  }
  property.type = read_type(scanner);
  property.name = scanner.next_word();
  return property;
}

}  // namespace

std::size_t size_of(PlyType type) {
  return kTypes[static_cast<std::size_t>(type)].size;
}

PlyHeader read_ply_header(TextScanner& scanner) {
  if (!scanner.next_line() || scanner.next_word() != "ply") {
    scanner.fail("a PLY file begins with a line 'ply'");
  }
  PlyHeader header;
  bool has_format = false;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.next_word();
    if (keyword == "end_header") {
      if (!has_format) {
        scanner.fail("the header has no line 'format ascii 1.0', or another format");
      }
      return header;
    }
    if (keyword == "format") {
      header.encoding = read_encoding(scanner);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(scanner));
    } else if (keyword == "property") {
      if (header.elements.empty()) {
        scanner.fail("a property stands before the first element");
      }
      header.elements.back().properties.push_back(read_property(scanner));
      header.elements.back().last_line = scanner.line();
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      scanner.fail(
          fmt::format("{} in the header, must be format, comment, element, property or "
                      "end_header",
                      quoted(keyword)));
    }
  }
  scanner.fail("the header ends without a line 'end_header'");
}

}  // namespace espalier
