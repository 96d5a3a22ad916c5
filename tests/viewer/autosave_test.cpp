#include "viewer/app/autosave.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "tests/support/temporary_folder.h"

namespace espalier::viewer {
namespace {

class AutosaveTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path() const { return folder_.path("journal"); }
  [[nodiscard]] bool has_file() const { return std::filesystem::exists(path()); }
  void add_box() { journal_.apply(parse_call("new box cells=1,1,1 output=box.json")); }

  test::TemporaryFolder folder_;
  Journal journal_;
};

TEST_F(AutosaveTest, writes_a_journal_that_changed_and_not_again_before_the_interval_is_over) {
  Autosave autosave(path(), 5);
  autosave.keep(journal_, 0);
  EXPECT_FALSE(has_file());
  add_box();
  autosave.keep(journal_, 1);
  const std::string first = read_file(path());
  EXPECT_TRUE(first.ends_with("\n" + journal_.text()));
  journal_.undo();
  autosave.keep(journal_, 5.9);
  EXPECT_EQ(read_file(path()), first);
  autosave.keep(journal_, 6);
  EXPECT_EQ(read_file(path()).find("new box"), std::string::npos);
}

TEST_F(AutosaveTest, what_a_crash_left_is_found_with_its_folder_and_stays_until_it_is_removed) {
  {
    Autosave crashed(path());
    add_box();
    crashed.keep(journal_, 0);
  }
  for (int start = 0; start < 2; ++start) {
    Autosave next(path());
    EXPECT_EQ(next.path(), path() + ".2");
    const std::vector<LeftJournal> left = next.take_leftovers();
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].folder, std::filesystem::current_path().string());
    EXPECT_NE(left[0].title().find(" 1 step "), std::string::npos) << left[0].title();
    Journal replayed;
    replay(left[0].text, replayed);
    EXPECT_EQ(replayed.text(), journal_.text());
    if (start == 1) {
      left[0].remove();
    }
  }
  Autosave last(path());
  EXPECT_TRUE(last.take_leftovers().empty());
  EXPECT_EQ(last.path(), path());
}

TEST_F(AutosaveTest, programs_at_the_same_time_have_a_file_each_and_are_not_taken_for_crashed) {
  Autosave first(path());
  add_box();
  first.keep(journal_, 0);
  Autosave second(path());
  EXPECT_NE(second.path(), first.path());
  EXPECT_TRUE(second.take_leftovers().empty());
  add_box();
  second.keep(journal_, 0);
  EXPECT_NE(read_file(first.path()), read_file(second.path()));
  second.end();
  EXPECT_TRUE(std::filesystem::exists(first.path()));
  EXPECT_FALSE(std::filesystem::exists(second.path()));
}

TEST_F(AutosaveTest, all_that_crashed_is_found_by_one_program_only) {
  {
    Autosave first(path());
    Autosave second(path());
    add_box();
    first.keep(journal_, 0);
    second.keep(journal_, 0);
  }
  Autosave next(path());
  std::vector<LeftJournal> left = next.take_leftovers();
  EXPECT_EQ(left.size(), 2u);
  EXPECT_TRUE(Autosave(path()).take_leftovers().empty());
  left.pop_back();
  EXPECT_EQ(Autosave(path()).take_leftovers().size(), 1u);
}

TEST_F(AutosaveTest, what_a_process_leaves_that_dies_is_found) {
  const int child = ::fork();
  if (child == 0) {
    Autosave autosave(path());
    add_box();
    autosave.keep(journal_, 0);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(Autosave(path()).take_leftovers().size(), 1u);
}

TEST_F(AutosaveTest, nothing_is_left_of_a_session_that_ends_well) {
  {
    Autosave autosave(path());
    add_box();
    autosave.keep(journal_, 0);
    autosave.end();
  }
  EXPECT_FALSE(has_file());
  EXPECT_TRUE(Autosave(path()).take_leftovers().empty());
}

TEST_F(AutosaveTest, without_a_path_nothing_is_kept) {
  Autosave autosave("");
  add_box();
  autosave.keep(journal_, 0);
  autosave.end();
  EXPECT_TRUE(autosave.path().empty());
  EXPECT_TRUE(autosave.take_leftovers().empty());
}

TEST_F(AutosaveTest, a_file_that_cannot_be_written_is_told) {
  Autosave autosave(folder_.path("none/journal"));
  add_box();
  EXPECT_THROW(autosave.keep(journal_, 0), FileError);
  EXPECT_NO_THROW(autosave.keep(journal_, 10));  // told once
}

}  // namespace
}  // namespace espalier::viewer
