#include <gmock/gmock.h>

#include "lattice/topology/sharpness.h"
#include "tests/tools/deform_fixture.h"

namespace espalier {
namespace {

using testing::HasSubstr;

class BindCommand : public test::DeformCommand {
 protected:
  BindCommand() {
    const auto outcome = run({"bind", "model.obj", "--lattice", "box.json", "-o", "b.binding"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("4 inside, 0 on the border, 1 outside"));
  }

  [[nodiscard]] test::Outcome deform_with_binding(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"deform", "model.obj",    "--lattice", "box.json",
                                      "--pose", "shifted.json", "--binding", "b.binding",
                                      "-o",     "out.obj"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  /// What is said after `change` was made to the lattice's file.
  template <class Change>
  [[nodiscard]] std::string error_after(const Change& change) const {
    SubdivisionLattice lattice = read_lattice(path("box.json"));
    change(lattice);
    write_lattice(path("box.json"), lattice);
    const auto outcome = deform_with_binding();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_FALSE(std::filesystem::exists(path("out.obj")));
    return outcome.errors;
  }
};

TEST_F(BindCommand, makes_deform_write_the_same_bytes) {
  add_lattice("box.json", "shifted.json", {0.1, 0.7, 0.3});
  for (const std::string freeze : {"adaptive", "adaptive:1e-3", "uniform:2"}) {
    ASSERT_EQ(
        run({"bind", "model.obj", "--lattice", "box.json", "--freeze", freeze, "-o", "b.binding"})
            .status,
        0);
    const auto outcome = deform_with_binding();
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    const std::string with = bytes("out.obj");
    (void)deformed_points({"--freeze", freeze});
    EXPECT_EQ(bytes("out.obj"), with) << freeze;
    EXPECT_NE(with, test::kModel);
  }
}

TEST_F(BindCommand, is_bound_to_the_rest_shape_and_not_to_the_pose) {
  const auto outcome = run({"deform", "model.obj", "--lattice", "shifted.json", "--binding",
                            "b.binding", "-o", "out.obj"});
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

TEST_F(BindCommand, tells_what_changed_since) {
  EXPECT_THAT(error_after([](auto& lattice) { lattice.rest[0].x = -0x1p-40; }),
              HasSubstr("b.binding: the lattice's rest shape changed since the binding was made; "
                        "bind again"));
  EXPECT_THAT(error_after([](auto& lattice) { lattice.sharpness.vertices[VertexId{0}] = 2; }),
              HasSubstr("the lattice's sharp edges or vertices changed"));
  EXPECT_THAT(error_after([](auto& lattice) { lattice.scheme = Scheme::MacCrackenJoy; }),
              HasSubstr("the lattice's scheme changed"));
  EXPECT_THAT(error_after([](auto& lattice) {
                lattice = test::lattice_from(make_box({2, 2, 3}, {0, 0, 0}, {1, 1, 1}));
              }),
              HasSubstr("cells"));
}

TEST_F(BindCommand, tells_that_the_model_or_the_freeze_option_changed) {
  EXPECT_THAT(deform_with_binding({"--freeze", "uniform:2"}).errors,
              HasSubstr("was made with --freeze adaptive, not uniform:2; bind again"));
  write("model.obj", std::string(test::kModel) + "v 1 1 1\n");
  EXPECT_THAT(deform_with_binding().errors, HasSubstr("the model's points changed"));
  write("b.binding", "ESPL");
  EXPECT_THAT(deform_with_binding().errors, HasSubstr("is cut short: 4 bytes"));
  write("b.binding", test::kModel);
  EXPECT_THAT(deform_with_binding().errors, HasSubstr("is no binding"));
}

TEST_F(BindCommand, lets_outside_points_follow_the_boundary_as_far_as_the_falloff_reaches) {
  write("model.obj", std::string("v 1.5 0.5 0.5\nv 0.5 0.5 0.5\nv 2 0.5 0.5\n"));
  const std::vector<glm::dvec3> expected = {{1.75, 0.5, 0.5}, {1, 0.5, 0.5}, {2, 0.5, 0.5}};
  EXPECT_EQ(deformed_points({"--outside", "falloff:1"}), expected);
  EXPECT_EQ(deformed_points({"--outside", "keep"})[0], glm::dvec3(1.5, 0.5, 0.5));
  ASSERT_EQ(run({"bind", "model.obj", "--lattice", "box.json", "--outside", "falloff:1", "-o",
                 "b.binding"})
                .status,
            0);
  EXPECT_EQ(deformed_points({"--binding", "b.binding"}), expected);
  EXPECT_THAT(deform_with_binding({"--outside", "keep"}).errors,
              HasSubstr("was made with --outside falloff:1, not keep"));
  for (const char* outside : {"falloff", "falloff:0", "falloff:-1", "falloff:nan", "follow"}) {
    const auto outcome = run(
        {"deform", "model.obj", "--lattice", "box.json", "--outside", outside, "-o", "out.obj"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.errors, HasSubstr("must be keep, or falloff:DISTANCE")) << outside;
  }
}

TEST_F(BindCommand, never_replaces_the_model_or_the_lattice) {
  for (const char* output : {"model.obj", "box.json"}) {
    EXPECT_EQ(run({"bind", "model.obj", "--lattice", "box.json", "-o", output}).status, 2);
  }
  EXPECT_EQ(bytes("model.obj"), test::kModel);
}

TEST_F(BindCommand, goes_with_each_of_several_lattices) {
  ASSERT_EQ(run({"bind", "model.obj", "--lattice", "other.json", "-o", "o.binding"}).status, 0);
  const auto both = [&](const std::string& first, const std::string& second) {
    return run({"deform", "model.obj", "--lattice", "box.json", "--lattice", "other.json", "--pose",
                "shifted.json", "--pose", "raised.json", "--binding", first, "--binding", second,
                "-o", "out.obj"});
  };
  EXPECT_EQ(both("b.binding", "o.binding").status, 0);
  EXPECT_EQ(points("out.obj"), moved({0.5, 0, 0.25}, [](std::size_t) { return 1.0; }));
  EXPECT_EQ(run({"deform", "model.obj", "--lattice", "box.json", "--lattice", "other.json",
                 "--binding", "b.binding", "-o", "out.obj"})
                .status,
            2);
}

}  // namespace
}  // namespace espalier
