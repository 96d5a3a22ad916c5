#include "deform/model/number_text.h"

#include <charconv>

namespace espalier {

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
  return encoding == NumberEncoding::FloatText ? static_cast<float>(a) == static_cast<float>(b)
                                               : a == b;
}

NumberText::NumberText(double number, NumberEncoding encoding) {
  char* const end = text_ + sizeof text_;
  const std::to_chars_result result = encoding == NumberEncoding::FloatText
                                          ? std::to_chars(text_, end, static_cast<float>(number))
                                          : std::to_chars(text_, end, number);
  length_ = static_cast<std::size_t>(result.ptr - text_);
}

}  // namespace espalier
