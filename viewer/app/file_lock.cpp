#include "viewer/app/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace espalier::viewer {

FileLock::FileLock(const std::string& path)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)), is_held_(true) {
  if (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    is_held_ = errno != EWOULDBLOCK;
  }
}

FileLock::~FileLock() {
  if (file_ >= 0) {
    ::close(file_);
  }
}

}  // namespace espalier::viewer
