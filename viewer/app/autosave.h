#pragma once

/// Keeps a session's journal in a file, for the case that the program ends unexpectedly.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "viewer/interact/journal.h"

namespace espalier::viewer {

/// What is left of a session.
struct LeftJournal {
  std::string text;    ///< lines of a journal
  std::string folder;  ///< where the program ran; "": unknown
};

/// One file while the program runs; none once it ended well.
class Autosave {
 public:
  /// path: "": nothing is kept; interval: least time between two writes, seconds.
  explicit Autosave(std::string path, double interval = 2)
      : path_(std::move(path)), interval_(interval) {}

  /// What a session that did not end well left there; none if the last one did. It is moved aside,
  /// to PATH.left, where it stays until recovered() finds it.
  [[nodiscard]] bool moves_leftover() const;
  /// The journal that was left, moved aside or not. Throws FileError if there is none.
  [[nodiscard]] LeftJournal recovered() const;

  /// Writes the journal if it changed, once the interval is over. now: seconds. Throws FileError if
  /// that fails, and tries again once the journal changed further.
  void keep(const Journal& journal, double now);
  /// The session ends well: nothing is left.
  void end() const;

 private:
  [[nodiscard]] std::string leftover() const { return path_ + ".left"; }

  std::string path_;
  double interval_;
  std::uint64_t kept_ = 0;  // revision of the journal
  std::optional<double> written_;
};

}  // namespace espalier::viewer
