#include "tools/command_line.h"

#include "lattice/core/file.h"
#include "lattice/core/parallel.h"
#include "tests/tools/command_line_fixture.h"
#include "tools/command.h"

namespace espalier::tools {
namespace {

class CommandLine : public CommandLineTest {};

TEST_F(CommandLine, names_the_commands_when_it_knows_none_of_that_name) {
  EXPECT_EQ(refusal({"bogus"}, 2),
            "there is no command 'bogus', only: new, convert, refine, extrude, attach, split, "
            "delete, merge, weld, mirror, transform, relax, crease, pose, bind, deform, densify, "
            "info, check, "
            "eval, pull, weights, render");
  EXPECT_EQ(
      refusal({"new", "teapot", "-o", "a.json"}, 2),
      "there is no command 'teapot', only: box, cylinder, ogrid, annulus, torus, sphere, star, "
      "barbell, junction, limb, bezier, bspline, nurbs, thb");
  EXPECT_EQ(refusal({}, 2),
            "a command is missing, one of: new, convert, refine, extrude, attach, split, "
            "delete, merge, weld, mirror, transform, relax, crease, pose, bind, deform, densify, "
            "info, check, "
            "eval, pull, weights, render");
  EXPECT_EQ(
      refusal({"new"}, 2),
      "a command is missing, one of: box, cylinder, ogrid, annulus, torus, sphere, star, barbell, "
      "junction, limb, bezier, bspline, nurbs, thb");
}

TEST_F(CommandLine, names_the_option_or_word_that_it_does_not_expect) {
  EXPECT_EQ(refusal({"--bogus"}, 2), "there is no option '--bogus'");
  EXPECT_EQ(refusal({"new", "box", "--bogus", "3", "-o", "a.json"}, 2),
            "there is no option '--bogus'");
  EXPECT_EQ(refusal({"new", "box", "-x"}, 2), "there is no option '-x'");
  EXPECT_EQ(refusal({"new", "box", "a.json", "-o", "a.json"}, 2), "'a.json' is not expected");
  EXPECT_EQ(refusal({"--quiet", "new", "box", "-o", "a.json"}, 2),
            "'--quiet' must come after the command");
  EXPECT_EQ(refusal({"eval", "a.json", "--at", "p.csv", "--json"}, 2),
            "there is no option '--json'");
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, names_what_is_missing) {
  EXPECT_EQ(refusal({"new", "box"}, 2), "--output is required");
  EXPECT_EQ(refusal({"info"}, 2), "file is required");
  EXPECT_EQ(refusal({"render", "-o", "p.png"}, 2), "scene is required");
  EXPECT_EQ(refusal({"deform", "m.obj", "-o", "out.obj"}, 2), "--lattice is required");
  EXPECT_EQ(refusal({"eval", "a.json"}, 2), "--at or --uvw must be given, and not both");
  EXPECT_EQ(refusal({"new", "box", "-o"}, 2), "--output needs a value");
  EXPECT_EQ(refusal({"new", "box", "-o", ""}, 2), "--output must be a text that is not empty");
  EXPECT_EQ(refusal({"info", ""}, 2), "'file' must be a text that is not empty");
}

TEST_F(CommandLine, an_option_is_never_taken_for_the_value_of_another) {
  EXPECT_EQ(refusal({"new", "box", "-o", "--json"}, 2), "--output: needs a value before '--json'");
  EXPECT_EQ(refusal({"deform", "m.obj", "--lattice", "a.json", "--pose", "-o", "out.obj"}, 2),
            "--pose: needs a value before '-o'");
  EXPECT_EQ(refusal({"new", "box", "--min", "-o", "a.json"}, 2), "--min: '-o' is no number");
  EXPECT_EQ(refusal({"new", "box", "--min", "1", "2", "-o", "a.json"}, 2),
            "--min must be 3 finite numbers");
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, an_option_takes_its_values_and_no_more) {
  EXPECT_EQ(refusal({"new", "box", "--cells", "1", "1", "1", "1", "-o", "a.json"}, 2),
            "'1' is not expected");
  EXPECT_EQ(refusal({"new", "box", "-o", "a.json", "b.json"}, 2), "'b.json' is not expected");
  EXPECT_EQ(refusal({"new", "box", "-o", "a.json", "-o", "b.json"}, 2),
            "--output is given too often");
  EXPECT_EQ(refusal({"new", "box", "--min", "0", "0", "0", "--min", "0", "0", "0"}, 2),
            "--min is given too often");
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, values_may_be_joined_to_their_option) {
  done({"new", "box", "--cells=1", "2", "3", "-oa.json"});
  done({"new", "box", "--output=b.json"});
  EXPECT_EQ(read_json("a.json")["cells"].size(), 6u);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.json", "b.json"}));
}

TEST_F(CommandLine, numbers_that_are_none_are_named) {
  const auto refused = [](const std::string& option, const std::string& value) {
    return refusal({"new", "cylinder", option, value, "-o", "a.json"}, 2);
  };
  EXPECT_EQ(refused("--layers", "four"), "--layers: 'four' is no whole number");
  EXPECT_EQ(refused("--layers", "1.5"), "--layers: '1.5' is no whole number");
  EXPECT_EQ(refused("--layers", "0x4"), "--layers: '0x4' is no whole number");
  EXPECT_EQ(refused("--layers", "99999999999999999999"),
            "--layers: '99999999999999999999' is no whole number");
  EXPECT_EQ(refused("--layers", "-9223372036854775808"), "--layers must be a whole number");
  EXPECT_EQ(refused("--radius", "1,5"), "--radius: '1,5' is no number");
  EXPECT_EQ(refused("--radius", "nan"), "--radius must be a finite number");
  EXPECT_EQ(refused("--radius", "inf"), "--radius must be a finite number");
  EXPECT_EQ(refused("--threads", "x"), "--threads: 'x' is no whole number");
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, numbers_out_of_range_are_named) {
  const auto refused = [](std::vector<std::string> words) {
    words.insert(words.begin(), "new");
    words.insert(words.end(), {"-o", "a.json"});
    return refusal(words, 2);
  };
  EXPECT_EQ(refused({"box", "--cells", "0", "1", "1"}),
            "--cells must be three numbers from 1 to 100000");
  EXPECT_EQ(refused({"box", "--cells", "1", "-1", "1"}),
            "--cells must be three numbers from 1 to 100000");
  EXPECT_EQ(refused({"box", "--cells", "100000", "100000", "100000"}),
            "box: more than 20 million cells");
  EXPECT_EQ(refused({"box", "--min", "1", "0", "0"}),
            "box: min must be below max along x, and both finite");
  EXPECT_EQ(refused({"box", "--min", "-1e300", "0", "0"}),
            "box: min must be below max along x, and both finite");
  EXPECT_EQ(refused({"box", "--scheme", "loop"}), "--scheme must be one of: catmull-clark, mj96");
  EXPECT_EQ(refused({"box", "--threads", "0"}), "--threads must be 1 to 1024");
  EXPECT_EQ(refused({"cylinder", "--layers", "0"}), "cylinder: layers is 0, must be 1 to 10000");
  EXPECT_EQ(refused({"cylinder", "--sectors", "-3"}), "cylinder: sectors is -3, must be 3 to 1000");
  EXPECT_EQ(refused({"cylinder", "--radius", "-1"}), "cylinder: the radius must be positive");
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, freezing_options_that_are_none_are_refused) {
  done({"new", "box", "-o", "a.json"});
  write_file("m.obj", "v 0 0 0\n");
  for (const std::string word : {"uniform", "uniform:", "uniform:0", "uniform:9", "uniform:-1",
                                 "uniform:2.5", "uniform:2x", "adaptive:x", "3"}) {
    EXPECT_EQ(
        refusal({"deform", "m.obj", "--lattice", "a.json", "--freeze", word, "-o", "o.obj"}, 2),
        "--freeze is '" + word +
            "', must be adaptive, adaptive:TOLERANCE from 1e-12 to 0.1, "
            "adaptive:TOLERANCE:TOLERANCE_OF_DERIVATIVES, or uniform:N with N from 1 to 8");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"a.json", "m.obj"}));
}

TEST_F(CommandLine, quiet_prints_nothing) {
  write_file("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(done({"new", "box", "-o", "a.json", "--quiet"}), "");
  EXPECT_EQ(done({"new", "box", "-o", "a.json", "--quiet", "--json"}), "");
  EXPECT_EQ(done({"convert", "--quiet", "quad.obj", "--extrude", "0", "0", "1", "-o", "b.json"}),
            "");
  EXPECT_EQ(done({"refine", "a.json", "-o", "b.json", "--quiet"}), "");
  EXPECT_EQ(done({"deform", "quad.obj", "--lattice", "a.json", "-o", "b.obj", "--quiet"}), "");
}

TEST_F(CommandLine, a_lattice_report_as_json_is_that_of_info_and_the_output) {
  Json report = Json::parse(done({"new", "box", "-o", "a.json", "--json"}));
  EXPECT_EQ(report["output"], "a.json");
  report.erase("output");
  EXPECT_EQ(report, Json::parse(done({"info", "a.json", "--json"})));
}

TEST_F(CommandLine, the_thread_count_lasts_one_command) {
  set_thread_count(0);
  const int all = thread_count();
  done({"new", "box", "-o", "a.json", "--threads", "3"});
  EXPECT_EQ(thread_count(), 3);
  done({"new", "box", "-o", "a.json"});
  EXPECT_EQ(thread_count(), all);
}

TEST_F(CommandLine, tells_its_version_and_helps_with_every_command) {
  EXPECT_EQ(done({"--version"}), "espalier 0.1.0\n");
  const std::string help = done({"--help"});
  for (const Command& command : commands()) {
    std::vector<std::string> words = {command.name, "--help"};
    if (const std::size_t space = command.name.find(' '); space != std::string::npos) {
      words = {command.name.substr(0, space), command.name.substr(space + 1), "--help"};
    }
    EXPECT_NE(help.find("\n  " + words.front() + " "), std::string::npos) << command.name;
    const std::string page = done(words);
    EXPECT_EQ(page.substr(0, page.find('\n')), command.summary);
    for (const Parameter& parameter : command.parameters) {
      EXPECT_NE(page.find(parameter.help), std::string::npos) << parameter.name;
    }
  }
  EXPECT_NE(done({"refine", "--help"}).find("--box X Y Z X Y Z "), std::string::npos);
  EXPECT_NE(done({"transform", "--help"}).find("--move X Y Z "), std::string::npos);
}

TEST_F(CommandLine, a_report_replaces_what_is_no_unicode_in_a_name) {
  const Json report = Json::parse(done({"new", "box", "-o", "b\xFF.json", "--json"}));
  EXPECT_EQ(report["output"], "b\xEF\xBF\xBD.json");
  EXPECT_EQ(files(), std::vector<std::string>{"b\xFF.json"});
}

TEST_F(CommandLine, files_may_have_any_name_that_is_no_option) {
  for (const std::string name : {"[a] b.obj", "a b.obj", "ä.OBJ", "{}.obj", "a,b.obj", "info.obj",
                                 "%%.obj", "-1.obj", "./-o.obj"}) {
    write_file(name, "v 1 2 3\n");
    EXPECT_EQ(done({"info", name}),
              "model with 1 points, 0 faces, 0 normals\n  box 1 2 3  to  1 2 3\n")
        << name;
  }
}

TEST_F(CommandLine, refuses_a_dash_as_output_instead_of_making_a_file_of_that_name) {
  write_file("cube.obj", cube_obj());
  const std::string complaint =
      "--output is '-', must be the name of a file; /dev/stdout is standard output for models";
  EXPECT_EQ(refusal({"new", "box", "-o", "-"}, 2), complaint);
  EXPECT_EQ(refusal({"refine", "cube.obj", "-o", "-"}, 2), complaint);
  EXPECT_EQ(files(), std::vector<std::string>{"cube.obj"});
}

}  // namespace
}  // namespace espalier::tools
