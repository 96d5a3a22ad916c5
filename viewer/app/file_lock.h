#pragma once

/// Programs that share files keep out of one another's way.

#include <string>

namespace espalier::viewer {

/// A lock of its own on a file, which is made if there is none and stays. It ends with this or with
/// the process, however that ends.
class FileLock {
 public:
  /// Does not wait: see is_held(). A file system without locks gives all that are asked for.
  explicit FileLock(const std::string& path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  /// False if another one has it.
  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  int file_;
  bool is_held_;
};

}  // namespace espalier::viewer
