#include "viewer/interact/file_browser.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lattice/core/file.h"
#include "tests/support/temporary_folder.h"

namespace espalier::viewer {
namespace {

TEST(FileBrowser, lists_folders_then_what_can_be_opened_by_name) {
  const test::TemporaryFolder temporary;
  const std::string& folder = temporary.path();
  std::filesystem::create_directory(folder + "/zoo");
  for (const char* name : {"b.obj", "A.JSON", "notes.txt", ".hidden.obj", "c.Ply"}) {
    write_file(folder + "/" + name, "");
  }
  EXPECT_EQ(entries_of(folder),
            (std::vector<FileEntry>{
                {"zoo", true}, {"A.JSON", false}, {"b.obj", false}, {"c.Ply", false}}));
  EXPECT_EQ(entries_of(folder, "B"), (std::vector<FileEntry>{{"zoo", true}, {"b.obj", false}}));
  EXPECT_TRUE(entries_of(folder + "/nowhere").empty());
  EXPECT_EQ(folder_above(folder + "/zoo"), folder);
  EXPECT_EQ(folder_above(folder + "/zoo/"), folder);
  EXPECT_EQ(folder_above("/"), "/");
}

}  // namespace
}  // namespace espalier::viewer
