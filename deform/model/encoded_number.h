#pragma once

/// Numbers as a file writes them, at its precision: as text, or as bytes.

#include <cstddef>
#include <string_view>

#include "deform/model/model_layout.h"

namespace espalier {

/// A file in which a coordinate has more digits than this is taken to hold doubles: as many are
/// enough to tell any two floats apart.
inline constexpr int kFloatDigits = 9;

/// Digits of a decimal number from the first that is not zero, without its exponent.
[[nodiscard]] int significant_digits(std::string_view number);

/// Whether a file of this precision would hold the same number for both.
[[nodiscard]] bool is_same_number(double a, double b, NumberEncoding encoding);

/// Bytes that the encoding takes for a number; 0 for text.
[[nodiscard]] std::size_t encoded_size(NumberEncoding encoding);

/// The encoding of a number of `size` bytes in a file of an encoding: what is no text may hold
/// floats beside doubles.
[[nodiscard]] NumberEncoding with_size(NumberEncoding encoding, std::size_t size);

/// The number that a file's bytes stand for. bytes: encoded_size() of them, of no text encoding.
[[nodiscard]] double decoded(std::string_view bytes, NumberEncoding encoding);

/// What a file writes for a number: the shortest text that reads back as the same number at the
/// given precision, or its bytes.
class EncodedNumber {
 public:
  EncodedNumber(double number, NumberEncoding encoding);
  [[nodiscard]] std::string_view view() const { return {bytes_, length_}; }

 private:
  char bytes_[32];
  std::size_t length_;
};

}  // namespace espalier
