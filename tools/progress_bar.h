#pragma once

/// A bar on standard error for work that takes longer than a second.

#include "lattice/core/progress.h"

namespace espalier::tools {

/// Draws on standard error if that is a terminal, else does nothing. The bar is gone when the
/// returned value and its copies are.
[[nodiscard]] Progress progress_bar();

}  // namespace espalier::tools
