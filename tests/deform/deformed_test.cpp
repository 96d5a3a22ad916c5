#include "deform/model/deformed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "deform/model/normals.h"
#include "deform/model/obj.h"
#include "lattice/core/error.h"
#include "tests/deform/odd_obj_files.h"

namespace espalier {
namespace {

using Points = std::vector<glm::dvec3>;

Points points_of(const Model& model) {
  return {model.points().begin(), model.points().end()};
}

Points pair_normals_of(const Model& model) {
  Points normals;
  for (const PointNormal& pair : model.pairs()) {
    normals.push_back(unit_or_zero(model.normals()[pair.normal]));
  }
  return normals;
}

/// A model, and where its points and pairs go.
struct Motion {
  explicit Motion(const std::string& bytes)
      : model(parse_obj("m.obj", bytes)),
        points(points_of(model)),
        normals(pair_normals_of(model)) {}

  [[nodiscard]] std::string bytes(NormalMode mode = NormalMode::Deform) const {
    return deformed_bytes(model, points, normals, mode);
  }
  /// With smooth normals of the moved points added.
  [[nodiscard]] std::string with_normals() const {
    return deformed_bytes_with_normals(model, points,
                                       corner_normals(points, model.faces(), {.angle = 180}));
  }

  Model model;
  Points points;
  Points normals;
};

/// Two triangles that share one normal, at an edge.
const std::string kSharedNormal =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1 # up\nvn 1 0 0\n"
    "f 1//1 2//1 3//1\nf 2//1 4//2 3//1\n";

TEST(Deformed, changes_no_byte_when_nothing_moved) {
  for (const OddObjFile& file : odd_obj_files()) {
    const Motion motion(file.bytes);
    for (const NormalMode mode : {NormalMode::Deform, NormalMode::Keep}) {
      EXPECT_EQ(motion.bytes(mode), file.bytes) << file.what;
    }
    if (motion.model.pairs().empty()) {
      EXPECT_EQ(motion.with_normals(), file.bytes) << file.what;
    }
    EXPECT_EQ(deformed(motion.model, motion.points, {}).bytes(), file.bytes) << file.what;
  }
}

TEST(Deformed, replaces_only_the_numbers_that_changed) {
  Motion motion("# a\r\nv  0.50 1.0 -2   1 0 0 # red\r\nv 3 4 5\r\nf 1 2 1");
  motion.points[0].y = 1.25;
  motion.points[0].z = 1.0 / 3.0;
  EXPECT_EQ(motion.bytes(), "# a\r\nv  0.50 1.25 0.33333334   1 0 0 # red\r\nv 3 4 5\r\nf 1 2 1");
}

TEST(Deformed, writes_doubles_where_the_file_holds_doubles) {
  Motion motion("v 0.1234567891 0 0\nv 1 1 1\n");
  motion.points[1].x = 1.0 / 3.0;
  EXPECT_EQ(motion.bytes(), "v 0.1234567891 0 0\nv 0.3333333333333333 1 1\n");
}

TEST(Deformed, keeps_the_text_of_a_number_that_is_the_same_float) {
  Motion motion("v 0.10000000 0 0\n");
  motion.points[0] = {0.1 + 1e-12, 0, 1};
  EXPECT_EQ(motion.bytes(), "v 0.10000000 0 1\n");
}

TEST(Deformed, moves_points_across_joined_lines_and_after_the_faces) {
  Motion motion("f 1 2 3\nv 0 \\\n 0 0\nv 1 0 0\nv 0 1 0");
  motion.points[0] = {7, 8, 9};
  motion.points[2] = {0, 1, 5};
  EXPECT_EQ(motion.bytes(), "f 1 2 3\nv 7 \\\n 8 9\nv 1 0 0\nv 0 1 5");
}

TEST(Deformed, is_the_model_that_its_bytes_hold) {
  Motion motion(kSharedNormal);
  motion.points[3] = {1.0 / 3.0, 2, 3};
  const Model model = deformed(motion.model, motion.points, motion.normals);
  EXPECT_EQ(model.bytes(), motion.bytes());
  EXPECT_EQ(model.points()[3], glm::dvec3(0.33333334, 2, 3));
  EXPECT_EQ(model.path(), "m.obj");
}

TEST(Deformed, turns_a_normal_where_all_its_points_agree) {
  Motion motion(kSharedNormal);
  for (std::size_t pair = 0; pair < 3; ++pair) {
    motion.normals[pair] = {0.6, 0, 0.8};
  }
  motion.normals[1].z += 5e-7;
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0.6 0 0.8 # up\nvn 1 0 0\n"
            "f 1//1 2//1 3//1\nf 2//1 4//2 3//1\n");
}

TEST(Deformed, splits_a_normal_that_turns_differently_at_its_points) {
  Motion motion(kSharedNormal);
  motion.normals[0] = {0.6, 0, 0.8};
  motion.normals[2] = {0, 1, 0};
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1 # up\nvn 0.6 0 0.8\nvn 0 1 0\nvn 1 0 0\n"
            "f 1//2 2//1 3//3\nf 2//1 4//4 3//3\n");
}

TEST(Deformed, gives_the_first_value_to_the_old_line_when_no_point_keeps_it) {
  Motion motion(kSharedNormal);
  motion.normals[0] = motion.normals[2] = {0, 1, 0};
  motion.normals[1] = {0.6, 0, 0.8};
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 1 0 # up\nvn 0.6 0 0.8\nvn 1 0 0\n"
            "f 1//1 2//2 3//1\nf 2//2 4//3 3//1\n");
}

TEST(Deformed, averages_instead_of_splitting_when_asked_to_keep) {
  Motion motion(kSharedNormal);
  motion.normals[0] = {1, 0, 0};
  motion.normals[1] = {0, 1, 0};
  motion.normals[2] = {0, 0, 1};
  EXPECT_EQ(motion.bytes(NormalMode::Keep),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0.57735026 0.57735026 0.57735026 # up\n"
            "vn 1 0 0\nf 1//1 2//1 3//1\nf 2//1 4//2 3//1\n");
}

TEST(Deformed, rewrites_relative_references_after_inserted_normals) {
  Motion motion(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf -3//-1 -2//-1 -1//-1\nvn 1 0 0\n"
      "f -3/-1 -2//-1 -1//-2\nf 1//1 2//2 3//-2\n");
  motion.normals[0] = {0, 1, 0};
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nvn 0 1 0\nf -3//-1 -2//-2 -1//-2\n"
            "vn 1 0 0\nf -3/-1 -2//-1 -1//-3\nf 1//2 2//3 3//-3\n");
}

TEST(Deformed, keeps_references_forward_only_where_they_were) {
  Motion motion("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//2\nvn 0 0 1\nvn 1 0 0");
  motion.normals[2] = {0, 1, 0};
  motion.normals[1] = {0, 1, 0};
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//2 3//3\nvn 0 0 1\nvn 0 1 0\nvn 0 1 0");
}

TEST(Deformed, inserts_after_a_last_line_without_end_and_with_the_line_end_of_the_file) {
  Motion motion("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1//1 2//1 3//1\r\nvn 0 0 1");
  motion.normals[2] = {0, 1, 0};
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1//1 2//1 3//2\r\nvn 0 0 1\r\nvn 0 1 0");
}

TEST(Deformed, renumbers_normals_of_free_form_surfaces) {
  Motion motion(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nvn 0 1 0\n"
      "surf 0 1 0 1 1/1/1 2/1/1 3/1/2 4/1/-1\n");
  motion.normals[0] = {1, 0, 0};
  EXPECT_EQ(motion.bytes(),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nvn 1 0 0\nvn 0 1 0\n"
            "surf 0 1 0 1 1/1/2 2/1/1 3/1/3 4/1/-1\n");
}

TEST(Deformed, keeps_normals_whose_new_direction_is_undefined) {
  Motion motion(kSharedNormal);
  motion.points[0].z = 1;
  motion.normals[0] = glm::dvec3(0);
  motion.normals[1] = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(motion.bytes(), "v 0 0 1" + kSharedNormal.substr(7));
}

TEST(Deformed, gives_every_corner_its_own_normal_within_a_millionth) {
  std::string bytes;
  for (int i = 0; i < 60; ++i) {
    bytes += "v " + std::to_string(i) + " 0 0\n";
  }
  bytes += "vn 0 0 1\nvn 0 1 0\n";
  for (int i = 1; i + 2 <= 60; ++i) {
    const std::string n = i % 2 == 0 ? "-1" : "-2";
    bytes += "f " + std::to_string(i) + "//1 " + std::to_string(i + 1) + "//" + n + " " +
             std::to_string(i + 2) + "//2\n";
  }
  Motion motion(bytes);
  std::mt19937 random(3);
  for (glm::dvec3& normal : motion.normals) {
    const double angle =
        static_cast<double>(random() % 25) * 0.1 + static_cast<double>(random() % 3) * 2e-7;
    normal = {std::sin(angle), 0, std::cos(angle)};
  }
  const Model model = deformed(motion.model, motion.points, motion.normals);
  EXPECT_LE(model.normals().size(), 2u * 25u + 2u);
  for (std::size_t corner = 0; corner < model.corner_pairs().size(); ++corner) {
    const glm::dvec3 written = model.normals()[model.pairs()[model.corner_pairs()[corner]].normal];
    const glm::dvec3 wanted = motion.normals[motion.model.corner_pairs()[corner]];
    EXPECT_LT(glm::length(written - wanted), 1.2e-6);
  }
}

TEST(Deformed, adds_normals_before_the_first_face_when_asked) {
  Motion motion(
      "v 0 0 0\r\nv 1 0 0\r\nv 9 9 9\r\nv 0 1 0\r\nvt 0 0\r\ng x\r\n"
      "f 1/1 2// 4\r\nf -4 -3/ -1//");
  motion.points[0].z = motion.points[1].z = motion.points[3].z = 2;
  EXPECT_EQ(motion.bytes(),
            "v 0 0 2\r\nv 1 0 2\r\nv 9 9 9\r\nv 0 1 2\r\nvt 0 0\r\ng x\r\n"
            "f 1/1 2// 4\r\nf -4 -3/ -1//");
  EXPECT_EQ(motion.with_normals(),
            "v 0 0 2\r\nv 1 0 2\r\nv 9 9 9\r\nv 0 1 2\r\nvt 0 0\r\ng x\r\n"
            "vn 0 0 1\r\nvn 0 0 1\r\nvn 0 0 1\r\n"
            "f 1/1/1 2//2 4//3\r\nf -4//-3 -3//-2 -1//-1");
}

TEST(Deformed, adds_normals_among_unused_and_in_place_of_missing_ones) {
  Motion unused("vn 1 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nvn 0 1 0\nf -3 -2 -1\n");
  unused.points[0].x = -1;
  EXPECT_EQ(unused.with_normals(),
            "vn 1 0 0\nv -1 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
            "f 1//2 2//3 3//4\nvn 0 1 0\nf -3//-4 -2//-3 -1//-2\n");
  Motion missing("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/7 2/1/7 3//7\n");
  missing.points[0].x = -1;
  EXPECT_EQ(missing.with_normals(),
            "v -1 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1/1/1 2/1/2 3//3\n");
}

/// Moves everything at random, and expects the result to be the same model elsewhere.
void expect_same_but_moved(const std::string& bytes, NormalMode mode, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-3, 3);
  Motion motion(bytes);
  for (glm::dvec3& point : motion.points) {
    point = {number(random), number(random), number(random)};
  }
  for (glm::dvec3& normal : motion.normals) {
    normal = unit_or_zero({number(random), number(random), number(random)});
  }
  Model model = deformed(motion.model, motion.points, motion.normals, mode);
  if (motion.model.pairs().empty() && mode == NormalMode::Keep) {
    model = parse_obj("m.obj", motion.with_normals());
  }
  ASSERT_EQ(model.points().size(), motion.points.size());
  for (std::size_t i = 0; i < motion.points.size(); ++i) {
    EXPECT_LT(glm::length(model.points()[i] - motion.points[i]), 1e-6);
  }
  EXPECT_EQ(model.faces().n_rows(), motion.model.faces().n_rows());
  ASSERT_EQ(model.faces().n_values(), motion.model.faces().n_values());
  EXPECT_TRUE(std::equal(model.faces().values().begin(), model.faces().values().end(),
                         motion.model.faces().values().begin()));
  if (mode == NormalMode::Deform) {
    ASSERT_EQ(model.corner_pairs().size(), motion.model.corner_pairs().size());
    for (std::size_t corner = 0; corner < model.corner_pairs().size(); ++corner) {
      const std::int32_t pair = model.corner_pairs()[corner];
      const std::int32_t old_pair = motion.model.corner_pairs()[corner];
      ASSERT_EQ(pair < 0, old_pair < 0);
      EXPECT_TRUE(pair < 0 || glm::length(model.normals()[model.pairs()[pair].normal] -
                                          motion.normals[old_pair]) < 1.2e-6);
    }
  }
}

TEST(Deformed, is_the_same_model_elsewhere_whatever_moves) {
  std::mt19937 random(11);
  for (const OddObjFile& file : odd_obj_files()) {
    for (const NormalMode mode : {NormalMode::Deform, NormalMode::Keep}) {
      SCOPED_TRACE(file.what);
      expect_same_but_moved(file.bytes, mode, random);
    }
  }
}

TEST(Deformed, is_the_same_model_elsewhere_after_random_changes_of_the_file) {
  std::mt19937 random(12);
  int n_parsed = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string bytes = mutated(kRichObj, random);
    try {
      (void)parse_obj("m.obj", bytes);
    } catch (const FileError&) {
      continue;
    }
    SCOPED_TRACE(bytes);
    ++n_parsed;
    expect_same_but_moved(bytes, static_cast<NormalMode>(i % 2), random);
  }
  EXPECT_GT(n_parsed, 300);
}

TEST(Deformed, refuses_wrong_counts_and_points_without_place) {
  const Motion motion(kSharedNormal);
  const auto error_of = [&](const Points& points, const Points& normals) -> std::string {
    try {
      (void)deformed_bytes(motion.model, points, normals);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of({}, {}), "deformed: 0 points given, m.obj has 4");
  EXPECT_EQ(error_of(motion.points, Points(2)),
            "deformed: 2 normals given, m.obj has 4 pairs of point and normal");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), 2e18, -std::numeric_limits<double>::infinity()}) {
    Points points = motion.points;
    points[2].y = bad;
    EXPECT_NE(error_of(points, {}).find("deformed: point 2 moved to"), std::string::npos);
  }
}

}  // namespace
}  // namespace espalier
