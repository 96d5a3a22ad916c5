#pragma once

/// Whole files in and out.

#include <string>
#include <string_view>

namespace espalier {

/// The bytes of the file at `path`. Throws FileError if it is missing, a folder, or unreadable.
[[nodiscard]] std::string read_file(const std::string& path);

/// Replaces the file at `path` by `bytes`, or leaves it as it was: the bytes go to a temporary
/// file beside it, which is renamed when whole. Links are followed; what is no plain file, or an
/// open one such as /dev/stdout, is written to directly. Throws FileError.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace espalier
