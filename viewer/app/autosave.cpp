#include "viewer/app/autosave.h"

#include <filesystem>
#include <string_view>

#include "lattice/core/error.h"
#include "lattice/core/file.h"

namespace espalier::viewer {
namespace {

/// Journals name files from where the program ran.
constexpr std::string_view kFolderMark = "# in ";

bool exists(const std::string& path) {
  std::error_code failure;
  return std::filesystem::exists(path, failure);
}

}  // namespace

bool Autosave::moves_leftover() const {
  if (path_.empty() || !exists(path_)) {
    return false;
  }
  std::error_code failure;
  std::filesystem::rename(path_, leftover(), failure);
  return !failure;
}

LeftJournal Autosave::recovered() const {
  if (!path_.empty() && !exists(path_) && exists(leftover())) {
    std::error_code failure;
    std::filesystem::rename(leftover(), path_, failure);
  }
  if (path_.empty() || !exists(path_)) {
    throw FileError(path_.empty() ? "the journal" : path_,
                    "there is nothing to recover: the last session ended well");
  }
  LeftJournal left{read_file(path_), ""};
  if (left.text.starts_with(kFolderMark)) {
    const std::size_t begin = kFolderMark.size();
    left.folder = left.text.substr(begin, left.text.find('\n') - begin);
  }
  return left;
}

void Autosave::keep(const Journal& journal, double now) {
  const bool is_due = !written_ || now - *written_ >= interval_;
  if (path_.empty() || journal.revision() == kept_ || !is_due) {
    return;
  }
  kept_ = journal.revision();
  written_ = now;
  std::error_code failure;
  const std::string folder = std::filesystem::current_path(failure).string();
  write_file(path_, std::string(kFolderMark) + folder + "\n" + journal.text());
}

void Autosave::end() const {
  std::error_code failure;
  if (!path_.empty()) {
    std::filesystem::remove(path_, failure);
  }
}

}  // namespace espalier::viewer
