/// One pose for many models, elsewhere too ([HHK92] section 4.1).

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <string>

#include "deform/model/deformed.h"
#include "deform/model/model_file.h"
#include "deform/scene/operation_text.h"
#include "lattice/build/reshape.h"
#include "lattice/core/error.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

Scene done(const Scene& scene, const std::string& line) {
  return apply(parse_call(line), scene);
}

std::string number(double x) {
  return std::to_string(x);
}

/// A sheet of n × n squares over [0.2,0.8]² with its points in rows.
std::string sheet(int n, double height) {
  std::string text;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      text += "v " + number(0.2 + 0.6 * i / n) + " " + number(0.2 + 0.6 * j / n) + " " +
              number(height + 0.1 * i * j / (n * n)) + "\n";
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = 1 + i + (n + 1) * j;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
              std::to_string(a + n + 2) + " " + std::to_string(a + n + 1) + "\n";
    }
  }
  return text;
}

std::vector<std::string> all_lattices() {
  return {"new box cells=3,3,3",
          "new cylinder from=0.5,0.5,-0.2 to=0.5,0.5,1.2 radius=0.9",
          "new bezier counts=4,4,4",
          "new bezier counts=4,4,1",
          "new bspline counts=6,6,6 ends=tripled,natural,uniform",
          "new nurbs counts=5,5,5",
          "new thb counts=5,5,5"};
}

/// A lattice "box" of a type, posed by noise, its weights uneven.
Scene posed_scene(const std::string& made) {
  Scene scene = done({}, made + " output=box");
  const Lattice& lattice = lattice_in(scene, "box");
  if (const auto* tensor = lattice.as<TensorLattice>(); tensor && !tensor->weights.empty()) {
    TensorLattice weighted = *tensor;
    for (std::size_t i = 0; i < weighted.weights.size(); ++i) {
      weighted.weights[i] = 1 + 0.2 * static_cast<double>(i % 3);
    }
    scene = with_lattice(scene, "box", weighted);
  }
  const auto rest = lattice_in(scene, "box").rest_points();
  return with_pose(scene, "box", test::jittered({rest.begin(), rest.end()}, 0.05, 1));
}

Model model_of(const std::string& text) {
  return parse_model(ModelFormat::Obj, "m.obj", text);
}

std::vector<glm::dvec3> moved(Scene scene, const Model& model) {
  scene = done(with_model(std::move(scene), "m", model), "deform model=m lattice=box output=out");
  const auto points = model_in(scene, "out").points();
  return {points.begin(), points.end()};
}

/// OBJ text that reads as floats rounds to these.
constexpr double kFloat = 2e-7;

TEST(OneDescription, moves_several_objects_and_keeps_how_they_lie_to_each_other) {
  for (const std::string& made : all_lattices()) {
    const Scene scene = posed_scene(made);
    // Apart and in one file: the same places.
    const std::string low = sheet(3, 0.3);
    const std::string high = sheet(3, 0.6);
    std::string both = low;
    both.erase(both.find("f "));
    std::string more = high;
    more.erase(more.find("f "));
    const auto first = moved(scene, model_of(low));
    const auto second = moved(scene, model_of(high));
    const auto together = moved(scene, model_of(both + more));
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_LT(glm::distance(together[i], first[i]), kFloat) << made;
      EXPECT_LT(glm::distance(together[first.size() + i], second[i]), kFloat) << made;
    }
  }
}

TEST(OneDescription, moves_low_and_high_resolution_versions_alike) {
  for (const std::string& made : all_lattices()) {
    const Scene scene = posed_scene(made);
    const auto low = moved(scene, model_of(sheet(3, 0.4)));
    const auto high = moved(scene, model_of(sheet(12, 0.4)));
    for (int j = 0; j <= 3; ++j) {
      for (int i = 0; i <= 3; ++i) {
        EXPECT_LT(glm::distance(low[static_cast<std::size_t>(i + 4 * j)],
                                high[static_cast<std::size_t>(4 * i + 13 * 4 * j)]),
                  kFloat)
            << made;
      }
    }
  }
}

TEST(OneDescription, acts_elsewhere_turned_and_scaled_as_it_does_here) {
  Placement placement;
  placement.about = {0.5, 0.25, 0};
  placement.by = {3, -2, 1};
  placement.linear = rotation({1, 2, 3}, 50) * glm::dmat3(2, 0, 0, 0, 2, 0, 0, 0, 2);
  const Model model = model_of(sheet(5, 0.4));
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& p : model.points()) {
    places.push_back(placement.of(p));
  }
  for (const std::string& made : all_lattices()) {
    const Scene scene = posed_scene(made);
    const Scene there = done(scene,
                             "transform lattice=box scale=2,2,2 rotate=50 axis=1,2,3 "
                             "about=0.5,0.25,0 move=3,-2,1 output=box");
    const auto here = moved(scene, model);
    const auto placed = moved(there, deformed(model, places, {}));
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_LT(glm::distance(placed[i], placement.of(here[i])), 10 * kFloat) << made;
    }
  }
}

TEST(OneDescription, may_be_stretched_and_mirrored) {
  for (const std::string& made : all_lattices()) {
    const Scene scene = posed_scene(made);
    const Scene there = done(scene, "transform lattice=box scale=-1,0.5,3 output=box");
    const auto rest = lattice_in(scene, "box").rest_points();
    const auto pose = lattice_in(scene, "box").posed_points();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const glm::dvec3 scale(-1, 0.5, 3);
      EXPECT_LT(glm::distance(lattice_in(there, "box").rest_points()[i], scale * rest[i]), 1e-14);
      EXPECT_LT(glm::distance(lattice_in(there, "box").posed_points()[i], scale * pose[i]), 1e-14);
    }
  }
}

TEST(OneDescription, is_not_placed_flat_or_beyond_all_bounds_or_in_part) {
  const Scene scene = posed_scene("new thb counts=5,5,5");
  const auto refusal = [&](const Scene& from, const std::string& line) -> std::string {
    try {
      (void)done(from, "transform lattice=box output=box " + line);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal(scene, "scale=1,0,1"), "transform: no factor of a scale may be zero");
  EXPECT_EQ(refusal(posed_scene("new bezier counts=4,4,1"), "scale=1,0,1"),
            "transform: no factor of a scale may be zero");
  EXPECT_NE(refusal(scene, "move=1e300,0,0"), "no error");
  EXPECT_EQ(refusal(scene, "vertices=0 move=1,0,0"),
            "box is a thb lattice; moving some vertices needs a subdivision lattice");
}

}  // namespace
}  // namespace espalier
