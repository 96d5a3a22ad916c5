#include "lattice/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// An open file descriptor, closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] int close() {
    const int status = ::close(fd_);
    fd_ = -1;
    return status;
  }

 private:
  int fd_;
};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw FileError(path, what + ": " + std::strerror(errno));
}

void write_all(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) {
      continue;
    }
    if (n < 0) {
      fail(path, "cannot write");
    }
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// Permissions for the replacement: those of the file it replaces, else the usual ones.
mode_t permissions_for(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    return status.st_mode & 07777;
  }
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// Pipes and devices are written directly: there is nothing to replace. So are the names of open
/// files, such as /dev/stdout: what they lead to may hold the output of others.
bool is_special(const std::string& path) {
  struct stat status {};
  return path.starts_with("/dev/") || path.starts_with("/proc/") ||
         (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode));
}

/// A link is followed, so that its target is replaced or made, and the link stays.
std::string resolve_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::filesystem::path target = path;
  std::error_code not_a_link;
  for (int i = 0; i < kMostLinks; ++i) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, not_a_link);
    if (not_a_link) {
      break;
    }
    target = target.parent_path() / next;
  }
  return target.string();
}

}  // namespace

std::string read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) {
    fail(path, "cannot open");
  }
  if (S_ISDIR(status.st_mode)) {
    throw FileError(path, "is a folder, not a file");
  }
  std::string bytes;
  if (status.st_size > 0) {
    bytes.reserve(static_cast<std::size_t>(status.st_size));
  }
  char block[1 << 16];
  while (true) {
    const ssize_t n = ::read(file.get(), block, sizeof block);
    if (n < 0 && errno == EINTR) {
      continue;
    }
    if (n < 0) {
      fail(path, "cannot read");
    }
    if (n == 0) {
      return bytes;
    }
    bytes.append(block, static_cast<std::size_t>(n));
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  if (is_special(path)) {
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
    if (file.get() < 0) {
      fail(path, "cannot write");
    }
    write_all(file.get(), bytes, path);
    return;
  }
  const std::string target = resolve_links(path);
  std::string temporary = target + "." + std::string(6, 'X');  // mkstemp() puts letters there
  Descriptor file(::mkstemp(temporary.data()));
  if (file.get() < 0) {
    fail(path, "cannot write");
  }
  try {
    write_all(file.get(), bytes, path);
    if (::fchmod(file.get(), permissions_for(target)) != 0 || ::fsync(file.get()) != 0 ||
        file.close() != 0) {
      fail(path, "cannot write");
    }
    if (::rename(temporary.c_str(), target.c_str()) != 0) {
      fail(path, "cannot write");
    }
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

}  // namespace espalier
