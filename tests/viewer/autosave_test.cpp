#include "viewer/app/autosave.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lattice/core/error.h"
#include "lattice/core/file.h"

namespace espalier::viewer {
namespace {

class AutosaveTest : public ::testing::Test {
 protected:
  AutosaveTest() {
    std::string name = (std::filesystem::temp_directory_path() / "espalier.XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~AutosaveTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path() const { return folder_ + "/journal"; }
  [[nodiscard]] bool has_file() const { return std::filesystem::exists(path()); }
  void add_box() { journal_.apply(parse_call("new box cells=1,1,1 output=box.json")); }

  std::string folder_;
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

TEST_F(AutosaveTest, what_a_crash_left_is_moved_aside_and_recovered_with_its_folder) {
  Autosave crashed(path());
  add_box();
  crashed.keep(journal_, 0);
  const Autosave next(path());
  EXPECT_TRUE(next.moves_leftover());
  EXPECT_FALSE(has_file());
  EXPECT_FALSE(next.moves_leftover());
  const LeftJournal left = next.recovered();
  EXPECT_EQ(left.folder, std::filesystem::current_path().string());
  Journal replayed;
  replay(left.text, replayed);
  EXPECT_EQ(replayed.text(), journal_.text());
}

TEST_F(AutosaveTest, nothing_is_left_of_a_session_that_ends_well) {
  Autosave autosave(path());
  add_box();
  autosave.keep(journal_, 0);
  autosave.end();
  EXPECT_FALSE(has_file());
  EXPECT_FALSE(autosave.moves_leftover());
  EXPECT_THROW((void)autosave.recovered(), FileError);
}

TEST_F(AutosaveTest, without_a_path_nothing_is_kept) {
  Autosave autosave("");
  add_box();
  autosave.keep(journal_, 0);
  autosave.end();
  EXPECT_FALSE(autosave.moves_leftover());
  EXPECT_THROW((void)autosave.recovered(), FileError);
}

TEST_F(AutosaveTest, a_file_that_cannot_be_written_is_told) {
  Autosave autosave(folder_ + "/none/journal");
  add_box();
  EXPECT_THROW(autosave.keep(journal_, 0), FileError);
  EXPECT_NO_THROW(autosave.keep(journal_, 10));  // told once
}

}  // namespace
}  // namespace espalier::viewer
