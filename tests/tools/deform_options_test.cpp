#include <gmock/gmock.h>

#include "tests/tools/deform_fixture.h"

namespace espalier {
namespace {

class DeformOptions : public test::DeformCommand {};
using testing::HasSubstr;

const auto kAll = [](std::size_t) { return 1.0; };

TEST_F(DeformOptions, moves_points_by_the_strength_times_the_displacement) {
  EXPECT_EQ(deformed_points({}), moved({0.5, 0, 0}, kAll));
  EXPECT_EQ(deformed_points({"--strength", "0.5"}), moved({0.25, 0, 0}, kAll));
  EXPECT_EQ(deformed_points({"--strength", "-2"}), moved({-1, 0, 0}, kAll));
}

TEST_F(DeformOptions, with_strength_zero_keeps_every_byte) {
  (void)deformed_points({"--strength", "0"});
  EXPECT_EQ(bytes("out.obj"), test::kModel);
}

TEST_F(DeformOptions, refuses_a_strength_that_is_no_finite_number) {
  for (const char* strength : {"inf", "nan", "much"}) {
    EXPECT_EQ(run({"deform", "model.obj", "--lattice", "box.json", "--strength", strength, "-o",
                   "out.obj"})
                  .status,
              2)
        << strength;
  }
}

TEST_F(DeformOptions, moves_only_the_points_of_the_named_groups) {
  EXPECT_EQ(deformed_points({"--only", "low"}),
            moved({0.5, 0, 0}, [](std::size_t i) { return i == 3 ? 0.0 : 1.0; }));
  EXPECT_THAT(bytes("out.obj"), HasSubstr("v 0.5 0.5 0.75\n"));
  EXPECT_EQ(deformed_points({"--only", "low", "--only", "high"}), moved({0.5, 0, 0}, kAll));
  EXPECT_EQ(deformed_points({"--only", "all"}), moved({0.5, 0, 0}, kAll));
}

TEST_F(DeformOptions, moves_only_the_points_whose_indices_a_file_lists) {
  write("some.txt", "# two points\n3\r\n\n1 # twice\n1\n");
  EXPECT_EQ(deformed_points({"--only", "@some.txt"}),
            moved({0.5, 0, 0}, [](std::size_t i) { return i % 2 == 1 ? 1.0 : 0.0; }));
}

TEST_F(DeformOptions, lists_some_names_where_a_group_is_unknown) {
  const auto outcome =
      run({"deform", "model.obj", "--lattice", "box.json", "--only", "middle", "-o", "out.obj"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("has no group or object named 'middle': it has all, low, "
                                        "high"));
}

TEST_F(DeformOptions, multiplies_the_motion_of_each_point_by_its_weight) {
  write("weights.txt", "0\n0.25\n0.5\n1\n1\n");
  EXPECT_EQ(deformed_points({"--weights", "weights.txt", "--strength", "2"}),
            moved({1, 0, 0}, [](std::size_t i) {
              return std::vector{0.0, 0.25, 0.5, 1.0}[i];
            }));
  EXPECT_EQ(deformed_points({"--weights", "weights.txt", "--only", "high"}),
            moved({0.5, 0, 0}, [](std::size_t i) {
              return std::vector{0.0, 0.25, 0.0, 1.0}[i];
            }));
}

TEST_F(DeformOptions, names_file_and_line_of_a_bad_weight_or_index) {
  const auto error = [&](const std::string& option, const std::string& text) {
    write("bad.txt", text);
    const auto outcome = run({"deform", "model.obj", "--lattice", "box.json", "-o", "out.obj",
                              option, option == "--only" ? "@bad.txt" : "bad.txt"});
    EXPECT_EQ(outcome.status, 1);
    return outcome.errors;
  };
  EXPECT_THAT(error("--weights", "1\n1.5\n"), HasSubstr("bad.txt:2: '1.5' is no weight"));
  EXPECT_THAT(error("--weights", "1\nnan\n"), HasSubstr("bad.txt:2: 'nan' is no weight"));
  EXPECT_THAT(error("--weights", "1\n1 1\n"), HasSubstr("bad.txt:2: "));
  EXPECT_THAT(error("--weights", "1\n1\n1\n"),
              HasSubstr("bad.txt: has 3 weights, the model has 5"));
  EXPECT_THAT(error("--weights", "1\n1\n1\n1\n1\n1\n"), HasSubstr("bad.txt:6: more weights"));
  EXPECT_THAT(error("--only", "4\n5\n"), HasSubstr("bad.txt:2: '5' is no index of a point: must "
                                                   "be 0 to 4"));
  EXPECT_THAT(error("--only", "-1\n"), HasSubstr("bad.txt:1: '-1' is no index"));
}

TEST_F(DeformOptions, adds_the_displacements_of_several_lattices) {
  EXPECT_EQ(deformed_points({"--lattice", "other.json", "--pose", "raised.json"}),
            moved({0.5, 0, 0.25}, kAll));
  EXPECT_EQ(deformed_points({"--lattice", "box.json", "--pose", "shifted.json"}),
            moved({1, 0, 0}, kAll));
}

TEST_F(DeformOptions, takes_each_lattices_own_pose_where_none_is_given) {
  const auto outcome = run({"deform", "model.obj", "--lattice", "shifted.json", "--lattice",
                            "raised.json", "-o", "out.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(points("out.obj"), moved({0.5, 0, 0.25}, kAll));
  EXPECT_THAT(outcome.output, HasSubstr("\"lattices\""));
}

TEST_F(DeformOptions, refuses_more_or_fewer_poses_than_lattices) {
  const auto outcome = run({"deform", "model.obj", "--lattice", "box.json", "--lattice",
                            "other.json", "--pose", "shifted.json", "-o", "out.obj"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("--pose is given 1 time for 2 lattices"));
}

}  // namespace
}  // namespace espalier
