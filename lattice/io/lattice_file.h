#pragma once

/// Subdivision lattices in and out of files: JSON (.json, see json_lattice.h) and OpenVolumeMesh
/// ASCII (.ovm, see ovm_reader.h). Volume meshes are read too: MEDIT (.mesh), legacy VTK (.vtk) and
/// Gmsh 4.1 (.msh).

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/topology/polyhedra.h"

namespace espalier {

/// An edge by its ends and how sharp it is.
struct SharpEdge {
  std::array<std::int32_t, 2> vertices{};
  float sharpness = 0;
};

struct SharpVertex {
  std::int32_t vertex = 0;
  float sharpness = 0;
};

/// What a lattice file says: indices are in range and coordinates finite, but the cells may be no
/// valid complex and the sharp elements may not exist.
struct RawLattice {
  Polyhedra polyhedra;           ///< oriented as far as that is possible
  std::vector<glm::dvec3> rest;  ///< #vertices, model units
  std::vector<glm::dvec3> pose;  ///< #vertices, or empty: at rest
  Scheme scheme = Scheme::CatmullClark;
  std::optional<std::vector<SharpEdge>> sharp_edges;       ///< absent: automatic tags
  std::optional<std::vector<SharpVertex>> sharp_vertices;  ///< absent: automatic tags
  std::string extra_json;  ///< keys that are not ours, a JSON object; empty: none
};

/// Reads a file by its extension. Throws FileError if it is missing, of an unknown format, or not
/// as its format says; the message names the JSON path or the line.
[[nodiscard]] RawLattice read_raw_lattice(const std::string& path);

/// The valid lattice that a file describes. A list of sharp edges or vertices, even an empty one,
/// replaces the automatic tags of its kind. Throws LatticeError if the lattice has a defect or a
/// sharp element does not exist, is not on the boundary or is listed twice; messages begin with
/// `path`. About O(n log n).
[[nodiscard]] SubdivisionLattice build_lattice(RawLattice raw, const std::string& path,
                                               const Progress& progress = {});

/// Both of the above.
[[nodiscard]] SubdivisionLattice read_lattice(const std::string& path,
                                              const Progress& progress = {});

/// Writes a file by its extension; reading it back gives an equal lattice, bit for bit. Throws
/// FileError if the extension is neither .json nor .ovm or the file cannot be written, and
/// LatticeError for a lattice whose arrays do not match or hold no finite numbers.
void write_lattice(const std::string& path, const SubdivisionLattice& lattice);

/// Whether a path's extension is that of lattice files or volume meshes: .json, .ovm, .mesh, .vtk,
/// .msh (.ovmb counts too, to be refused with a reason).
[[nodiscard]] bool is_lattice_path(const std::string& path);

/// Throws FileError unless a lattice can be written to a file of this name.
void require_lattice_path(const std::string& path);

/// The scheme's name in files, and back; nothing for a name of no scheme.
[[nodiscard]] std::string_view name_of(Scheme scheme);
[[nodiscard]] std::optional<Scheme> scheme_named(std::string_view name);

}  // namespace espalier
