#include "lattice/core/instruction_set.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// Sets ESPALIER_ISA, and back.
class Wish {
 public:
  explicit Wish(const char* name) {
    if (const char* const before = std::getenv("ESPALIER_ISA")) {
      before_ = before;
    }
    ::setenv("ESPALIER_ISA", name, 1);
  }
  ~Wish() {
    if (before_.empty()) {
      ::unsetenv("ESPALIER_ISA");
    } else {
      ::setenv("ESPALIER_ISA", before_.c_str(), 1);
    }
  }

 private:
  std::string before_;
};

TEST(InstructionSet, is_what_the_environment_wishes) {
  for (const InstructionSet set : available_instruction_sets()) {
    const Wish wish(name_of(set).data());
    EXPECT_EQ(instruction_set(), set);
  }
}

TEST(InstructionSet, baseline_is_always_there) {
  EXPECT_EQ(available_instruction_sets().front(), InstructionSet::Baseline);
}

TEST(InstructionSet, refuses_a_set_that_is_none) {
  const Wish wish("mmx");
  EXPECT_THROW((void)instruction_set(), ParameterError);
}

}  // namespace
}  // namespace espalier
