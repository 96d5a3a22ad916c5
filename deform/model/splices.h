#pragma once

/// The one way in which models are written: a copy of their bytes with stretches replaced.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "deform/model/model_layout.h"

namespace espalier {

/// Replacements and insertions to make in some bytes. Replaced stretches must not overlap;
/// insertions at one place come in the order they were added.
class Splices {
 public:
  void replace(BytePlace place, std::string_view text) {
    edits_.push_back({place, texts_.size(), text.size()});
    texts_ += text;
  }
  /// The same of any number of bytes, from `begin` to `end`.
  void replace(std::size_t begin, std::size_t end, std::string_view text);
  void insert(std::size_t at, std::string_view text) { replace(BytePlace(at, 0), text); }

  [[nodiscard]] bool empty() const { return edits_.empty(); }

  /// `bytes` with all edits made. O(bytes + edits · log edits).
  [[nodiscard]] std::string apply(std::string_view bytes);

 private:
  struct Edit {
    BytePlace place;
    std::size_t text_begin;
    std::size_t text_length;
  };
  std::vector<Edit> edits_;
  std::string texts_;
};

}  // namespace espalier
