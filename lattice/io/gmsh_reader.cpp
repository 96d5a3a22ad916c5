#include "lattice/io/gmsh_reader.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include "lattice/io/word_reader.h"

namespace espalier {
namespace {

std::optional<MeshCell> kind_of(std::int64_t type) {
  switch (type) {
    case 4:
      return MeshCell::Tetrahedron;
    case 5:
      return MeshCell::Hexahedron;
    case 6:
      return MeshCell::Prism;
    case 7:
      return MeshCell::Pyramid;
    default:
      return std::nullopt;
  }
}

class GmshReader {
 public:
  GmshReader(const std::string& path, std::string_view text) : reader_(path, text) {}

  RawLattice read() {
    read_header();
    while (const auto word = reader_.next()) {
      if (*word == "$Nodes") {
        read_nodes();
      } else if (*word == "$Elements") {
        read_elements();
      } else if (word->starts_with('$')) {
        skip_section("$End" + std::string(word->substr(1)));
      } else {
        reader_.fail("expected a section, not " + quoted(*word));
      }
    }
    if (!mesh_.has_cells()) {
      reader_.fail("has no tetrahedra, hexahedra, prisms or pyramids");
    }
    return std::move(mesh_).lattice();
  }

 private:
  void read_header() {
    if (reader_.next().value_or("") != "$MeshFormat") {
      reader_.fail("is no Gmsh mesh: needs the section \"$MeshFormat\"");
    }
    if (const std::string_view version = reader_.word("the version"); version != "4.1") {
      reader_.fail("is of version " + quoted(version) +
                   "; only 4.1 is read (gmsh -save -format msh41 converts)");
    }
    if (reader_.integer("the file type") != 0) {
      reader_.fail("is binary; only text files are read");
    }
    (void)reader_.integer("the size of numbers");
    reader_.expect("$EndMeshFormat");
  }

  void skip_section(const std::string& end) {
    while (reader_.word(end) != end) {
    }
  }

  /// The header of a section: its number of blocks.
  std::int64_t read_counts() {
    const std::int64_t n_blocks = reader_.count("the number of blocks");
    for (const char* what : {"the number of elements", "the smallest tag", "the largest tag"}) {
      (void)reader_.count(what);
    }
    return n_blocks;
  }

  void read_nodes() {
    const std::int64_t n_blocks = read_counts();
    std::vector<std::int64_t> tags;
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t dimension = reader_.count("the dimension of a block");
      (void)reader_.integer("the tag of a block");
      const bool is_parametric = reader_.integer("whether a block is parametric") != 0;
      const std::int64_t n = reader_.count("the number of nodes of a block");
      tags.clear();
      for (std::int64_t i = 0; i < n; ++i) {
        tags.push_back(reader_.integer("the tag of a node"));
      }
      for (const std::int64_t tag : tags) {
        if (!node_of_.emplace(tag, static_cast<std::int32_t>(mesh_.n_points())).second) {
          reader_.fail(fmt::format("node {} is listed twice", tag));
        }
        mesh_.add_point(reader_.point());
        for (std::int64_t i = 0; is_parametric && i < dimension && i < 3; ++i) {
          (void)reader_.word("a parameter of a node");
        }
      }
    }
    reader_.expect("$EndNodes");
  }

  void read_elements() {
    const std::int64_t n_blocks = read_counts();
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t dimension = reader_.count("the dimension of a block");
      (void)reader_.integer("the tag of a block");
      const std::int64_t type = reader_.integer("the type of a block");
      const std::int64_t n = reader_.count("the number of elements of a block");
      const auto kind = kind_of(type);
      if (dimension == 3 && !kind) {
        reader_.fail(fmt::format(
            "has elements of type {}; only linear tetrahedra, hexahedra, prisms and pyramids are "
            "read",
            type));
      }
      for (std::int64_t i = 0; i < n; ++i) {
        (void)reader_.integer("the tag of an element");
        if (kind) {
          read_cell(*kind);
        } else {
          (void)reader_.rest_of_line();
        }
      }
    }
    reader_.expect("$EndElements");
  }

  void read_cell(MeshCell kind) {
    std::array<std::int32_t, 8> corners{};
    for (std::size_t c = 0; c < n_corners(kind); ++c) {
      const std::int64_t tag = reader_.integer("a node of an element");
      const auto found = node_of_.find(tag);
      if (found == node_of_.end()) {
        reader_.fail(fmt::format("node {} does not exist", tag));
      }
      corners[c] = found->second;
    }
    mesh_.add_cell(kind, std::span(corners).first(n_corners(kind)));
  }

  WordReader reader_;
  MeshCells mesh_;
  std::unordered_map<std::int64_t, std::int32_t> node_of_;
};

}  // namespace

RawLattice parse_gmsh(const std::string& path, std::string_view text) {
  return GmshReader(path, text).read();
}

}  // namespace espalier
