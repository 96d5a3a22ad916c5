#pragma once

/// Numbers as the text of a file, at the file's precision.

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

/// The shortest text that reads back as the same number at the given precision.
class NumberText {
 public:
  NumberText(double number, NumberEncoding encoding);
  [[nodiscard]] std::string_view view() const { return {text_, length_}; }

 private:
  char text_[32];
  std::size_t length_;
};

}  // namespace espalier
