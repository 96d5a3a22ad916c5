#include "lattice/io/medit_reader.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "lattice/io/word_reader.h"

namespace espalier {
namespace {

/// Adds the cells of one section: corners counted from 1, then a reference.
void read_cells(WordReader& reader, std::string_view keyword, MeshCell kind, MeshCells& mesh) {
  const std::int64_t n = reader.count("the number of cells");
  std::array<std::int32_t, 8> corners{};
  for (std::int64_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < n_corners(kind); ++c) {
      const std::int64_t corner =
          reader.integer(fmt::format("corner {} of {} {} of {}", c, keyword, i, n));
      if (corner < 1 || corner > static_cast<std::int64_t>(mesh.n_points())) {
        reader.fail(fmt::format("vertex {} does not exist, there are {} (1…{})", corner,
                                mesh.n_points(), mesh.n_points()));
      }
      corners[c] = static_cast<std::int32_t>(corner - 1);
    }
    (void)reader.integer(fmt::format("the reference of {} {} of {}", keyword, i, n));
    mesh.add_cell(kind, std::span(corners).first(n_corners(kind)));
  }
}

void read_vertices(WordReader& reader, MeshCells& mesh) {
  if (mesh.n_points() > 0) {
    reader.fail("a second list of Vertices");
  }
  const std::int64_t n = reader.count("the number of vertices");
  for (std::int64_t i = 0; i < n; ++i) {
    mesh.add_point(reader.point());
    (void)reader.integer(fmt::format("the reference of vertex {} of {}", i, n));
  }
}

void read_header(WordReader& reader) {
  const auto first = reader.next();
  if (!first || *first != "MeshVersionFormatted") {
    reader.fail("is no MEDIT mesh: needs the header \"MeshVersionFormatted\"");
  }
  (void)reader.integer("the version");
}

bool is_keyword(std::string_view word) {
  const char c = word.front();
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

}  // namespace

RawLattice parse_medit(const std::string& path, std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, MeshCell>, 4> kKinds = {
      {{"Tetrahedra", MeshCell::Tetrahedron},
       {"Pyramids", MeshCell::Pyramid},
       {"Prisms", MeshCell::Prism},
       {"Hexahedra", MeshCell::Hexahedron}}};
  WordReader reader(path, text, '#');
  read_header(reader);
  MeshCells mesh;
  while (const auto word = reader.next()) {
    if (*word == "End") {
      break;
    }
    if (*word == "Dimension") {
      if (const std::int64_t dimension = reader.integer("the dimension"); dimension != 3) {
        reader.fail(fmt::format("has {} dimensions, a volume mesh has 3", dimension));
      }
    } else if (*word == "Vertices") {
      read_vertices(reader, mesh);
    }
    for (const auto& [keyword, kind] : kKinds) {
      if (*word == keyword) {
        read_cells(reader, keyword, kind, mesh);
      }
    }
    // Numbers of keywords that do not concern us are skipped, one by one.
    std::int64_t integer = 0;
    double number = 0;
    if (!is_keyword(*word) && !parse_integer(*word, integer) && !parse_number(*word, number)) {
      reader.fail(quoted(*word) + " is neither a keyword nor a number");
    }
  }
  if (!mesh.has_cells()) {
    reader.fail("has no cells: no Tetrahedra, Pyramids, Prisms or Hexahedra");
  }
  return std::move(mesh).lattice();
}

}  // namespace espalier
