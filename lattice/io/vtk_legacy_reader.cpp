#include "lattice/io/vtk_legacy_reader.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "lattice/io/word_reader.h"

namespace espalier {
namespace {

constexpr std::int64_t kVoxel = 11;
constexpr std::int64_t kLastFlatType = 9;  // vertices, lines, triangles, quadrilaterals, polygons

std::optional<MeshCell> kind_of(std::int64_t type) {
  switch (type) {
    case 10:
      return MeshCell::Tetrahedron;
    case kVoxel:
    case 12:
      return MeshCell::Hexahedron;
    case 13:
      return MeshCell::Prism;
    case 14:
      return MeshCell::Pyramid;
    default:
      return std::nullopt;
  }
}

class VtkReader {
 public:
  VtkReader(const std::string& path, std::string_view text) : reader_(path, text) {}

  RawLattice read() {
    read_header();
    read_points();
    reader_.expect("CELLS");
    read_corners();
    reader_.expect("CELL_TYPES");
    read_types();
    if (!mesh_.has_cells()) {
      reader_.fail("has no tetrahedra, hexahedra, wedges or pyramids");
    }
    return std::move(mesh_).lattice();
  }

 private:
  void read_header() {
    const std::string_view first = reader_.next().value_or("");
    if (first != "#" || reader_.rest_of_line().substr(0, 20) != "vtk DataFile Version") {
      reader_.fail("is no legacy VTK file: needs the header \"# vtk DataFile Version\"");
    }
    reader_.skip_line();  // the title
    if (const std::string_view encoding = reader_.word("ASCII"); encoding != "ASCII") {
      reader_.fail(encoding == "BINARY" ? "is binary; only ASCII files are read"
                                        : "expected ASCII, not " + quoted(encoding));
    }
    reader_.expect("DATASET");
    reader_.expect("UNSTRUCTURED_GRID");
  }

  void read_points() {
    reader_.expect("POINTS");
    const std::int64_t n = reader_.count("the number of points");
    (void)reader_.word("the type of the points");
    for (std::int64_t i = 0; i < n; ++i) {
      mesh_.add_point(reader_.point());
    }
  }

  /// Either rows with their lengths, or offsets and connectivity.
  void read_corners() {
    const std::int64_t n = reader_.count("the number of cells");
    const std::int64_t n_values = reader_.count("the size of the cells");
    const std::string_view word = reader_.word("a cell");
    if (word == "OFFSETS") {
      read_offsets(n, n_values);
      return;
    }
    std::int64_t length = 0;
    for (std::int64_t i = 0; i < n; ++i) {
      if (i > 0) {
        length = reader_.count(fmt::format("the size of cell {} of {}", i, n));
      } else if (!parse_integer(word, length) || length < 0) {
        reader_.fail("expected the size of cell 0, not " + quoted(word));
      }
      for (std::int64_t c = 0; c < length; ++c) {
        add_corner();
      }
      ends_.push_back(corners_.size());
    }
  }

  void read_offsets(std::int64_t n, std::int64_t n_values) {
    (void)reader_.word("the type of the offsets");
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t offset = reader_.count(fmt::format("offset {} of {}", i, n));
      if ((i == 0 && offset != 0) || offset > n_values ||
          (i > 1 && static_cast<std::size_t>(offset) < ends_.back())) {
        reader_.fail(
            fmt::format("offset {} is {}, offsets must rise from 0 to {}", i, offset, n_values));
      }
      if (i > 0) {
        ends_.push_back(static_cast<std::size_t>(offset));
      }
    }
    reader_.expect("CONNECTIVITY");
    (void)reader_.word("the type of the connectivity");
    for (std::int64_t i = 0; i < n_values; ++i) {
      add_corner();
    }
  }

  void add_corner() {
    const std::int64_t corner = reader_.integer("a corner");
    if (corner < 0 || corner >= static_cast<std::int64_t>(mesh_.n_points())) {
      reader_.fail(fmt::format("point {} does not exist, there are {}", corner, mesh_.n_points()));
    }
    corners_.push_back(static_cast<std::int32_t>(corner));
  }

  void read_types() {
    const std::int64_t n = reader_.count("the number of cell types");
    if (n != static_cast<std::int64_t>(ends_.size())) {
      reader_.fail(fmt::format("{} cell types for {} cells", n, ends_.size()));
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const std::int64_t type = reader_.integer(fmt::format("the type of cell {}", i));
      add_cell(i, type, std::span(corners_).subspan(begin, ends_[i] - begin));
      begin = ends_[i];
    }
  }

  void add_cell(std::size_t cell, std::int64_t type, std::span<std::int32_t> corners) {
    const auto kind = kind_of(type);
    if (!kind) {
      if (type < 0 || type > kLastFlatType) {
        reader_.fail(
            fmt::format("cell {} is of type {}; only linear tetrahedra, hexahedra, wedges and "
                        "pyramids are read",
                        cell, type));
      }
      return;
    }
    if (corners.size() != n_corners(*kind)) {
      reader_.fail(fmt::format("cell {} of type {} has {} corners, needs {}", cell, type,
                               corners.size(), n_corners(*kind)));
    }
    if (type == kVoxel) {
      std::swap(corners[2], corners[3]);
      std::swap(corners[6], corners[7]);
    }
    mesh_.add_cell(*kind, corners);
  }

  WordReader reader_;
  MeshCells mesh_;
  std::vector<std::int32_t> corners_;
  std::vector<std::size_t> ends_;  // of each cell in corners_
};

}  // namespace

RawLattice parse_vtk_legacy(const std::string& path, std::string_view text) {
  return VtkReader(path, text).read();
}

}  // namespace espalier
