#include "tools/progress_bar.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

namespace espalier::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// One line of the terminal, rewritten in place.
class Bar {
 public:
  Bar() = default;
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;
  ~Bar() {
    if (is_shown_) {
      std::fputs("\r\033[K", stderr);
    }
  }

  void update(std::string_view task, double fraction) {
    constexpr auto kPatience = std::chrono::seconds(1);
    constexpr auto kRedraw = std::chrono::milliseconds(100);
    const Clock::time_point now = Clock::now();
    if (now - start_ < kPatience || now - drawn_ < kRedraw) {
      return;
    }
    drawn_ = now;
    is_shown_ = true;
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * fraction + 0.5);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kWidth - filled), '.');
    std::fprintf(stderr, "\r%-10.*s [%s] %3d%%\033[K", static_cast<int>(task.size()), task.data(),
                 bar.c_str(), static_cast<int>(100 * fraction));
  }

 private:
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_ = start_;
  bool is_shown_ = false;
};

}  // namespace

Progress progress_bar() {
  if (isatty(STDERR_FILENO) == 0) {
    return {};
  }
  return Progress([bar = std::make_shared<Bar>()](std::string_view task, double fraction) {
    bar->update(task, fraction);
    return true;
  });
}

}  // namespace espalier::tools
