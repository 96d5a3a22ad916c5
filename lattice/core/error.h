#pragma once

/// What goes wrong because of a caller or a file. Expected outcomes are data, never exceptions.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace espalier {

/// Base of everything the libraries throw on purpose; what() is one line fit for a user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be opened, read, understood or written: "FILE: WHAT" or "FILE:LINE: WHAT".
class FileError : public Error {
 public:
  FileError(std::string_view path, std::string_view what);
  /// line: counted from 1.
  FileError(std::string_view path, std::size_t line, std::string_view what);
};

/// A lattice that is no valid cell complex, or has invalid tags or coordinates.
class LatticeError : public Error {
 public:
  using Error::Error;
};

/// Parameters outside what a function or operation accepts.
class ParameterError : public Error {
 public:
  using Error::Error;
};

/// A task that its progress callback asked to stop.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace espalier
