/// G. Turk, "The PLY polygon file format", 1994.

#include "deform/model/ply_body.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "deform/model/encoded_number.h"
#include "lattice/core/error.h"

namespace espalier {

NumberEncoding number_encoding(PlyEncoding encoding, PlyType type) {
  const bool is_float = type == PlyType::Float;
  switch (encoding) {
    case PlyEncoding::Text:
      return is_float ? NumberEncoding::FloatText : NumberEncoding::DoubleText;
    case PlyEncoding::Little:
      return is_float ? NumberEncoding::LittleFloat : NumberEncoding::LittleDouble;
    default:
      return is_float ? NumberEncoding::BigFloat : NumberEncoding::BigDouble;
  }
}

PlyBody::PlyBody(std::string_view path, std::string_view bytes, TextScanner scanner,
                 PlyEncoding encoding)
    : path_(path), bytes_(bytes), scanner_(std::move(scanner)), encoding_(encoding) {
  const std::string_view last = scanner_.line();
  at_ = static_cast<std::size_t>(last.data() + last.size() - bytes.data());
  at_ += bytes.substr(at_).starts_with("\r\n") ? 2 : 1;
}

void PlyBody::begin_element(const PlyElement& element, std::int64_t index) {
  element_ = &element;
  index_ = index;
  if (encoding_ != PlyEncoding::Text) {
    return;
  }
  do {
    if (!scanner_.next_line()) {
      fail_at_end();
    }
    ahead_ = scanner_.next_word();
  } while (ahead_.empty());
}

PlacedNumber PlyBody::next(PlyType type, std::string_view what) {
  return encoding_ == PlyEncoding::Text ? next_word(what) : next_bytes(type);
}

std::int32_t PlyBody::next_index(PlyType type, std::string_view what) {
  const double value = next(type, what).value;
  if (!(value >= 0 && value <= std::numeric_limits<std::int32_t>::max()) ||
      value != std::floor(value)) {
    fail(fmt::format("{} is {}, must be a whole number from 0", what, value));
  }
  return static_cast<std::int32_t>(value);
}

void PlyBody::fail(std::string_view what) const {
  const std::string message = fmt::format("{} {}: {}", element_->name, index_, what);
  if (encoding_ == PlyEncoding::Text) {
    scanner_.fail(message);
  }
  throw FileError(path_, message);
}

void PlyBody::fail_at_end() const {
  throw FileError(path_, fmt::format("ends in element {} of the {} '{}' that it announces", index_,
                                     element_->count, element_->name));
}

PlacedNumber PlyBody::next_word(std::string_view what) {
  const std::string_view word = ahead_.empty() ? scanner_.next_word() : std::exchange(ahead_, {});
  PlacedNumber number;
  if (word.empty()) {
    fail(fmt::format("{} is missing", what));
  }
  if (!parse_number(word, number.value)) {
    fail(fmt::format("{} is {}, not a number", what, quoted(word)));
  }
  if (word.size() > BytePlace::kLargestLength) {
    fail(fmt::format("{} has more than {} characters", what, BytePlace::kLargestLength));
  }
  number.place = BytePlace(static_cast<std::size_t>(word.data() - bytes_.data()), word.size());
  return number;
}

PlacedNumber PlyBody::next_bytes(PlyType type) {
  const std::size_t size = size_of(type);
  if (at_ > bytes_.size() || bytes_.size() - at_ < size) {
    fail_at_end();
  }
  PlacedNumber number;
  number.place = BytePlace(at_, size);
  const std::string_view bytes = bytes_.substr(at_, size);
  at_ += size;
  if (type == PlyType::Float || type == PlyType::Double) {
    number.value = decoded(bytes, number_encoding(encoding_, type));
    return number;
  }
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t from = encoding_ == PlyEncoding::Little ? size - 1 - i : i;
    bits = bits << 8 | static_cast<unsigned char>(bytes[from]);
  }
  const bool is_signed = type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
  const double range = std::ldexp(1.0, static_cast<int>(8 * size));
  number.value = is_signed && bits >= range / 2 ? bits - range : bits;
  return number;
}

}  // namespace espalier
