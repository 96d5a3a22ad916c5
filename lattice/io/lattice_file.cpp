#include "lattice/io/lattice_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/core/text_scanner.h"
#include "lattice/io/json_lattice.h"
#include "lattice/io/ovm_reader.h"
#include "lattice/io/ovm_writer.h"
#include "lattice/topology/validate.h"

namespace espalier {
namespace {

enum class Format { Json, Ovm };

bool ends_with_ignoring_case(std::string_view text, std::string_view end) {
  return text.size() >= end.size() &&
         std::equal(end.begin(), end.end(), text.end() - static_cast<std::ptrdiff_t>(end.size()),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

Format format_of(const std::string& path) {
  if (ends_with_ignoring_case(path, ".json")) {
    return Format::Json;
  }
  if (ends_with_ignoring_case(path, ".ovm")) {
    return Format::Ovm;
  }
  if (ends_with_ignoring_case(path, ".ovmb")) {
    throw FileError(path, "is binary OpenVolumeMesh; lattice files are .json or ASCII .ovm");
  }
  throw FileError(path, "unknown kind of lattice file; lattice files end in .json or .ovm");
}

/// Runs `work`; a LatticeError that leaves it begins with the path.
template <class Work>
auto naming_file(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const LatticeError& error) {
    throw LatticeError(path + ": " + error.what());
  }
}

void set_sharp_edges(const CellComplex& complex, const std::vector<SharpEdge>& sharp_edges,
                     IdVector<EdgeId, float>& sharpness) {
  sharpness = IdVector<EdgeId, float>(complex.n_edges(), 0.0f);
  std::vector<bool> is_listed(complex.n_edges(), false);
  for (std::size_t i = 0; i < sharp_edges.size(); ++i) {
    const auto [a, b] = sharp_edges[i].vertices;
    const auto fail = [&, a = a, b = b](std::string_view what) {
      throw LatticeError(fmt::format("sharp_edges[{}]: edge {}-{} {}", i, a, b, what));
    };
    const bool is_in_range = a >= 0 && static_cast<std::size_t>(a) < complex.n_vertices();
    const EdgeId edge = is_in_range ? complex.find_edge(VertexId{a}, VertexId{b}) : EdgeId{};
    if (!edge.is_valid()) {
      fail("does not exist");
    }
    if (!complex.is_boundary(edge)) {
      fail("is not on the boundary, where alone edges may be sharp");
    }
    if (is_listed[edge.index()]) {
      fail("is listed twice");
    }
    is_listed[edge.index()] = true;
    sharpness[edge] = sharp_edges[i].sharpness;
  }
}

void set_sharp_vertices(const CellComplex& complex, const std::vector<SharpVertex>& sharp_vertices,
                        IdVector<VertexId, float>& sharpness) {
  sharpness = IdVector<VertexId, float>(complex.n_vertices(), 0.0f);
  std::vector<bool> is_listed(complex.n_vertices(), false);
  for (std::size_t i = 0; i < sharp_vertices.size(); ++i) {
    const VertexId vertex{sharp_vertices[i].vertex};
    const auto fail = [&](std::string_view what) {
      throw LatticeError(fmt::format("sharp_vertices[{}]: vertex {} {}", i, vertex.value, what));
    };
    if (!vertex.is_valid() || vertex.index() >= complex.n_vertices()) {
      fail("does not exist");
    }
    if (!complex.is_boundary(vertex)) {
      fail("is not on the boundary, where alone vertices may be sharp");
    }
    if (is_listed[vertex.index()]) {
      fail("is listed twice");
    }
    is_listed[vertex.index()] = true;
    sharpness[vertex] = sharp_vertices[i].sharpness;
  }
}

void check_points(std::span<const glm::dvec3> points, std::string_view name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(points[i][axis]) <= kLargestCoordinate)) {
        throw LatticeError(fmt::format("{} point {} has a coordinate {}, not a number up to 1e18",
                                       name, i, points[i][axis]));
      }
    }
  }
}

void check_writable(const SubdivisionLattice& lattice) {
  if (!lattice.complex) {
    throw LatticeError("the lattice has no cells");
  }
  const CellComplex& complex = *lattice.complex;
  if (lattice.rest.size() != complex.n_vertices() ||
      (!lattice.pose.empty() && lattice.pose.size() != complex.n_vertices())) {
    throw LatticeError(fmt::format("has {} rest and {} posed points for {} vertices",
                                   lattice.rest.size(), lattice.pose.size(), complex.n_vertices()));
  }
  if (lattice.sharpness.edges.size() != complex.n_edges() ||
      lattice.sharpness.vertices.size() != complex.n_vertices()) {
    throw LatticeError("its sharpness does not match its edges and vertices");
  }
  check_points(lattice.rest, "rest");
  check_points(lattice.pose, "posed");
  const auto is_sharpness = [](float s) { return s >= 0 && std::isfinite(s); };
  if (!std::all_of(lattice.sharpness.edges.begin(), lattice.sharpness.edges.end(), is_sharpness) ||
      !std::all_of(lattice.sharpness.vertices.begin(), lattice.sharpness.vertices.end(),
                   is_sharpness)) {
    throw LatticeError("its sharpness holds a value that is negative or not finite");
  }
}

}  // namespace

std::string_view name_of(Scheme scheme) {
  return scheme == Scheme::CatmullClark ? "catmull-clark" : "mj96";
}

std::optional<Scheme> scheme_named(std::string_view name) {
  for (const Scheme scheme : {Scheme::CatmullClark, Scheme::MacCrackenJoy}) {
    if (name == name_of(scheme)) {
      return scheme;
    }
  }
  return std::nullopt;
}

RawLattice read_raw_lattice(const std::string& path) {
  const Format format = format_of(path);
  const std::string text = read_file(path);
  return format == Format::Json ? parse_json_lattice(path, text) : parse_ovm(path, text);
}

SubdivisionLattice build_lattice(RawLattice raw, const std::string& path,
                                 const Progress& progress) {
  return naming_file(path, [&] {
    const auto n_vertices = static_cast<std::size_t>(raw.polyhedra.n_vertices);
    if (raw.rest.size() != n_vertices || (!raw.pose.empty() && raw.pose.size() != n_vertices)) {
      throw LatticeError(fmt::format("has {} rest and {} posed points for {} vertices",
                                     raw.rest.size(), raw.pose.size(), n_vertices));
    }
    SubdivisionLattice lattice;
    lattice.complex = valid_complex(std::move(raw.polyhedra), raw.rest, progress);
    lattice.rest = std::move(raw.rest);
    lattice.pose = std::move(raw.pose);
    lattice.scheme = raw.scheme;
    lattice.extra_json = std::move(raw.extra_json);
    lattice.sharpness = automatic_sharpness(*lattice.complex);
    if (raw.sharp_edges) {
      set_sharp_edges(*lattice.complex, *raw.sharp_edges, lattice.sharpness.edges);
    }
    if (raw.sharp_vertices) {
      set_sharp_vertices(*lattice.complex, *raw.sharp_vertices, lattice.sharpness.vertices);
    }
    return lattice;
  });
}

bool is_lattice_path(const std::string& path) {
  return ends_with_ignoring_case(path, ".json") || ends_with_ignoring_case(path, ".ovm") ||
         ends_with_ignoring_case(path, ".ovmb");
}

void require_lattice_path(const std::string& path) {
  static_cast<void>(format_of(path));
}

SubdivisionLattice read_lattice(const std::string& path, const Progress& progress) {
  return build_lattice(read_raw_lattice(path), path, progress);
}

void write_lattice(const std::string& path, const SubdivisionLattice& lattice) {
  const Format format = format_of(path);
  const std::string text = naming_file(path, [&] {
    check_writable(lattice);
    return format == Format::Json ? json_text(lattice) : ovm_text(lattice);
  });
  write_file(path, text);
}

}  // namespace espalier
