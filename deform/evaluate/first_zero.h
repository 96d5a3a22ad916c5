#pragma once

#include <array>
#include <optional>

namespace espalier {

/// The first t in [0, 1] at which c0 + c1 t + c2 t² + c3 t³ is not positive, to round-off; nothing
/// if there is none.
[[nodiscard]] std::optional<double> first_zero(const std::array<double, 4>& coefficients);

}  // namespace espalier
