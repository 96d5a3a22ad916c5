#include "lattice/io/ovm_writer.h"

#include <fmt/format.h>

#include "lattice/core/error.h"
#include "lattice/io/json_lattice.h"
#include "lattice/io/number_text.h"

namespace espalier {
namespace {

void append_vertices(std::string& text, std::span<const glm::dvec3> points) {
  for (const glm::dvec3& point : points) {
    append_point(text, point, ' ');
    text += '\n';
  }
}

void append_faces(std::string& text, const CellComplex& complex) {
  for (const FaceId face : complex.faces()) {
    const auto edges = complex.edges(face);
    const auto loop = complex.vertices(face);
    text += fmt::format_int(edges.size()).c_str();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool runs_along = complex.vertices(edges[i])[0] == loop[i];
      text += ' ';
      text += fmt::format_int(2 * edges[i].value + (runs_along ? 0 : 1)).c_str();
    }
    text += '\n';
  }
}

void append_cells(std::string& text, const CellComplex& complex) {
  for (const CellId cell : complex.cells()) {
    text += fmt::format_int(complex.half_faces(cell).size()).c_str();
    for (const HalfFaceId half_face : complex.half_faces(cell)) {
      text += ' ';
      text += fmt::format_int(half_face.opposite().value).c_str();
    }
    text += '\n';
  }
}

void append_sharpness(std::string& text, std::string_view entity,
                      const std::vector<float>& sharpness) {
  text += fmt::format("{} float \"espalier:sharpness\"\n", entity);
  for (const float s : sharpness) {
    append_number(text, s);
    text += '\n';
  }
}

void append_string(std::string& text, std::string_view name, std::string_view value) {
  text += fmt::format("MProp string \"{}\"\n{}:{}\n", name, value.size(), value);
}

void append_extra(std::string& text, const std::string& extra_json) {
  if (extra_json.empty()) {
    return;
  }
  try {
    if (const std::string extra = foreign_keys("extra_json", extra_json); !extra.empty()) {
      append_string(text, "espalier:extra", extra);
    }
  } catch (const FileError& error) {
    throw LatticeError(error.what());
  }
}

}  // namespace

std::string ovm_text(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  std::string text = fmt::format("OVM ASCII\nVertices\n{}\n", complex.n_vertices());
  append_vertices(text, lattice.rest);
  text += fmt::format("Edges\n{}\n", complex.n_edges());
  for (const EdgeId edge : complex.edges()) {
    text +=
        fmt::format("{} {}\n", complex.vertices(edge)[0].value, complex.vertices(edge)[1].value);
  }
  text += fmt::format("Faces\n{}\n", complex.n_faces());
  append_faces(text, complex);
  text += fmt::format("Polyhedra\n{}\n", complex.n_cells());
  append_cells(text, complex);

  const Sharpness automatic = automatic_sharpness(complex);
  if (lattice.sharpness.vertices != automatic.vertices) {
    append_sharpness(text, "VProp", lattice.sharpness.vertices.values());
  }
  if (!lattice.pose.empty()) {
    text += "VProp vec3d \"espalier:pose\"\n";
    append_vertices(text, lattice.pose);
  }
  if (lattice.sharpness.edges != automatic.edges) {
    append_sharpness(text, "EProp", lattice.sharpness.edges.values());
  }
  if (lattice.scheme != Scheme::CatmullClark) {
    append_string(text, "espalier:scheme", name_of(lattice.scheme));
  }
  append_extra(text, lattice.extra_json);
  return text;
}

}  // namespace espalier
