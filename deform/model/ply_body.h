#pragma once

/// What stands in the body of a PLY file, one number after the other.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "deform/model/model_layout.h"
#include "deform/model/ply_header.h"
#include "lattice/core/text_scanner.h"

namespace espalier {

/// A number of the body and where it stands.
struct PlacedNumber {
  double value = 0;
  BytePlace place;
};

/// How a file writes floats or doubles.
[[nodiscard]] NumberEncoding number_encoding(PlyEncoding encoding, PlyType type);

class PlyBody {
 public:
  /// scanner: at the end of the header; bytes: the whole file, which must outlive this.
  PlyBody(std::string_view path, std::string_view bytes, TextScanner scanner, PlyEncoding encoding);

  /// To be called before the numbers of element `index` of a kind. Throws FileError at the end of
  /// the file.
  void begin_element(const PlyElement& element, std::int64_t index);

  /// The next number of the element, `what` for messages. Throws FileError if there is none.
  [[nodiscard]] PlacedNumber next(PlyType type, std::string_view what);
  /// The same, of a number from 0 on that an int32 holds, as corners and lengths of lists are.
  [[nodiscard]] std::int32_t next_index(PlyType type, std::string_view what);

  /// Throws FileError that names the element.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  [[noreturn]] void fail_at_end() const;
  [[nodiscard]] PlacedNumber next_word(std::string_view what);
  [[nodiscard]] PlacedNumber next_bytes(PlyType type);

  std::string path_;
  std::string_view bytes_;
  TextScanner scanner_;
  PlyEncoding encoding_;
  std::size_t at_ = 0;      // in a binary body
  std::string_view ahead_;  // a word of a text body, taken but not used
  const PlyElement* element_ = nullptr;
  std::int64_t index_ = 0;
};

}  // namespace espalier
