#pragma once

/// How a long task tells how far it is, and is asked to stop.

#include <functional>
#include <string_view>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {

/// Passed down to long tasks; a default one is silent.
class Progress {
 public:
  /// Gets the task's name and the fraction done in [0, 1]; returns false to cancel.
  using Callback = std::function<bool(std::string_view task, double fraction)>;

  Progress() = default;
  explicit Progress(Callback callback) : callback_(std::move(callback)) {}

  /// Reports; throws Cancelled if the callback wants the task to stop. Call it from one thread.
  void update(std::string_view task, double fraction) const {
    if (callback_ && !callback_(task, fraction)) {
      throw Cancelled();
    }
  }

 private:
  Callback callback_;
};

}  // namespace espalier
