/// The program itself: what only a process of its own can show.

#include <sys/wait.h>

#include <cstdlib>

#include "lattice/core/file.h"
#include "tests/tools/command_line_fixture.h"

namespace espalier::tools {
namespace {

class Program : public CommandLineTest {
 protected:
  /// Exit status of a shell command in which $E is the program; its standard error is in `err`.
  static int shell(const std::string& command) {
    const std::string line = "E='" ESPALIER_PROGRAM "'; { " + command + "; } 2> err";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

TEST_F(Program, ends_with_0_when_done) {
  EXPECT_EQ(shell("\"$E\" new box -o box.json > out"), 0);
  EXPECT_EQ(read_file("out"), "box.json: 27 vertices, 54 edges, 36 faces, 8 cells\n");
  EXPECT_EQ(read_file("err"), "");
}

TEST_F(Program, ends_with_1_and_one_line_when_it_failed) {
  EXPECT_EQ(shell("\"$E\" info no.json > out"), 1);
  EXPECT_EQ(read_file("out"), "");
  EXPECT_EQ(read_file("err"), "espalier: no.json: cannot open: No such file or directory\n");
}

TEST_F(Program, ends_with_2_and_a_hint_when_used_wrongly) {
  EXPECT_EQ(shell("\"$E\" new box"), 2);
  EXPECT_EQ(read_file("err"), "espalier: --output is required\nTry 'espalier new box --help'.\n");
}

TEST_F(Program, reads_points_from_standard_input) {
  EXPECT_EQ(shell("\"$E\" new box -o box.json --quiet"), 0);
  EXPECT_EQ(shell("printf 'x,y,z\\n2,3,4\\n' | \"$E\" eval box.json --at - > out"), 0);
  EXPECT_EQ(rows_of(read_file("out")).at(1).at(2), "4");
}

TEST_F(Program, keeps_the_old_file_and_leaves_no_other_when_there_is_no_space) {
  EXPECT_EQ(shell("\"$E\" new box -o box.json --quiet"), 0);
  const std::string before = read_file("box.json");
  EXPECT_EQ(shell("trap '' XFSZ; ulimit -f 4; \"$E\" refine box.json --levels 2 -o box.json"), 1);
  EXPECT_EQ(read_file("err"), "espalier: box.json: cannot write: File too large\n");
  EXPECT_EQ(read_file("box.json"), before);
  EXPECT_EQ(files(), (std::vector<std::string>{"box.json", "err"}));
}

TEST_F(Program, says_so_when_standard_output_is_full) {
  EXPECT_EQ(shell("\"$E\" new box -o box.json --quiet"), 0);
  EXPECT_EQ(shell("\"$E\" info box.json > /dev/full"), 1);
  EXPECT_EQ(read_file("err"), "espalier: cannot write to standard output\n");
}

}  // namespace
}  // namespace espalier::tools
