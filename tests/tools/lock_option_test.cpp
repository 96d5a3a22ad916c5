#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/tools/deform_fixture.h"

namespace espalier {
namespace {

using Json = nlohmann::ordered_json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A prism that stands half in the unit cube and half below it: 3 points at z = 0.5, 3 at z = -0.5.
/// Its three edges along z leave through three of the four faces at z = 0.
constexpr const char* kLimb =
    "v 0.3 0.3 0.5\nv 0.7 0.3 0.5\nv 0.3 0.7 0.5\n"
    "v 0.3 0.3 -0.5\nv 0.7 0.3 -0.5\nv 0.3 0.7 -0.5\n"
    "f 1 2 3\nf 6 5 4\nf 1 4 5 2\nf 2 5 6 3\nf 3 6 4 1\n";

class LockOption : public test::DeformCommand {
 protected:
  LockOption() { write("limb.obj", kLimb); }

  [[nodiscard]] test::Outcome deform(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {"deform", "limb.obj",     "--lattice", "box.json",
                                      "--pose", "shifted.json", "-o",        "out.obj"};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
};

TEST_F(LockOption, tells_what_it_locked_and_joins_the_model) {
  const auto outcome = deform({"--lock", "C0"});
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output,
              EndsWith("  3 inside, 0 on the border, 3 outside, 0 unconverged\n"
                       "  3 boundary faces locked C0: 9 control points count as unmoved\n"));
  // With the layer at z = 0 unmoved and the two above moved by d, half way up: (0 + 4 d + d) / 6.
  EXPECT_FLOAT_EQ(static_cast<float>(points("out.obj")[0].x), 0.3F + 0.5F * 5 / 6);
}

TEST_F(LockOption, reports_as_json_which_faces_it_locked) {
  const Json json = Json::parse(deform({"--lock", "C1", "--json"}).output);
  EXPECT_EQ(json["lock"]["option"], "C1");
  EXPECT_EQ(json["lock"]["faces"].size(), 3u);
  EXPECT_EQ(json["lock"]["controls"], 18);
  EXPECT_EQ(json["torn_faces"], 0);
}

TEST_F(LockOption, locks_the_faces_it_is_given_by_number) {
  const Json all = Json::parse(deform({"--lock", "C1", "--json"}).output)["lock"]["faces"];
  std::string option = "C1:";
  for (const Json& face : all) {
    option += (option.size() > 3 ? "," : "") + face.dump();
  }
  const std::string locked = bytes("out.obj");
  EXPECT_EQ(deform({"--lock", option}).status, 0);
  EXPECT_EQ(bytes("out.obj"), locked);
}

TEST_F(LockOption, acts_the_same_with_a_saved_binding) {
  EXPECT_EQ(deform({"--lock", "C2"}).status, 0);
  const std::string locked = bytes("out.obj");
  EXPECT_EQ(run({"bind", "limb.obj", "--lattice", "box.json", "-o", "limb.binding"}).status, 0);
  EXPECT_EQ(deform({"--lock", "C2", "--binding", "limb.binding"}).status, 0);
  EXPECT_EQ(bytes("out.obj"), locked);
}

TEST_F(LockOption, stands_for_all_lattices_or_repeats_in_their_order) {
  const std::vector<std::string> second = {"--lattice", "other.json", "--pose", "raised.json"};
  const auto both = [&](std::vector<std::string> locks) {
    locks.insert(locks.end(), second.begin(), second.end());
    return deform(locks);
  };
  const auto all = both({"--lock", "C0"});
  EXPECT_EQ(all.status, 0) << all.errors;
  EXPECT_THAT(all.output, Not(HasSubstr("torn")));
  EXPECT_THAT(both({"--lock", "C0", "--lock", "none"}).output, HasSubstr("3 faces are torn"));
  const auto named = both({"--lock", "C0:0"});
  EXPECT_EQ(named.status, 2);
  EXPECT_THAT(named.errors, HasSubstr("--lock is given 1 time for 2 lattices"));
}

TEST_F(LockOption, tells_that_a_model_that_crosses_nothing_locks_nothing) {
  const auto outcome = run({"deform", "model.obj", "--lattice", "box.json", "--pose",
                            "shifted.json", "--lock", "C1", "-o", "out.obj"});
  EXPECT_THAT(outcome.output, HasSubstr("  no boundary face locked: the model does not cross the "
                                        "lattice's boundary\n"));
}

TEST_F(LockOption, refuses_what_is_no_lock_as_wrong_usage) {
  const auto outcome = deform({"--lock", "C3"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("espalier: --lock is 'C3', must be none, C0, C1 or C2"));
  EXPECT_THAT(deform({"--lock", "C1:77"}).errors,
              HasSubstr("box.json face 77 does not exist: the lattice has 36"));
}

TEST_F(LockOption, missing_a_torn_limb_is_told_with_what_would_join_it) {
  const auto torn = deform({});
  EXPECT_EQ(torn.status, 0);
  EXPECT_THAT(torn.output, EndsWith("  3 faces are torn where the model leaves the lattice; "
                                    "--outside falloff:D or --lock C1 joins them\n"));
  EXPECT_EQ(Json::parse(deform({"--json"}).output)["torn_faces"], 3);
  for (const std::vector<std::string>& joined : {std::vector<std::string>{"--lock", "C1"},
                                                 {"--outside", "falloff:0.5"},
                                                 {"--strength", "0"}}) {
    EXPECT_THAT(deform(joined).output, Not(HasSubstr("torn"))) << joined[0];
  }
}

TEST_F(LockOption, a_pose_that_rests_at_the_border_tears_nothing) {
  SubdivisionLattice lattice = read_lattice(path("box.json"));
  lattice.pose = lattice.rest;
  for (glm::dvec3& point : lattice.pose) {
    point.x += point.z;  // a shear that leaves z = 0 in place
  }
  write_lattice(path("sheared.json"), lattice);
  const auto outcome = run({"deform", "limb.obj", "--lattice", "sheared.json", "-o", "out.obj"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, Not(HasSubstr("torn")));
  EXPECT_FLOAT_EQ(static_cast<float>(points("out.obj")[0].x), 0.8F);
}

TEST_F(LockOption, counts_one_torn_face_as_one) {
  write("one.obj", "v 0.3 0.3 0.5\nv 0.7 0.3 -0.5\nv 0.3 0.7 -0.5\nf 1 2 3\n");
  EXPECT_THAT(run({"deform", "one.obj", "--lattice", "shifted.json", "-o", "out.obj"}).output,
              EndsWith("  1 face is torn where the model leaves the lattice; --outside falloff:D "
                       "or --lock C1 joins it\n"));
}

TEST_F(LockOption, is_told_for_every_pose_of_a_series) {
  const auto outcome = run({"deform", "limb.obj", "--lattice", "box.json", "--pose",
                            path("shift") + "*.json", "--lock", "C1", "-o", path("{}") + ".obj"});
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("3 boundary faces locked C1: 18 control points"));
}

}  // namespace
}  // namespace espalier
