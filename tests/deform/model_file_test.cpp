#include "deform/model/model_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "tests/deform/odd_obj_files.h"

namespace espalier {
namespace {

std::string temporary(const std::string& name) {
  return ::testing::TempDir() + name;
}

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ModelFile, writes_what_it_read_byte_for_byte) {
  for (const OddObjFile& file : odd_obj_files()) {
    write_file(temporary("in.OBJ"), file.bytes);
    write_model(temporary("out.obj"), read_model(temporary("in.OBJ")));
    EXPECT_EQ(read_file(temporary("out.obj")), file.bytes) << file.what;
  }
}

TEST(ModelFile, names_the_formats_that_work_when_it_knows_none) {
  EXPECT_EQ(error_of([] { (void)read_model("m.xyz"); }),
            "m.xyz: not a model: extension '.xyz' is unknown; models that can be read: .obj, .off, "
            ".ply, .stl");
  EXPECT_EQ(error_of([] { (void)read_model("model"); }),
            "model: not a model: the name has no extension; models that can be read: .obj, .off, "
            ".ply, .stl");
}

TEST(ModelFile, says_that_a_file_is_missing) {
  EXPECT_EQ(error_of([] { (void)read_model("/no/such.obj"); }),
            "/no/such.obj: cannot open: No such file or directory");
}

TEST(ModelFile, does_not_convert) {
  const Model model = parse_model(ModelFormat::Obj, "m.obj", "v 0 0 0\n");
  EXPECT_EQ(error_of([&] { write_model(temporary("x.ply"), model); }),
            temporary("x.ply") +
                ": cannot write m.obj as '.ply': a model keeps its format; name "
                "the output *.obj");
  EXPECT_FALSE(std::filesystem::exists(temporary("x.ply")));
  EXPECT_EQ(error_of([&] { require_same_format("/dev/stdout", model); }), "no error");
}

}  // namespace
}  // namespace espalier
