#include "deform/model/splices.h"

#include <algorithm>
#include <cassert>

namespace espalier {

void Splices::replace(std::size_t begin, std::size_t end, std::string_view text) {
  // A place holds 16 MiB at most; a longer stretch is replaced bit by bit.
  const std::size_t most = BytePlace::kLargestLength;
  replace(BytePlace(begin, std::min(end - begin, most)), text);
  for (std::size_t at = begin + most; at < end; at += most) {
    replace(BytePlace(at, std::min(end - at, most)), "");
  }
}

std::string Splices::apply(std::string_view bytes) {
  const auto is_before = [](const Edit& a, const Edit& b) {
    return a.place.begin() < b.place.begin();
  };
  if (!std::is_sorted(edits_.begin(), edits_.end(), is_before)) {
    std::stable_sort(edits_.begin(), edits_.end(), is_before);
  }
  std::string result;
  result.reserve(bytes.size() + texts_.size());
  std::size_t done = 0;
  for (const Edit& edit : edits_) {
    assert(edit.place.begin() >= done);
    result += bytes.substr(done, edit.place.begin() - done);
    result += std::string_view(texts_).substr(edit.text_begin, edit.text_length);
    done = edit.place.begin() + edit.place.length();
  }
  return result += bytes.substr(done);
}

}  // namespace espalier
