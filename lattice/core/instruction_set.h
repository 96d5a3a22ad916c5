#pragma once

/// Which vector instructions the kernels use, chosen when the program runs.

#include <string_view>
#include <vector>

namespace espalier {

enum class InstructionSet {
  Baseline,  ///< what every x86-64 has: SSE2, no fused multiplication and addition
  Avx2       ///< AVX2 and FMA
};

/// "baseline" or "avx2".
[[nodiscard]] std::string_view name_of(InstructionSet set);

/// Those that this processor has, the fastest last.
[[nodiscard]] std::vector<InstructionSet> available_instruction_sets();

/// The fastest, unless the environment variable ESPALIER_ISA names one: "baseline" gives the same
/// bits on every machine. Throws ParameterError if it names none that this processor has.
[[nodiscard]] InstructionSet instruction_set();

}  // namespace espalier
