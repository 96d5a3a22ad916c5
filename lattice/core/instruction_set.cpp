#include "lattice/core/instruction_set.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "lattice/core/error.h"

namespace espalier {

std::string_view name_of(InstructionSet set) {
  return set == InstructionSet::Baseline ? "baseline" : "avx2";
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::Baseline};
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    sets.push_back(InstructionSet::Avx2);
  }
  return sets;
}

InstructionSet instruction_set() {
  const std::vector<InstructionSet> sets = available_instruction_sets();
  const char* const wanted = std::getenv("ESPALIER_ISA");
  if (wanted == nullptr) {
    return sets.back();
  }
  const auto found = std::find_if(sets.begin(), sets.end(),
                                  [&](InstructionSet set) { return name_of(set) == wanted; });
  if (found == sets.end()) {
    std::string names;
    for (const InstructionSet set : sets) {
      names += (names.empty() ? "" : " or ") + std::string(name_of(set));
    }
    throw ParameterError("ESPALIER_ISA is '" + std::string(wanted) + "', must be " + names +
                         " on this processor");
  }
  return *found;
}

}  // namespace espalier
