#include "viewer/interact/file_browser.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace espalier::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> kExtensions = {".obj", ".ply",  ".off", ".stl", ".json",
                                                         ".ovm", ".mesh", ".vtk", ".msh"};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool can_be_opened(const std::string& name) {
  const std::string extension = lower(fs::path(name).extension().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

std::vector<FileEntry> entries_of(const std::string& folder, const std::string& filter) {
  std::vector<FileEntry> entries;
  std::error_code failure;
  fs::directory_iterator place(folder.empty() ? "." : folder, failure);
  for (; !failure && place != fs::directory_iterator(); place.increment(failure)) {
    const std::string name = place->path().filename().string();
    std::error_code unknown;
    const bool is_folder = place->is_directory(unknown);
    const bool is_wanted =
        is_folder || (can_be_opened(name) && lower(name).find(lower(filter)) != std::string::npos);
    if (is_wanted && !name.starts_with('.')) {
      entries.push_back({name, is_folder});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
  return entries;
}

std::string folder_above(const std::string& folder) {
  std::error_code failure;
  fs::path path = fs::absolute(folder.empty() ? "." : folder, failure).lexically_normal();
  if (!path.has_filename()) {
    path = path.parent_path();
  }
  return path.parent_path().string();
}

}  // namespace espalier::viewer
