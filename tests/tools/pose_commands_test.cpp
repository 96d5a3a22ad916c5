/// espalier pose.

#include <cmath>

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class PoseCommands : public CommandLineTest {
 protected:
  /// A bar along x from 0 to 4, radius 0.5: its points are at whole x.
  static void make_arm() {
    done({"new", "cylinder", "--from", "0", "0", "0", "--to", "4", "0", "0", "--layers", "8", "-o",
          "arm.json"});
  }
};

TEST_F(PoseCommands, one_line_raises_an_arm_without_a_fold) {
  make_arm();
  EXPECT_EQ(done({"pose", "rotate", "arm.json", "--about", "2", "0", "0", "--along", "1", "0", "0",
                  "--angle", "60", "-o", "raised.json"}),
            "raised.json: 81 vertices, 216 edges, 200 faces, 64 cells\n");
  const Json raised = read_json("raised.json");
  EXPECT_EQ(raised["vertices"], read_json("arm.json")["vertices"]);
  const glm::dvec3 end = point_of(raised["pose"][72]);
  EXPECT_NEAR(end.x, 2 + 2 * 0.5, 1e-14);
  EXPECT_NEAR(end.y, 2 * std::sqrt(0.75), 1e-14);
  EXPECT_EQ(raised["pose"][0], raised["vertices"][0]);
  EXPECT_EQ(Json::parse(run({"check", "raised.json", "--json"}).out)["local"], "certified");
}

TEST_F(PoseCommands, poses_compose_on_the_pose_that_is_there) {
  make_arm();
  const std::vector<std::string> elbow = {
      "pose", "bend",    "arm.json", "--from", "1",         "0",         "0", "--to", "3", "0",
      "0",    "--angle", "90",       "-o",     "bent.json", "--towards", "0", "1",    "0"};
  done(elbow);
  done({"pose", "rotate", "bent.json", "--about", "0", "0", "0", "--axis", "1", "0", "0", "--angle",
        "90", "-o", "turned.json"});
  const glm::dvec3 bent = point_of(read_json("bent.json")["pose"][72]);
  const glm::dvec3 turned = point_of(read_json("turned.json")["pose"][72]);
  EXPECT_NEAR(bent.y, 2 * 2 / 3.141592653589793 + 1, 1e-12);
  EXPECT_NEAR(turned.x, bent.x, 1e-14);
  EXPECT_NEAR(turned.z, bent.y, 1e-14);
}

TEST_F(PoseCommands, every_type_of_lattice_is_posed) {
  done({"new", "box", "-o", "subdivision.json"});
  for (const char* type : {"bezier", "bspline", "nurbs", "thb"}) {
    done({"new", type, "-o", std::string(type) + ".json"});
  }
  write_file("at.csv", "x,y,z\n0.5,0.5,1\n");
  for (const char* type : {"subdivision", "bezier", "bspline", "nurbs", "thb"}) {
    done({"pose", "rotate", std::string(type) + ".json", "--about", "0.5", "0.5", "0", "--angle",
          "90", "--axis", "1", "0", "0", "-o", "posed.json"});
    const auto row = rows_of(done({"eval", "posed.json", "--at", "at.csv"})).at(1);
    EXPECT_NEAR(std::stod(row.at(0)), 0.5, 1e-12) << type;
    EXPECT_NEAR(std::stod(row.at(1)), -0.5, 1e-12) << type;
    EXPECT_NEAR(std::stod(row.at(2)), 0, 1e-12) << type;
  }
}

TEST_F(PoseCommands, turning_by_nothing_writes_the_same_file) {
  make_arm();
  done({"pose", "twist", "arm.json", "--from", "0", "0", "0", "--to", "1", "0", "0", "--angle", "0",
        "-o", "same.json"});
  EXPECT_EQ(read_file("same.json"), read_file("arm.json"));
}

TEST_F(PoseCommands, only_the_control_points_that_are_named_are_posed) {
  make_arm();
  done({"pose", "move", "arm.json", "--about", "0", "0", "0", "--by", "0", "0", "7", "--vertices",
        "3,9-11", "-o", "moved.json"});
  const Json moved = read_json("moved.json");
  for (std::size_t i = 0; i < 81; ++i) {
    const bool is_named = i == 3 || (i >= 9 && i <= 11);
    EXPECT_EQ(point_of(moved["pose"][i]),
              point_of(moved["vertices"][i]) + glm::dvec3(0, 0, is_named ? 7 : 0));
  }
}

TEST_F(PoseCommands, tapering_and_scaling_change_sections) {
  make_arm();
  done({"pose", "taper", "arm.json", "--from", "0", "0", "0", "--to", "4", "0", "0", "--scale",
        "0.5", "-o", "thin.json"});
  done({"pose", "scale", "arm.json", "--about", "2", "0", "0", "--along", "1", "0", "0",
        "--falloff", "1", "--scale", "1", "3", "1", "-o", "thick.json"});
  const glm::dvec3 rest = point_of(read_json("arm.json")["vertices"][73]);
  const glm::dvec3 thin = point_of(read_json("thin.json")["pose"][73]);
  const glm::dvec3 thick = point_of(read_json("thick.json")["pose"][73]);
  EXPECT_EQ(thin, glm::dvec3(rest.x, rest.y / 2, rest.z / 2));
  EXPECT_EQ(thick, glm::dvec3(rest.x, rest.y * 3, rest.z));
}

TEST_F(PoseCommands, name_what_they_refuse) {
  make_arm();
  const auto complaint = [](std::vector<std::string> words) {
    words.insert(words.begin(), "pose");
    words.insert(words.end(), {"-o", "out.json"});
    return refusal(words, 2);
  };
  EXPECT_EQ(
      complaint({"rotate", "arm.json", "--about", "0", "0", "0", "--angle", "9", "--falloff", "1"}),
      "--falloff needs --along, the direction of the limb");
  EXPECT_EQ(complaint({"rotate", "arm.json", "--about", "0", "0", "0", "--angle", "9", "--along",
                       "0", "0", "0"}),
            "--along must not be zero");
  EXPECT_EQ(complaint({"rotate", "arm.json", "--about", "0", "0", "0", "--angle", "nan"}),
            "--angle must be a finite number");
  EXPECT_EQ(complaint({"twist", "arm.json", "--from", "0", "0", "0", "--to", "0", "0", "0",
                       "--angle", "9"}),
            "--from and 'to' must be finite and differ");
  EXPECT_EQ(complaint({"move", "arm.json", "--about", "0", "0", "0", "--by", "1", "0", "0",
                       "--vertices", "81"}),
            "--vertices: control point 81 does not exist, there are 81");
  EXPECT_EQ(complaint({"move", "arm.json", "--about", "0", "0", "0", "--by", "1e300", "0", "0"}),
            "point 0 of out.json would be too far away, or nowhere");
  EXPECT_EQ(complaint({"flap", "arm.json"}),
            "there is no command 'flap', only: rotate, twist, bend, taper, scale, move");
}

}  // namespace
}  // namespace espalier::tools
