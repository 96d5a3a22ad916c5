#pragma once

/// The table of all operations.

#include <string_view>
#include <vector>

#include "deform/scene/operation.h"

namespace espalier {

/// In the order in which users meet them: new …, convert, refine, extrude …, bind, deform, open,
/// save.
[[nodiscard]] const std::vector<Operation>& operations();

/// The operation with a name. Throws ParameterError if there is none.
[[nodiscard]] const Operation& operation_named(std::string_view name);

// The table's parts.
[[nodiscard]] std::vector<Operation> file_operations();
[[nodiscard]] std::vector<Operation> inventory_operations();
[[nodiscard]] std::vector<Operation> tensor_operations();
[[nodiscard]] std::vector<Operation> convert_operations();
[[nodiscard]] std::vector<Operation> refine_operations();
[[nodiscard]] std::vector<Operation> building_operations();
[[nodiscard]] std::vector<Operation> pose_operations();
[[nodiscard]] std::vector<Operation> pull_operations();
[[nodiscard]] std::vector<Operation> limb_pose_operations();
[[nodiscard]] std::vector<Operation> deform_operations();

}  // namespace espalier
