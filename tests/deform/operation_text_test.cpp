#include "deform/scene/operation_text.h"

#include <gtest/gtest.h>

#include "lattice/core/error.h"

namespace espalier {
namespace {

std::string round_trip(const std::string& line) {
  return text_of(parse_call(line));
}

std::string refusal(const std::string& line) {
  try {
    (void)parse_call(line);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OperationText, reads_back_what_it_writes) {
  for (const std::string line :
       {"new box cells=1,2,3 min=-0.1,0.30000000000000004,1e-300 output=a.json",
        "open path=\"a folder/with \\\"quotes\\\" \\\\ and = signs.obj\" kind=model",
        "deform model=m lattice=a lattice=\"b c\" strength=0.5 output=o",
        "save name=a path=b.vtu volume=true", "set pose lattice=x"}) {
    EXPECT_EQ(round_trip(line), line);
  }
}

TEST(OperationText, puts_arguments_into_the_order_of_the_parameters) {
  EXPECT_EQ(round_trip("  open   kind=model \t path=a.obj"), "open path=a.obj kind=model");
}

TEST(OperationText, keeps_every_bit_of_a_number) {
  const double third = 1.0 / 3;
  const OperationCall call{"new cylinder", Arguments({{"radius", third}})};
  EXPECT_EQ(parse_call(text_of(call)).arguments.number("radius"), third);
}

TEST(OperationText, keeps_line_ends_inside_texts) {
  const OperationCall call{"open", Arguments({{"path", std::string("a\nb")}})};
  EXPECT_EQ(text_of(call), "open path=\"a\\nb\"");
  EXPECT_EQ(parse_call(text_of(call)).arguments.text("path"), "a\nb");
}

TEST(OperationText, refuses_what_it_cannot_read) {
  EXPECT_EQ(refusal("fly away"), "there is no operation 'fly away'");
  EXPECT_EQ(refusal("open speed=3"), "'open' has no parameter 'speed'");
  EXPECT_EQ(refusal("open path=a path=b"), "'path' is given twice");
  EXPECT_EQ(refusal("open path=\"a"), "a quoted text does not end: '\"a'");
  EXPECT_EQ(refusal("open path=a b"), "expected NAME=VALUE, not 'b'");
  EXPECT_EQ(refusal("save name=a volume=yes"), "'volume' must be true or false");
  EXPECT_EQ(refusal("new box cells=1,x,3 output=a"),
            "'cells' has 'x', which is no number of its kind");
  EXPECT_EQ(refusal("new cylinder radius=1,2 output=a"), "'radius' must be one number");
}

}  // namespace
}  // namespace espalier
