#pragma once

/// Small OBJ files that have been trouble somewhere, all valid.

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace espalier {

struct OddObjFile {
  const char* what;
  std::string bytes;
};

/// Every statement that the scanner knows, and many that it keeps.
inline const std::string kRichObj =
    "\xEF\xBB\xBF# rich \\\n"
    "mtllib a b.mtl\n"
    "o thing\n"
    "v -1 -1.50 0\t0.5\n"
    "\tv  +1 -1 0   # right\n"
    "v 1e0 1 .5 1 0.25 0 nan\n"
    "v -1. \\\n  1 \\\n  0\n"
    "v 0 0 2\n"
    "vt 0 0\nvt 1 0\nvt 1 1\n"
    "vn 0 0 1\n"
    "vn 0.7071 0 0.7071 # slanted\n"
    "g front side#2\nusemtl red#1\ns 1\n"
    "f 1/1/1 2/2/1 3/3/2\n"
    "f -5//-2 -3//-1 \\\n -2//-2\n"
    "g back\n"
    "f 1 2 5\nf 1/1 5/2 6/3\n"
    "l 1/1 2/2 5\np 1 -1\n"
    "vp 0.5 0.5\ncstype rat bspline\ndeg 1 1\n"
    "surf 0 1 0 1 1/1/1 2/2/1 3/3/2 4/1/-1\nparm u 0 0 1 1\nparm v 0 0 1 1\nend\n"
    "v 3 3 3\n"
    "call other.obj $1 \\\n $2\n"
    "fo 1//1 2//2 6//1";

inline std::vector<OddObjFile> odd_obj_files() {
  std::string crlf;
  std::string cr;
  for (const char c : kRichObj) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  return {
      {"rich", kRichObj},
      {"CR LF", crlf},
      {"CR", cr},
      {"triangle", triangle},
      {"no final line end", triangle.substr(0, triangle.size() - 1)},
      {"mixed line ends", "v 0 0 0\r\nv 1 0 0\rv 0 1 0\n\r\n\rf 1 2 3\r\r\n"},
      {"points only", "v 0 0 0\nv 1 2 3\n"},
      {"one point, nothing else", "v 0 0 0"},
      {"faces first", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0"},
      {"trailing blanks and tabs", "v\t0 0 0 \t\nv 1\t0 0\t\n\tv 0 1 0   \n f\t1  2 3 \n"},
      {"long name", "o " + std::string(300, 'x') + "\n" + triangle},
      {"zero bytes in a comment", std::string("# \0\xFF\x80\n", 6) + triangle},
      {"backslash as last byte", triangle + "vn 0 0 1\\"},
      {"joined with nothing", triangle + "usemtl x\\\n"},
      {"windows path in a comment", "# C:\\models\\\n" + triangle},
      {"empty parts of references", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2// 3//\n"},
      {"normals nobody uses", "vn 1 2 3\n" + triangle + "vn 0 0 0\n"},
      {"references to normals and no normal", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/7/2 3/3/3\n"},
      {"many digits", "v 0.12345678901234567890123456789 1e-400 0\n"},
      {"unknown statements", triangle + "vw 0 1 0.5\nt crease 2/1/1 0 1 2.5\n\x01\x02 v 1\nV x\n"},
  };
}

/// A copy with a few bytes replaced, inserted and erased, mostly by what an OBJ file is made of.
inline std::string mutated(std::string bytes, std::mt19937& random) {
  constexpr char kLikely[] = "0123456789-+.eE/\\# \t\r\nvfntglps";
  const std::size_t n_changes = 1 + random() % 4;
  for (std::size_t change = 0; change < n_changes; ++change) {
    const std::size_t at = random() % bytes.size();
    const char c = random() % 4 == 0 ? static_cast<char>(random() % 256)
                                     : kLikely[random() % (sizeof kLikely - 1)];
    switch (random() % 3) {
      case 0:
        bytes[at] = c;
        break;
      case 1:
        bytes.insert(at, 1, c);
        break;
      default:
        bytes.erase(at, 1 + random() % 3);
    }
  }
  return bytes;
}

}  // namespace espalier
