#include "lattice/core/error.h"

namespace espalier {

FileError::FileError(std::string_view path, std::string_view what)
    : Error(std::string(path) + ": " + std::string(what)) {}

FileError::FileError(std::string_view path, std::size_t line, std::string_view what)
    : Error(std::string(path) + ":" + std::to_string(line) + ": " + std::string(what)) {}

}  // namespace espalier
