#include "deform/scene/operations.h"

#include <iterator>

#include "lattice/core/error.h"

namespace espalier {

const std::vector<Operation>& operations() {
  static const std::vector<Operation> kTable = [] {
    std::vector<Operation> table;
    for (auto part :
         {inventory_operations(), tensor_operations(), convert_operations(), refine_operations(),
          building_operations(), pose_operations(), limb_pose_operations(), pull_operations(),
          deform_operations(), file_operations()}) {
      std::move(part.begin(), part.end(), std::back_inserter(table));
    }
    return table;
  }();
  return kTable;
}

const Operation& operation_named(std::string_view name) {
  for (const Operation& operation : operations()) {
    if (operation.name == name) {
      return operation;
    }
  }
  throw ParameterError("there is no operation '" + std::string(name) + "'");
}

}  // namespace espalier
