#pragma once

/// Folders to look for models and lattices in.

#include <string>
#include <vector>

namespace espalier::viewer {

struct FileEntry {
  std::string name;  ///< of the file or folder alone
  bool is_folder = false;
  bool operator==(const FileEntry&) const = default;
};

/// Whether a file has the extension of a model or a lattice, in any case.
[[nodiscard]] bool can_be_opened(const std::string& name);

/// The folders in a folder, then the files that can be opened and have `filter` in their names, in
/// any case; both by name. Names that begin with a dot are left out. Nothing of a folder that
/// cannot be read.
[[nodiscard]] std::vector<FileEntry> entries_of(const std::string& folder,
                                                const std::string& filter = "");

/// The folder that a folder is in; itself at the root. Absolute.
[[nodiscard]] std::string folder_above(const std::string& folder);

}  // namespace espalier::viewer
