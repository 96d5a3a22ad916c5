#include "deform/model/encoded_number.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cstring>

namespace espalier {
namespace {

bool is_float(NumberEncoding encoding) {
  return encoding == NumberEncoding::FloatText || encoding == NumberEncoding::LittleFloat ||
         encoding == NumberEncoding::BigFloat;
}

/// Whether the bytes of a number stand in the other order than in memory.
bool is_reversed(NumberEncoding encoding) {
  const bool is_big = encoding == NumberEncoding::BigFloat || encoding == NumberEncoding::BigDouble;
  return is_big != (std::endian::native == std::endian::big);
}

}  // namespace

std::size_t encoded_size(NumberEncoding encoding) {
  switch (encoding) {
    case NumberEncoding::LittleFloat:
    case NumberEncoding::BigFloat:
      return sizeof(float);
    case NumberEncoding::LittleDouble:
    case NumberEncoding::BigDouble:
      return sizeof(double);
    default:
      return 0;
  }
}

NumberEncoding with_size(NumberEncoding encoding, std::size_t size) {
  if (encoded_size(encoding) == 0) {
    return encoding;
  }
  const bool is_big = encoding == NumberEncoding::BigFloat || encoding == NumberEncoding::BigDouble;
  if (size == sizeof(float)) {
    return is_big ? NumberEncoding::BigFloat : NumberEncoding::LittleFloat;
  }
  return is_big ? NumberEncoding::BigDouble : NumberEncoding::LittleDouble;
}

double decoded(std::string_view bytes, NumberEncoding encoding) {
  assert(bytes.size() == encoded_size(encoding));
  char copy[sizeof(double)] = {};
  std::copy(bytes.begin(), bytes.end(), copy);
  if (is_reversed(encoding)) {
    std::reverse(copy, copy + bytes.size());
  }
  if (is_float(encoding)) {
    float number = 0;
    std::memcpy(&number, copy, sizeof number);
    return number;
  }
  double number = 0;
  std::memcpy(&number, copy, sizeof number);
  return number;
}

int significant_digits(std::string_view number) {
  int n_digits = 0;
  for (const char c : number) {
    if (c == 'e' || c == 'E') {
      break;
    }
    if (c >= '0' && c <= '9' && (n_digits > 0 || c != '0')) {
      ++n_digits;
    }
  }
  return n_digits;
}

bool is_same_number(double a, double b, NumberEncoding encoding) {
  return is_float(encoding) ? static_cast<float>(a) == static_cast<float>(b) : a == b;
}

EncodedNumber::EncodedNumber(double number, NumberEncoding encoding) {
  const auto narrow = static_cast<float>(number);
  length_ = encoded_size(encoding);
  if (length_ > 0) {
    std::memcpy(bytes_, is_float(encoding) ? static_cast<const void*>(&narrow) : &number, length_);
    if (is_reversed(encoding)) {
      std::reverse(bytes_, bytes_ + length_);
    }
    return;
  }
  char* const end = bytes_ + sizeof bytes_;
  const std::to_chars_result result = encoding == NumberEncoding::FloatText
                                          ? std::to_chars(bytes_, end, narrow)
                                          : std::to_chars(bytes_, end, number);
  length_ = static_cast<std::size_t>(result.ptr - bytes_);
}

}  // namespace espalier
