#include "lattice/core/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "lattice/core/error.h"
#include "tests/support/temporary_folder.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for every test.
class File : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }
  [[nodiscard]] std::size_t n_files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

 private:
  test::TemporaryFolder folder_;
};

/// Lets files grow to `bytes` only, for one scope.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

TEST_F(File, gives_back_the_bytes_written) {
  std::string bytes = "line\r\n";
  bytes += '\0';
  bytes.append(200000, 'x');
  for (const std::string& content : {bytes, std::string()}) {
    write_file(path("a"), content);
    EXPECT_EQ(read_file(path("a")), content);
  }
  EXPECT_EQ(n_files(), 1u);
}

TEST_F(File, stays_as_it_was_when_writing_fails) {
  write_file(path("a"), "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_THROW(write_file(path("a"), std::string(5000, 'x')), FileError);
    EXPECT_THROW(write_file(path("b"), std::string(5000, 'x')), FileError);
  }
  EXPECT_EQ(read_file(path("a")), "old");
  EXPECT_EQ(n_files(), 1u);
}

TEST_F(File, keeps_its_permissions_when_replaced) {
  write_file(path("a"), "old");
  fs::permissions(path("a"), fs::perms(0640));
  write_file(path("a"), "new");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
}

TEST_F(File, gets_the_usual_permissions_when_new) {
  const mode_t mask = ::umask(027);
  write_file(path("a"), "new");
  ::umask(mask);
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
}

TEST_F(File, is_replaced_behind_a_link_that_stays) {
  fs::create_directory(path("deeper"));
  write_file(path("deeper/target"), "old");
  fs::create_symlink("deeper/target", path("link"));
  fs::create_symlink("link", path("link to link"));
  write_file(path("link to link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_symlink(path("link to link")));
  EXPECT_EQ(read_file(path("deeper/target")), "new");
}

TEST_F(File, is_made_behind_a_link_to_nothing) {
  fs::create_directory(path("deeper"));
  fs::create_symlink("deeper/target", path("link"));
  write_file(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_file(path("deeper/target")), "new");
}

TEST_F(File, may_be_a_pipe) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_file(path("pipe"), "through");
  char bytes[16] = {};
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 7);
  ::close(reader);
  EXPECT_STREQ(bytes, "through");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(File, is_appended_to_where_standard_output_leads_to_it) {
  write_file(path("log"), "before\n");
  const int file = ::open(path("log").c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(file, 0);
  write_file("/dev/fd/" + std::to_string(file), "after\n");
  EXPECT_EQ(::write(file, "last\n", 5), 5);
  ::close(file);
  EXPECT_EQ(read_file(path("log")), "before\nafter\nlast\n");
  EXPECT_EQ(n_files(), 1u);
}

TEST_F(File, tells_when_a_device_is_full) {
  EXPECT_THROW(write_file("/dev/full", "x"), FileError);
  EXPECT_NO_THROW(write_file("/dev/null", "x"));
}

std::string complaint(const std::string& path) {
  try {
    (void)read_file(path);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST_F(File, is_named_when_it_cannot_be_read) {
  EXPECT_EQ(complaint(path("none")), path("none") + ": cannot open: No such file or directory");
  EXPECT_EQ(complaint(path("")), path("") + ": is a folder, not a file");
}

TEST_F(File, is_named_when_it_cannot_be_written) {
  for (const std::string& name : {path("none/a"), path("")}) {
    try {
      write_file(name, "x");
      ADD_FAILURE() << name;
    } catch (const FileError& error) {
      EXPECT_EQ(std::string(error.what()).find(name + ": cannot write: "), 0u);
    }
  }
  EXPECT_EQ(n_files(), 0u);
}

}  // namespace
}  // namespace espalier
