#pragma once

/// Keeps a session's journal in a file, for the case that the program ends unexpectedly.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/app/file_lock.h"
#include "viewer/interact/journal.h"

namespace espalier::viewer {

/// What is left of a session that did not end well. No other program takes it while this is there.
struct LeftJournal {
  std::string path;
  std::string text;    ///< lines of a journal
  std::string folder;  ///< where the program ran; "": unknown
  std::string when;    ///< it was written last: "2026-03-01 14:05"
  std::shared_ptr<FileLock> lock = nullptr;

  /// For a list to choose from: when, how many steps, where.
  [[nodiscard]] std::string title() const;
  /// It is not needed any more.
  void remove() const;
};

/// One file while the program runs; none once it ended well. Programs that run at the same time
/// have files of their own: PATH, PATH.2, PATH.3 and so on, each with a lock beside it, PATH.lock.
class Autosave {
 public:
  /// path: "": nothing is kept; interval: least time between two writes, seconds.
  explicit Autosave(const std::string& path, double interval = 2);

  /// The file in use; "": none.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// What was found at the beginning, the newest first; once.
  [[nodiscard]] std::vector<LeftJournal> take_leftovers() { return std::move(left_); }

  /// Writes the journal if it changed, once the interval is over. now: seconds. Throws FileError if
  /// that fails, and tries again once the journal changed further.
  void keep(const Journal& journal, double now);
  /// Writes it at once; there must be a file.
  void keep(const Journal& journal);
  /// The session ends well: nothing is left.
  void end() const;

 private:
  void add_leftover(const std::string& file, std::unique_ptr<FileLock> lock);

  std::string path_;
  double interval_;
  std::unique_ptr<FileLock> lock_;
  std::vector<LeftJournal> left_;
  std::uint64_t kept_ = 0;  // revision of the journal
  std::optional<double> written_;
};

}  // namespace espalier::viewer
