/// Locks, influence, regions under a model and bad files of Bézier, B-spline, NURBS and
/// hierarchical lattices from the command line.

#include <gmock/gmock.h>

#include "tests/tools/tensor_fixture.h"

namespace espalier::tools {
namespace {

using ::testing::HasSubstr;

TEST_F(TensorCommands, info_tells_how_many_points_of_a_model_control_points_move) {
  make_all();
  const Json thb = Json::parse(done({"info", "thb.json", "--model", "cloud.obj", "--json"}));
  const Json weights =
      Json::parse(done({"weights", "cloud.obj", "--lattice", "thb.json", "-o", "W.mtx", "--json"}));
  EXPECT_EQ(thb["influence"], weights["levels"]);
  ASSERT_EQ(thb["influence"].size(), 2u);
  EXPECT_EQ(thb["model"]["inside"], 5);
  double n_weights = 0;
  for (std::size_t level = 0; level < 2; ++level) {
    const Json& of_level = thb["influence"][level];
    EXPECT_EQ(of_level["control_points"], thb["levels"][level]);
    n_weights += of_level["mean_points"].get<double>() * of_level["control_points"].get<double>();
  }
  EXPECT_NEAR(n_weights, weights["weights"].get<double>(), 1e-9);
  EXPECT_THAT(done({"info", "thb.json", "--model", "cloud.obj"}),
              HasSubstr("of the model 5 points inside, 0 on the border, 0 outside"));
  done({"new", "box", "--cells", "2", "2", "2", "-o", "box.json"});
  const Json box = Json::parse(done({"info", "box.json", "--model", "cloud.obj", "--json"}));
  ASSERT_EQ(box["influence"].size(), 1u);
  EXPECT_EQ(box["influence"][0]["control_points"], 27);
  EXPECT_THAT(refusal({"info", "cloud.obj", "--model", "cloud.obj"}, 2),
              HasSubstr("--model is for lattices"));
}

TEST_F(TensorCommands, refine_under_a_model_moves_nothing_and_needs_no_boxes) {
  write_file("parts.obj",
             "v 0.1 0.1 0.1\nv 0.15 0.15 0.15\nv 0.1 0.1 0.11\nv 0.9 0.9 0.9\n"
             "g part\nf 1 2 3\ng rest\nf 2 3 4\n");
  done({"new", "thb", "--counts", "7", "7", "7", "-o", "rest.json"});
  pose_lattice("rest.json", "posed.json", bend);
  const auto before = deformed_points("posed.json");
  const auto n_controls = [](const std::string& path) {
    return read_any_lattice(path).as<ThbLattice>()->hierarchy->n_controls_by_level();
  };
  done({"refine", "posed.json", "--model", "parts.obj", "--only", "part", "--level", "2", "--grow",
        "1", "-o", "finer.json"});
  EXPECT_LT(farthest(deformed_points("finer.json"), before), 1e-13);
  // Level 0 has 4 cells an axis; 2 of them, then 3 of 8, which end on the boundary.
  EXPECT_EQ(n_controls("finer.json"), (std::vector<std::size_t>{343 - 8, 64 - 27, 216}));
  done({"refine", "posed.json", "--model", "parts.obj", "--only", "part", "-o", "finer.json"});
  EXPECT_EQ(n_controls("finer.json"), (std::vector<std::size_t>{343 - 1, 8}));
  EXPECT_LT(farthest(deformed_points("finer.json"), before), 1e-13);
  const auto refused = [](const Words& options, int status, const std::string& reason) {
    Words words = {"refine", "posed.json", "-o", "x.json"};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_THAT(refusal(words, status), HasSubstr(reason));
  };
  refused({"--only", "part"}, 2, "--only is for a --model");
  refused({"--grow", "1"}, 2, "--grow is for a --model");
  refused({"--model", "parts.obj", "--grow", "17"}, 2, "17 rings of cells, must be 0 to 16");
  refused({"--model", "parts.obj", "--level", "0"}, 2, "the level is 0, must be 1 to 15");
  refused({"--model", "parts.obj", "--levels", "2"}, 2, "--levels is for other ways");
  refused({"--model", "parts.obj", "--only", "nobody"}, 2, "nobody");
  write_file("far.obj", "v 9 9 9\nv 9 8 9\nv 8 9 9\nf 1 2 3\n");
  refused({"--model", "far.obj"}, 2, "none of the points lies in the lattice");
  EXPECT_THAT(files(), ::testing::Not(::testing::Contains("x.json")));
}

TEST_F(TensorCommands, deform_locks_grids_where_the_model_leaves_them) {
  write_file("limb.obj", "v 0.5 0.5 0.5\nv 0.5 0.6 0.5\nv 0.5 0.5 -3\nf 1 2 3\n");
  for (const std::string& type : make_all()) {
    pose_lattice(type + ".json", "posed.json",
                 [](const glm::dvec3& x) { return x + glm::dvec3(0.5, 0, 0); });
    const auto deform = [](const std::string& lock) {
      return Json::parse(done({"deform", "limb.obj", "--lattice", "posed.json", "--lock", lock,
                               "-o", "out.obj", "--json"}));
    };
    const Json report = deform("C0");
    EXPECT_EQ(report["torn_faces"], 0) << type;
    EXPECT_GT(report["lock"]["controls"], 0) << type;
    EXPECT_LE(deform("C0")["lock"]["controls"], deform("C0:w0")["lock"]["controls"]) << type;
  }
}

TEST_F(TensorCommands, check_and_pull_certify_volumes_with_weights_that_differ) {
  make_all();
  const auto check = [](const std::string& path, int status, const Words& more = {}) {
    Words words = {"check", path, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const auto outcome = run(words);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return Json::parse(outcome.out);
  };
  EXPECT_EQ(check("nurbs.json", 0)["local"], "certified");
  pose_lattice("nurbs.json", "posed.json", bend);
  EXPECT_EQ(check("posed.json", 0)["local"], "certified");
  Json posed = read_json("posed.json");
  posed["pose_weights"] = posed["weights"];
  posed["pose_weights"][30] = 3;
  write_json("posed.json", posed);
  EXPECT_EQ(check("posed.json", 0)["local"], "certified");
  const Json drag = check("nurbs.json", 0, {"--drag", "45=1,0.5,0"});
  const double step = drag["largest_step"];
  EXPECT_GT(step, 0.05);
  EXPECT_LT(step, 5);
  for (const double part : {0.999, 1.001}) {
    Json dragged = read_json("nurbs.json");
    dragged["pose"] = dragged["rest"];
    for (std::size_t c = 0; c < 2; ++c) {
      const double by = (c == 0 ? 1 : 0.5) * part * step;
      dragged["pose"][45][c] = dragged["pose"][45][c].get<double>() + by;
    }
    write_json("dragged.json", dragged);
    const bool is_folded = part > 1;
    const Json found = check("dragged.json", is_folded ? 1 : 0);
    EXPECT_EQ(found["local"], is_folded ? "folded" : "certified");
    EXPECT_EQ(found["folds"].empty(), !is_folded);
  }
  const Json pulled =
      Json::parse(done({"pull", "nurbs.json", "--model", "cloud.obj", "--pick", "2=5,0.7,0.5",
                        "--stop-at-fold", "-o", "pulled.json", "--json"}));
  EXPECT_LT(pulled["step"], 1);
  EXPECT_NE(check("pulled.json", 0)["local"], "folded");
}

TEST_F(TensorCommands, convert_takes_volumes_of_more_points_than_control_points) {
  for (const Words& kind : {Words{"--counts", "4", "5", "1"}, Words{"--ends", "tripled"}}) {
    Words words = {"new", "nurbs", "-o", "nurbs.json"};
    words.insert(words.end(), kind.begin(), kind.end());
    done(words);
    pose_lattice("nurbs.json", "posed.json", bend);
    done({"convert", "posed.json", "--volume", "-o", "volume.vtu"});
    EXPECT_THAT(read_file("volume.vtu"), HasSubstr("RationalWeights"));
    EXPECT_EQ(Json::parse(done(
                  {"info", "posed.json", "--model", "cloud.obj", "--json"}))["model"]["inside"],
              5);
  }
}

TEST_F(TensorCommands, files_that_make_no_lattice_are_named_and_nothing_written) {
  make_all();
  const auto refused = [](const std::string& type, const auto& spoil, const std::string& reason) {
    Json json = read_json(type + ".json");
    spoil(json);
    write_json("bad.json", json);
    for (const Words& words : {Words{"deform", "cloud.obj", "--lattice", "bad.json", "-o", "x.obj"},
                               Words{"convert", "bad.json", "--volume", "-o", "x.vtu"}}) {
      EXPECT_THAT(refusal(words, 1), HasSubstr(reason)) << type;
    }
  };
  refused(
      "bspline", [](Json& json) { json["degree"][0] = 5; }, "need at least 6");
  refused(
      "bspline",
      [](Json& json) {
        json["knots"] = {{0, 0, 0, 1, 0.5, 2, 2, 2}, {}, {}};
      },
      "knot 4 is 0.5, less than knot 3, which is 1");
  refused(
      "nurbs", [](Json& json) { json["weights"][3] = 0; }, "weights[3] is 0, must be positive");
  refused(
      "nurbs", [](Json& json) { json["weights"][3] = -1.5; },
      "weights[3] is -1.5, must be positive");
  refused(
      "thb", [](Json& json) { json["levels"][0][0][1][0] = 0.4; },
      "the box's side at u = 0.4 is no line between cells");
  refused(
      "thb", [](Json& json) { json["levels"][0][0][1][0] = 1.5; },
      "the box's side at u = 1.5 is no line between cells");
  refused(
      "thb",
      [](Json& json) {
        json["levels"].push_back({{{0.5, 0.5, 0.5}, {1, 1, 1}}});
      },
      "lies outside the domain of level 1");
  for (const std::string type : {"bezier", "bspline", "nurbs"}) {
    refused(
        type,
        [](Json& json) {
          for (auto& point : json["rest"]) {
            point[1] = 0.25;
          }
        },
        "all lie in a plane");
  }
  refused(
      "thb",
      [](Json& json) {
        for (auto& point : json["points"]) {
          point[4] = 0;
        }
      },
      "all lie in a plane");
  EXPECT_THAT(files(), ::testing::Not(::testing::Contains("x.obj")));
  EXPECT_THAT(files(), ::testing::Not(::testing::Contains("x.vtu")));
}

}  // namespace
}  // namespace espalier::tools
