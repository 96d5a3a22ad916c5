#pragma once

/// A folder for the files of a test.

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace espalier::test {

/// A folder that no other test has; it goes with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "espalier.").string()) {
    path_ += std::string(6, 'X');  // mkdtemp() puts letters in their place
    if (::mkdtemp(path_.data()) == nullptr) {
      throw std::runtime_error(path_ + ": cannot make a folder");
    }
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string path(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace espalier::test
