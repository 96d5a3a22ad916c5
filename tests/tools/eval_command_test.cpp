#include <cmath>
#include <cstdlib>

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class EvalCommand : public CommandLineTest {};

constexpr const char* kHeader = "x,y,z,status,j00,j01,j02,j10,j11,j12,j20,j21,j22";

double number(const std::string& word) {
  return std::strtod(word.c_str(), nullptr);
}

glm::dvec3 position(const std::vector<std::string>& row) {
  return {number(row[0]), number(row[1]), number(row[2])};
}

TEST_F(EvalCommand, at_rest_leaves_every_point_and_writes_17_digits_in_the_order_given) {
  done({"new", "box", "-o", "box.json"});
  write_file("at.csv", "x,y,z\n0.1,0.25,0.7\n2,2,2\n0,0,0\n");
  EXPECT_EQ(done({"eval", "box.json", "--at", "at.csv"}),
            std::string(kHeader) +
                "\n0.10000000000000001,0.25,0.69999999999999996,inside,1,0,0,0,1,0,0,0,1\n"
                "2,2,2,outside,1,0,0,0,1,0,0,0,1\n"
                "0,0,0,border,1,0,0,0,1,0,0,0,1\n");
}

TEST_F(EvalCommand, an_affine_pose_gives_the_affine_map_and_its_matrix) {
  const AffineMap map;
  for (const char* kind : {"box", "cylinder"}) {
    done({"new", kind, "-o", "rest.json"});
    pose_by("rest.json", "posed.json", map);
    write_file("at.csv", "x,y,z\n0.1,0.25,0.2\n0.3,0.5,0.3\n0.15,0.9,0.05\n7,8,9\n");
    const auto rows = rows_of(done({"eval", "posed.json", "--at", "at.csv"}));
    const std::vector<glm::dvec3> points = {{0.1, 0.25, 0.2}, {0.3, 0.5, 0.3}, {0.15, 0.9, 0.05}};
    ASSERT_EQ(rows.size(), 5u);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(rows[i + 1].size(), 13u);
      EXPECT_EQ(rows[i + 1][3], "inside");
      EXPECT_LT(glm::distance(position(rows[i + 1]), map(points[i])), 1e-12);
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          EXPECT_NEAR(number(rows[i + 1][static_cast<std::size_t>(4 + 3 * a + b)]), map.A[b][a],
                      1e-12);
        }
      }
    }
    EXPECT_EQ(rows[4], (std::vector<std::string>{"7", "8", "9", "outside", "1", "0", "0", "0", "1",
                                                 "0", "0", "0", "1"}));
  }
}

TEST_F(EvalCommand, freezing_deeper_approaches_the_cubic_spline_as_its_refinements_do) {
  done({"new", "box", "--cells", "2", "2", "4", "-o", "box.json"});
  drag("box.json", "posed.json", 22, {0.1, 0, 0});  // the vertex in the middle
  write_file("at.csv", "x,y,z\n0.5,0.5,0.5\n0.5,0.5,0.25\n");
  for (int levels = 1; levels <= 4; ++levels) {
    const auto rows = rows_of(done(
        {"eval", "posed.json", "--at", "at.csv", "--freeze", "uniform:" + std::to_string(levels)}));
    // After n refinements a spline's vertex has the weight 2/3 + 4^-n/3 of its own control point
    // and 1/6 − 4^-n/6 of the next: 2/3 and 1/6 in the limit.
    const double own = 2.0 / 3 + std::pow(0.25, levels) / 3;
    const double next = 1.0 / 6 - std::pow(0.25, levels) / 6;
    EXPECT_LT(glm::distance(position(rows.at(1)), {0.5 + 0.1 * own * own * own, 0.5, 0.5}), 1e-14);
    EXPECT_LT(glm::distance(position(rows.at(2)), {0.5 + 0.1 * own * own * next, 0.5, 0.25}),
              1e-14);
  }
}

TEST_F(EvalCommand, freezing_is_adaptive_to_1e_5_unless_told_otherwise) {
  done({"new", "cylinder", "-o", "bar.json"});
  drag("bar.json", "posed.json", 20, {0.1, 0.05, 0});
  write_file("at.csv", "x,y,z\n0.1,0.5,0.2\n");
  EXPECT_EQ(done({"eval", "posed.json", "--at", "at.csv"}),
            done({"eval", "posed.json", "--at", "at.csv", "--freeze", "adaptive:1e-5"}));
}

TEST_F(EvalCommand, any_number_of_threads_gives_the_same_bytes) {
  done({"new", "cylinder", "-o", "bar.json"});
  drag("bar.json", "posed.json", 20, {0.1, 0.05, 0});
  std::string csv = "x,y,z\n";
  for (int i = 0; i < 3000; ++i) {
    csv += std::to_string(0.3 * std::sin(i)) + "," + std::to_string(i / 3000.0) + "," +
           std::to_string(0.3 * std::cos(1.7 * i)) + "\n";
  }
  write_file("at.csv", csv);
  const std::string one = done({"eval", "posed.json", "--at", "at.csv", "--threads", "1"});
  EXPECT_EQ(done({"eval", "posed.json", "--at", "at.csv", "--threads", "4"}), one);
  EXPECT_EQ(rows_of(one).size(), 3001u);
}

TEST_F(EvalCommand, reads_columns_by_name_in_any_order_with_others_between) {
  done({"new", "box", "-o", "box.json"});
  write_file("at.csv", "\xEF\xBB\xBF\"z\", name ,y,x\r\n3,a,2,1\r\n\r\n0.5, b ,0.5,0.25\r\n");
  const auto rows = rows_of(done({"eval", "box.json", "--at", "at.csv"}));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(position(rows[1]), glm::dvec3(1, 2, 3));
  EXPECT_EQ(position(rows[2]), glm::dvec3(0.25, 0.5, 0.5));
}

TEST_F(EvalCommand, a_header_alone_gives_a_header_alone) {
  done({"new", "box", "-o", "box.json"});
  write_file("at.csv", "x,y,z\n");
  EXPECT_EQ(done({"eval", "box.json", "--at", "at.csv"}), std::string(kHeader) + "\n");
}

TEST_F(EvalCommand, names_the_line_of_a_table_that_is_no_table_of_points) {
  done({"new", "box", "-o", "box.json"});
  const auto refused = [](const std::string& csv) {
    write_file("at.csv", csv);
    return refusal({"eval", "box.json", "--at", "at.csv"}, 1);
  };
  EXPECT_EQ(refused(""), "at.csv: is empty, needs a first line that names the columns");
  EXPECT_EQ(refused("1,2,3\n"), "at.csv:1: the first line must name the columns x,y,z");
  EXPECT_EQ(refused("x;y;z\n1;2;3\n"), "at.csv:1: the first line must name the columns x,y,z");
  EXPECT_EQ(refused("x,y,z\n1,2,3\n1,2\n"), "at.csv:3: column z is missing");
  EXPECT_EQ(refused("x,y,z\n1,,3\n"), "at.csv:2: column y is missing");
  EXPECT_EQ(refused("x,y,z\n1,2,nan\n"), "at.csv:2: z is not finite");
  EXPECT_EQ(refused("x,y,z\n1,-inf,2\n"), "at.csv:2: y is not finite");
  EXPECT_EQ(refused("x,y,z\n1e300,1,2\n"), "at.csv:2: x is beyond the largest coordinate, 1e18");
  EXPECT_EQ(refused("x,y,z\n1,two,3\n"), "at.csv:2: y is 'two', not a number");
}

}  // namespace
}  // namespace espalier::tools
