/// Bézier, B-spline, NURBS and hierarchical lattices from the command line.

#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/tools/tensor_fixture.h"

namespace espalier::tools {
namespace {

using ::testing::HasSubstr;

TEST_F(TensorCommands, at_rest_change_no_byte_of_a_model) {
  for (const std::string& type : make_all()) {
    done({"deform", "cloud.obj", "--lattice", type + ".json", "-o", "out.obj"});
    EXPECT_EQ(read_file("out.obj"), kCloud) << type;
  }
}

TEST_F(TensorCommands, an_affine_pose_moves_the_model_affinely) {
  const AffineMap map;
  const Model model = read_model("cloud.obj");
  for (const std::string& type : make_all()) {
    pose_lattice(type + ".json", "posed.json", map);
    const auto moved = deformed_points(type + ".json", {"--pose", "posed.json"});
    for (std::size_t i = 0; i < moved.size(); ++i) {
      EXPECT_LT(glm::distance(moved[i], map(model.points()[i])), 1e-12) << type;
    }
  }
}

TEST_F(TensorCommands, refining_changes_nothing_but_the_control_points) {
  for (const std::string& type : make_all()) {
    pose_lattice(type + ".json", "posed.json", bend);
    const auto before = deformed_points("posed.json");
    std::vector<Words> ways = {{"--levels", "1"}};
    if (type != "thb") {
      ways.push_back({"--elevate"});
    } else {
      ways.push_back({"--box", "0", "0", "0", "0.5", "0.5", "0.5", "--level", "2"});
    }
    for (const Words& way : ways) {
      Words words = {"refine", "posed.json", "-o", "finer.json"};
      words.insert(words.end(), way.begin(), way.end());
      done(words);
      EXPECT_GT(read_any_lattice("finer.json").rest_points().size(),
                read_any_lattice("posed.json").rest_points().size());
      EXPECT_LT(farthest(deformed_points("finer.json"), before), 1e-13) << type << way[0];
    }
  }
}

TEST_F(TensorCommands, a_binding_gives_the_same_bytes_and_is_refused_once_the_lattice_changed) {
  for (const std::string& type : make_all()) {
    const std::string rest = type + ".json";
    pose_lattice(rest, "posed.json", bend);
    done({"deform", "cloud.obj", "--lattice", rest, "--pose", "posed.json", "-o", "out.obj"});
    done({"bind", "cloud.obj", "--lattice", rest, "-o", "cloud.binding"});
    done({"deform", "cloud.obj", "--lattice", rest, "--pose", "posed.json", "--binding",
          "cloud.binding", "-o", "bound.obj"});
    EXPECT_EQ(read_file("bound.obj"), read_file("out.obj")) << type;
    done({"refine", rest, "-o", rest});
    EXPECT_THAT(refusal({"deform", "cloud.obj", "--lattice", rest, "--binding", "cloud.binding",
                         "-o", "bound.obj"},
                        1),
                HasSubstr("the lattice's cells or knots are not those the binding was made for"));
  }
}

TEST_F(TensorCommands, a_binding_notices_weights_and_the_rest_shape) {
  make_all();
  done({"bind", "cloud.obj", "--lattice", "nurbs.json", "-o", "cloud.binding"});
  const Words bound = {"deform",    "cloud.obj",     "--lattice", "other.json",
                       "--binding", "cloud.binding", "-o",        "bound.obj"};
  Json other = read_json("nurbs.json");
  other["weights"][7] = 3;
  write_json("other.json", other);
  EXPECT_THAT(refusal(bound, 1), HasSubstr("or its weights, since the binding was made"));
  other = read_json("nurbs.json");
  other["rest"][7][0] = 0.51;
  write_json("other.json", other);
  EXPECT_THAT(refusal(bound, 1), HasSubstr("the lattice's rest shape changed"));
}

TEST_F(TensorCommands, eval_tells_places_of_the_whole_lattice_and_their_derivatives) {
  const AffineMap map;
  write_file("at.csv", "u,v,w\n0.5,0.25,0.75\n0,1,0.5\n0.3,0.6,0.9\n");
  for (const std::string type : {"bezier", "bspline", "thb"}) {
    done({"new", type, "--min", "1", "2", "3", "--max", "3", "5", "7", "-o", "rest.json"});
    pose_lattice("rest.json", "posed.json", map);
    const auto rows = rows_of(done({"eval", "posed.json", "--uvw", "at.csv"}));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[1][3], "inside");
    EXPECT_EQ(rows[2][3], "border");
    const glm::dvec3 sizes(2, 3, 4);
    const std::vector<glm::dvec3> places = {{0.5, 0.25, 0.75}, {0, 1, 0.5}, {0.3, 0.6, 0.9}};
    const auto number = [&](std::size_t row, int column) {
      return std::strtod(rows[row][static_cast<std::size_t>(column)].c_str(), nullptr);
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
      const glm::dvec3 expected = map(glm::dvec3(1, 2, 3) + sizes * places[i]);
      for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(number(i + 1, a), expected[a], 1e-12) << type;
        for (int b = 0; b < 3; ++b) {
          EXPECT_NEAR(number(i + 1, 4 + 3 * a + b), map.A[b][a] * sizes[b], 1e-11) << type;
        }
      }
    }
  }
}

TEST_F(TensorCommands, eval_is_de_casteljau_with_the_weights_of_the_pose) {
  done({"new", "nurbs", "--counts", "3", "2", "2", "-o", "arc.json"});
  // A quarter of the unit circle along u, [0,1] along v (z), a radius from 1 to 2 along w.
  Json json = read_json("arc.json");
  json["pose"] = Json::array();
  json["pose_weights"] = Json::array();
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      const double r = 1 + k;
      for (const auto& [x, y] : {std::pair{1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
        json["pose"].push_back({r * x, r * y, j});
        json["pose_weights"].push_back(x * y == 1 ? std::sqrt(0.5) : 1.0);
      }
    }
  }
  write_json("arc.json", json);
  write_file("at.csv", "u,v,w\n0,0,0\n0.2,0.5,0.5\n0.5,1,0\n0.85,0.25,1\n");
  const std::vector<double> radii = {1, 1.5, 1, 2};
  const std::vector<double> heights = {0, 0.5, 1, 0.25};
  const auto rows = rows_of(done({"eval", "arc.json", "--uvw", "at.csv"}));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_NEAR(std::hypot(std::strtod(rows[i + 1][0].c_str(), nullptr),
                           std::strtod(rows[i + 1][1].c_str(), nullptr)),
                radii[i], 1e-14);
    EXPECT_NEAR(std::strtod(rows[i + 1][2].c_str(), nullptr), heights[i], 1e-15);
  }
  // At rest the lattice is the unit cube: rest points are their own places.
  write_file("at.csv", "x,y,z\n0,0,0\n0.2,0.5,0.5\n0.5,1,0\n0.85,0.25,1\n");
  const auto moved = rows_of(done({"eval", "arc.json", "--at", "at.csv"}));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    for (std::size_t column = 0; column < 3; ++column) {
      EXPECT_NEAR(std::strtod(moved[i + 1][column].c_str(), nullptr),
                  std::strtod(rows[i + 1][column].c_str(), nullptr), 1e-14);
    }
  }
  const Model cloud = read_model("cloud.obj");
  const std::vector<glm::dvec3> points = deformed_points("arc.json");
  std::size_t n_inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 rest = cloud.points()[i];
    if (rest == glm::clamp(rest, 0.0, 1.0)) {
      EXPECT_NEAR(std::hypot(points[i].x, points[i].y), 1 + rest.z, 1e-6);
      EXPECT_NEAR(points[i].z, rest.y, 1e-6);
      ++n_inside;
    }
  }
  EXPECT_GT(n_inside, 0u);
  EXPECT_THAT(
      refusal({"pull", "arc.json", "--model", "cloud.obj", "--pick", "0=1,1,1", "-o", "out.json"},
              1),
      HasSubstr("pose_weights are not its weights at rest"));
}

TEST_F(TensorCommands, new_fits_a_model_or_a_group_of_it) {
  write_file("bar.obj",
             "v 0 0 0\nv 4 3 0\nv 4.3 2.6 0.2\nv 0.3 -0.4 0.2\nv 9 9 9\n"
             "g bar\nf 1 2 3 4\ng rest\nf 1 2 5\n");
  done({"new", "bspline", "--fit", "bar.obj", "--padding", "0", "--only", "bar", "-o", "fit.json"});
  const Json info = Json::parse(done({"info", "fit.json", "--json"}));
  EXPECT_LT(glm::distance(point_of(info["min"]), glm::dvec3(0, -0.4, 0)), 1e-15);
  EXPECT_LT(glm::distance(point_of(info["max"]), glm::dvec3(4.3, 3, 0.2)), 1e-15);
  done({"new", "thb", "--fit", "bar.obj", "--only", "bar", "--axes", "principal", "--padding", "0",
        "-o", "fit.json"});
  const Lattice principal = read_any_lattice("fit.json");
  const auto points = principal.rest_points();
  const glm::dvec3 along = glm::normalize(points[5] - points[0]);
  EXPECT_LT(glm::distance(along, glm::dvec3(0.8, 0.6, 0)), 1e-12);
  EXPECT_NEAR(glm::distance(points[5], points[0]), 5, 1e-12);
}

TEST_F(TensorCommands, info_tells_each_type) {
  make_all();
  const Json bspline = Json::parse(done({"info", "bspline.json", "--json"}));
  EXPECT_EQ(bspline["type"], "bspline");
  EXPECT_EQ(bspline["counts"], Json::parse("[5, 6, 4]"));
  EXPECT_EQ(bspline["degree"], Json::parse("[2, 3, 1]"));
  EXPECT_EQ(bspline["ends"], Json::parse(R"(["open", "uniform", "natural"])"));
  EXPECT_EQ(bspline["valid"], true);
  EXPECT_EQ(bspline["control_points"], 120);
  const Json nurbs = Json::parse(done({"info", "nurbs.json", "--json"}));
  EXPECT_EQ(nurbs["weights"], Json::parse(R"({"min": 1.0, "max": 1.5})"));
  const Json thb = Json::parse(done({"info", "thb.json", "--json"}));
  EXPECT_EQ(thb["type"], "thb");
  EXPECT_EQ(thb["counts"], Json::parse("[5, 5, 5]"));
  ASSERT_EQ(thb["levels"].size(), 2u);
  EXPECT_EQ(thb["levels"][0].get<int>() + thb["levels"][1].get<int>(), thb["control_points"]);
  EXPECT_EQ(thb["leaves"], 15 + 12 * 8);
  EXPECT_THAT(done({"info", "thb.json"}), HasSubstr("control points on 2 levels"));
  EXPECT_THAT(done({"info", "bezier.json"}),
              HasSubstr("bezier lattice\n  3 x 4 x 2 control points\n  degree 2 3 1"));
}

TEST_F(TensorCommands, weights_check_pull_and_convert_take_every_type) {
  for (const std::string& type : make_all()) {
    const std::string rest = type + ".json";
    const Json weights =
        Json::parse(done({"weights", "cloud.obj", "--lattice", rest, "-o", "W.mtx", "--json"}));
    EXPECT_EQ(weights["columns"], read_any_lattice(rest).rest_points().size());
    EXPECT_EQ(weights["inside"], 5);
    EXPECT_EQ(weights.contains("levels"), type == "thb");
    EXPECT_THAT(done({"check", rest}), HasSubstr("injective: certified"));
    done({"pull", rest, "--model", "cloud.obj", "--pick", "2=0.3,0.7,0.55", "-o", "pulled.json"});
    EXPECT_LT(glm::distance(deformed_points("pulled.json")[2], glm::dvec3(0.3, 0.7, 0.55)), 1e-12)
        << type;
    EXPECT_EQ(run({"convert", rest, "--volume", "-o", "volume.vtu"}).status, 0);
    EXPECT_EQ(run({"convert", rest, "-o", "net.vtu"}).status, 0);
    EXPECT_THAT(read_file("volume.vtu"), HasSubstr("HigherOrderDegrees"));
  }
}

TEST_F(TensorCommands, deform_tells_how_many_faces_tear_at_the_boundary) {
  write_file("far.obj", "v 0.5 0.5 0.5\nv 0.5 0.6 0.5\nv 3 0.5 0.5\nf 1 2 3\n");
  for (const std::string& type : make_all()) {
    pose_lattice(type + ".json", "posed.json",
                 [](const glm::dvec3& x) { return x + glm::dvec3(0, 0, 0.5); });
    const Json report = Json::parse(
        done({"deform", "far.obj", "--lattice", "posed.json", "-o", "out.obj", "--json"}));
    EXPECT_EQ(report["outside"], 1) << type;
    EXPECT_EQ(report["torn_faces"], 1) << type;
  }
}

TEST_F(TensorCommands, what_only_subdivision_lattices_can_do_is_refused_with_the_reason) {
  for (const std::string& type : make_all()) {
    const std::string rest = type + ".json";
    const std::string is = rest + " is a " + type + " lattice; ";
    const std::string needs = " needs a subdivision lattice";
    EXPECT_EQ(refusal({"extrude", rest, "--faces", "0", "--normal", "1", "-o", "x.json"}, 2),
              is + "modelling its cells" + needs);
    EXPECT_THAT(refusal({"refine", rest, "--scheme", "mj96", "-o", "x.json"}, 2),
                HasSubstr("--scheme is for subdivision lattices"));
    EXPECT_THAT(refusal({"convert", rest, "-o", "x.ovm"}, 1), HasSubstr("only .json can"));
  }
}

TEST_F(TensorCommands, nonsense_is_refused_and_nothing_written) {
  make_all();
  const auto refused = [](const Words& options, const std::string& reason) {
    Words words = {"new"};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), {"-o", "x.json"});
    EXPECT_THAT(refusal(words, 2), HasSubstr(reason));
  };
  refused({"bezier", "--counts", "0", "4", "4"}, "--counts must be three numbers from 1 to 65536");
  refused({"bspline", "--counts", "3", "4", "4", "--degree", "3", "3", "3"}, "--counts");
  refused({"bspline", "--ends", "loose"}, "--ends is 'loose', must be open, uniform");
  refused({"bspline", "--ends", "open,open"}, "three of these with commas between");
  refused({"bspline", "--degree", "2", "2", "2", "--ends", "natural"}, "natural");
  refused({"nurbs", "--min", "0", "0", "0", "--max", "1", "0", "1"}, "--min must be below --max");
  refused({"thb", "--degree", "6", "6", "6", "--counts", "9", "9", "9"}, "degree");
  refused({"thb", "--padding", "0.1"}, "--padding is for --fit");
  refused({"thb", "--fit", "cloud.obj", "--min", "0", "0", "0"}, "exclude each other");
  refused({"thb", "--fit", "cloud.obj", "--padding", "-1"}, "padding");
  EXPECT_THAT(
      refusal({"refine", "thb.json", "--box", "0", "0", "0", "0.4", "1", "1", "-o", "x.json"}, 2),
      HasSubstr("0.4"));
  EXPECT_EQ(run({"refine", "thb.json", "--box", "0", "0", "0", "1", "1", "1", "--level", "4", "-o",
                 "x.json"})
                .status,
            2);
  EXPECT_EQ(run({"refine", "thb.json", "--box", "0.5", "0.5", "0.5", "1", "1", "1", "--level", "2",
                 "-o", "x.json"})
                .status,
            1);
  EXPECT_THAT(refusal({"refine", "thb.json", "--elevate", "-o", "x.json"}, 2),
              HasSubstr("--elevate is for bezier"));
  EXPECT_THAT(refusal({"refine", "nurbs.json", "--level", "1", "-o", "x.json"}, 2),
              HasSubstr("--level is for thb lattices"));
  EXPECT_THAT(refusal({"refine", "cloud.obj", "--elevate", "-o", "x.obj"}, 2),
              HasSubstr("--elevate is for lattices"));
  write_file("at.csv", "u,v,w\n0.5,1.5,0\n");
  EXPECT_THAT(refusal({"eval", "thb.json", "--uvw", "at.csv"}, 1),
              HasSubstr("place 0 has v = 1.5, must be from 0 to 1"));
  done({"new", "box", "-o", "box.json"});
  EXPECT_THAT(refusal({"eval", "box.json", "--uvw", "at.csv"}, 2), HasSubstr("give --at"));
  EXPECT_THAT(refusal({"eval", "box.json"}, 2), HasSubstr("--at or --uvw must be given"));
  EXPECT_THAT(files(), ::testing::Not(::testing::Contains("x.json")));
}

TEST_F(TensorCommands, refine_refuses_what_would_be_huge_before_it_grows) {
  make_all();
  done({"new", "bspline", "--counts", "30", "30", "30", "-o", "fine.json"});
  done({"new", "thb", "--counts", "30", "30", "30", "-o", "fine thb.json"});
  EXPECT_EQ(refusal({"refine", "fine.json", "--levels", "3", "-o", "x.json"}, 2),
            "--levels would make 10503459 control points, at most 4194304 are made: refine fewer "
            "times, or where it matters");
  EXPECT_EQ(refusal({"refine", "fine thb.json", "--levels", "3", "-o", "x.json"}, 2),
            "--levels would make 10077696 cells, at most 1048576 are made: refine fewer times, or "
            "where it matters");
  EXPECT_THAT(done({"info", "fine thb.json"}), HasSubstr("27000 control points on 1 level:"));
}

TEST_F(TensorCommands, a_pose_must_be_of_such_a_lattice) {
  make_all();
  done({"new", "box", "-o", "box.json"});
  const auto refused = [](const std::string& lattice, const std::string& pose) {
    return refusal({"deform", "cloud.obj", "--lattice", lattice, "--pose", pose, "-o", "out.obj"},
                   1);
  };
  EXPECT_EQ(refused("nurbs.json", "thb.json"),
            "thb.json: is a thb lattice, the lattice nurbs.json is of type nurbs");
  EXPECT_EQ(refused("bspline.json", "box.json"),
            "box.json: is a subdivision lattice, the lattice bspline.json is of type bspline");
  EXPECT_EQ(refused("box.json", "bezier.json"),
            "bezier.json: is a bezier lattice, the lattice box.json is of type subdivision");
  EXPECT_EQ(refused("bspline.json", "bezier.json"),
            "bezier.json: is a bezier lattice, the lattice bspline.json is of type bspline");
  done({"new", "nurbs", "--counts", "4", "5", "5", "-o", "other.json"});
  EXPECT_EQ(refused("nurbs.json", "other.json"),
            "other.json: has control points 4 5 5, the lattice nurbs.json has 4 5 4");
  done({"new", "nurbs", "--counts", "4", "5", "4", "-o", "other.json"});
  EXPECT_GT(farthest(deformed_points("nurbs.json", {"--pose", "other.json"}),
                     deformed_points("nurbs.json")),
            0.001);  // other weights are a pose too
  done(
      {"new", "bspline", "--counts", "5", "6", "4", "--degree", "2", "3", "1", "-o", "other.json"});
  EXPECT_EQ(refused("bspline.json", "other.json"),
            "other.json: its ends or knots along v are not those of the lattice bspline.json");
  EXPECT_EQ(refused("thb.json", "base.json"),
            "base.json: its levels are not refined where those of the lattice thb.json are");
}

}  // namespace
}  // namespace espalier::tools
