#include "viewer/app/autosave.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/file.h"

namespace espalier::viewer {
namespace {

/// Journals name files from where the program ran.
constexpr std::string_view kFolderMark = "# in ";
/// More programs than this at the same time keep nothing.
constexpr int kMostFiles = 64;

bool exists(const std::string& path) {
  std::error_code failure;
  return std::filesystem::exists(path, failure);
}

/// When a file was written, local time; "" if that cannot be told.
std::string time_of(const std::string& path) {
  std::error_code failure;
  const auto time = std::filesystem::last_write_time(path, failure);
  if (failure) {
    return "";
  }
  const std::time_t seconds =
      std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(time));
  std::tm local{};
  std::array<char, 32> text{};
  if (::localtime_r(&seconds, &local) == nullptr) {
    return "";
  }
  const std::size_t n = std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local);
  return {text.data(), n};
}

LeftJournal read_journal(const std::string& path, std::shared_ptr<FileLock> lock) {
  LeftJournal left{path, read_file(path), "", time_of(path), std::move(lock)};
  if (left.text.starts_with(kFolderMark)) {
    const std::size_t begin = kFolderMark.size();
    left.folder = left.text.substr(begin, left.text.find('\n') - begin);
  }
  return left;
}

}  // namespace

std::string LeftJournal::title() const {
  const auto n_steps = std::count(text.begin(), text.end(), '\n') - (folder.empty() ? 0 : 1);
  return when + "   " + std::to_string(n_steps) + (n_steps == 1 ? " step   " : " steps   ") +
         folder;
}

void LeftJournal::remove() const {
  std::error_code failure;
  std::filesystem::remove(path, failure);
}

Autosave::Autosave(const std::string& path, double interval) : interval_(interval) {
  for (int i = 1; i <= kMostFiles && !path.empty(); ++i) {
    const std::string file = i == 1 ? path : path + "." + std::to_string(i);
    if (lock_ && !exists(file)) {
      continue;
    }
    auto lock = std::make_unique<FileLock>(file + ".lock");
    if (lock->is_held() && exists(file)) {
      add_leftover(file, std::move(lock));
    } else if (lock->is_held() && !lock_) {
      path_ = file;
      lock_ = std::move(lock);
    }
  }
  std::stable_sort(left_.begin(), left_.end(),
                   [](const LeftJournal& a, const LeftJournal& b) { return a.when > b.when; });
}

void Autosave::add_leftover(const std::string& file, std::unique_ptr<FileLock> lock) {
  try {
    left_.push_back(read_journal(file, std::move(lock)));
  } catch (const FileError&) {
    return;  // not ours to read
  }
}

void Autosave::keep(const Journal& journal, double now) {
  const bool is_due = !written_ || now - *written_ >= interval_;
  if (is_due && !path_.empty() && journal.revision() != kept_) {
    written_ = now;
    keep(journal);
  }
}

void Autosave::keep(const Journal& journal) {
  kept_ = journal.revision();
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
