/// espalier weights, read back by a reader of its own.

#include <algorithm>
#include <glm/geometric.hpp>
#include <sstream>

#include "deform/model/model_file.h"
#include "lattice/core/file.h"
#include "lattice/io/lattice_file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class WeightsCommand : public CommandLineTest {};

struct Entry {
  std::size_t row = 0;  ///< counted from 0
  std::size_t column = 0;
  double weight = 0;
};

struct Matrix {
  std::size_t n_rows = 0;
  std::size_t n_columns = 0;
  std::vector<Entry> entries;
};

Matrix read_matrix(const std::string& path) {
  std::istringstream text(read_file(path));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
  while (text.peek() == '%') {
    std::getline(text, line);
  }
  Matrix matrix;
  std::size_t n_entries = 0;
  text >> matrix.n_rows >> matrix.n_columns >> n_entries;
  for (std::size_t i = 0; i < n_entries; ++i) {
    Entry& entry = matrix.entries.emplace_back();
    text >> entry.row >> entry.column >> entry.weight;
    EXPECT_TRUE(text.good());
    EXPECT_TRUE(entry.row >= 1 && entry.row <= matrix.n_rows) << i;
    EXPECT_TRUE(entry.column >= 1 && entry.column <= matrix.n_columns) << i;
    --entry.row;
    --entry.column;
  }
  text >> std::ws;
  EXPECT_TRUE(text.eof());
  return matrix;
}

/// Six points inside a bar of radius 1 round the z axis, and one outside.
const std::vector<std::string> kScattered = {"0.5 0.1 0.2", "0.1 -0.2 0.4", "-0.3 0.3 0.7",
                                             "5 5 5",       "0 0 0.5",      "-0.4 -0.4 0.9",
                                             "0.2 0.6 0.3"};

std::string scattered_obj() {
  std::string text;
  for (const std::string& point : kScattered) {
    text += "v " + point + "\n";
  }
  return text;
}

std::string scattered_csv() {
  std::string text = "x y z\n";
  for (const std::string& point : kScattered) {
    text += point + "\n";
  }
  std::replace(text.begin(), text.end(), ' ', ',');
  return text;
}

TEST_F(WeightsCommand, says_how_the_points_move) {
  done({"new", "cylinder", "--to", "0", "0", "1", "--radius", "1", "--sectors", "5", "-o",
        "a.json"});
  drag("a.json", "posed.json", 7, {0.5, -0.25, 1});
  write_file("model.obj", scattered_obj());
  write_file("model.csv", scattered_csv());
  const Json report =
      Json::parse(done({"weights", "model.obj", "--lattice", "a.json", "-o", "w.mtx", "--json"}));
  const auto moved = rows_of(done({"eval", "posed.json", "--at", "model.csv"}));
  const Matrix matrix = read_matrix("w.mtx");
  const SubdivisionLattice lattice = read_lattice("posed.json");
  EXPECT_EQ(matrix.n_rows, 7u);
  EXPECT_EQ(matrix.n_columns, lattice.rest.size());
  EXPECT_EQ(report["rows"], 7);
  EXPECT_EQ(report["columns"], lattice.rest.size());
  EXPECT_EQ(report["weights"], matrix.entries.size());
  EXPECT_EQ(report["inside"], 6);
  EXPECT_EQ(report["outside"], 1);
  const Model model = read_model("model.obj");
  std::vector<glm::dvec3> expected(model.points().begin(), model.points().end());
  std::vector<double> sums(7, 0);
  for (const Entry& entry : matrix.entries) {
    EXPECT_NE(entry.weight, 0);
    expected[entry.row] += entry.weight * (lattice.pose[entry.column] - lattice.rest[entry.column]);
    sums[entry.row] += entry.weight;
  }
  ASSERT_EQ(moved.size(), 8u);
  for (std::size_t i = 0; i < 7; ++i) {
    const auto& row = moved[i + 1];
    const glm::dvec3 x(std::stod(row[0]), std::stod(row[1]), std::stod(row[2]));
    EXPECT_LT(glm::distance(x, expected[i]), 1e-12) << i;
    EXPECT_NEAR(sums[i], i == 3 ? 0 : 1, 1e-13) << i;
  }
  EXPECT_GT(glm::distance(expected[0], model.points()[0]), 1e-3);
}

TEST_F(WeightsCommand, reports_counts_as_text) {
  done({"new", "box", "--cells", "3", "3", "3", "-o", "a.json"});
  write_file("model.obj", "v 0.5 0.5 0.5\nv 2 2 2\n");
  EXPECT_EQ(done({"weights", "model.obj", "--lattice", "a.json", "-o", "w.mtx"}),
            "w.mtx: 2 points x 64 control points, 64 weights\n"
            "  1 inside, 0 on the border, 1 outside, 0 unconverged\n");
  EXPECT_EQ(done({"weights", "model.obj", "--lattice", "a.json", "-o", "w.mtx", "--quiet"}), "");
}

TEST_F(WeightsCommand, leaves_no_file_behind_when_it_fails) {
  done({"new", "box", "-o", "a.json"});
  write_file("model.obj", "v 0.5 0.5 0.5\n");
  refusal({"weights", "model.obj", "--lattice", "a.json", "--freeze", "deep", "-o", "w.mtx"}, 2);
  refusal({"weights", "model.obj", "--lattice", "none.json", "-o", "w.mtx"}, 1);
  refusal({"weights", "model.obj", "--lattice", "a.json", "-o", "none/w.mtx"}, 1);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.json", "model.obj"}));
}

}  // namespace
}  // namespace espalier::tools
