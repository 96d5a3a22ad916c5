#include "deform/model/ply_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "deform/model/encoded_number.h"
#include "deform/model/ply_body.h"

namespace espalier {
namespace {

bool is_floating(PlyType type) {
  return type == PlyType::Float || type == PlyType::Double;
}

}  // namespace

double least_of(PlyType type) {
  if (is_floating(type)) {
    return -greatest_of(type);
  }
  const bool is_signed = type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
  return is_signed ? -std::ldexp(0.5, static_cast<int>(8 * size_of(type))) : 0;
}

double greatest_of(PlyType type) {
  if (is_floating(type)) {
    return std::ldexp(1.0, type == PlyType::Float ? 24 : 53);
  }
  return least_of(type) + std::ldexp(1.0, static_cast<int>(8 * size_of(type))) - 1;
}

void PlyWriter::write(PlyType type, double number) {
  if (is_floating(type)) {
    write(EncodedNumber(number, number_encoding(encoding_, type)).view());
    return;
  }
  const auto whole =
      static_cast<std::int64_t>(std::clamp(std::round(number), least_of(type), greatest_of(type)));
  if (encoding_ == PlyEncoding::Text) {
    write(std::to_string(whole));
    return;
  }
  for (std::size_t i = 0; i < size_of(type); ++i) {
    const std::size_t byte = encoding_ == PlyEncoding::Little ? i : size_of(type) - 1 - i;
    text_ += static_cast<char>(static_cast<std::uint64_t>(whole) >> (8 * byte) & 0xFF);
  }
}

void PlyWriter::write(std::string_view bytes) {
  text_ += is_in_line_ && encoding_ == PlyEncoding::Text && !bytes.empty() ? " " : "";
  text_ += bytes;
  is_in_line_ = true;
}

void PlyWriter::end_line() {
  text_ += encoding_ == PlyEncoding::Text ? line_end_ : "";
  is_in_line_ = false;
}

}  // namespace espalier
