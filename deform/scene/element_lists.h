#pragma once

/// Lists of a lattice's elements, as operations get them.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deform/scene/operation.h"

namespace espalier {

/// The indices of a text parameter like "0,3,7-9"; none if it is absent. Throws ParameterError for
/// another text.
[[nodiscard]] std::vector<std::int32_t> indices_of(const Arguments& arguments,
                                                   const std::string& name);

/// The edges of a text parameter like "0-1,4-5", by their ends; none if it is absent. Throws
/// ParameterError for another text.
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> edges_of(const Arguments& arguments,
                                                                const std::string& name);

}  // namespace espalier
