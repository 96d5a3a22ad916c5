#include "viewer/interact/file_browser.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lattice/core/file.h"

namespace espalier::viewer {
namespace {

TEST(FileBrowser, lists_folders_then_what_can_be_opened_by_name) {
  std::string folder = (std::filesystem::temp_directory_path() / "espalier.XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
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
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace espalier::viewer
