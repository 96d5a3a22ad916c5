#pragma once

/// Subdivision lattices as JSON:
///
///     { "format": "espalier/1", "type": "subdivision",
///       "scheme": "catmull-clark" or "mj96",      absent: catmull-clark
///       "vertices": [[x,y,z], …],
///       "faces": [[v, …], …],                     loops in any order and winding
///       "cells": [[f, …], …],                     by faces; the reader orients them
///       "sharp_edges": [[v0,v1,s], …],            absent: automatic tags; [] none
///       "sharp_vertices": [[v,s], …],             absent: automatic tags; [] none
///       "pose": [[x,y,z], …] }                    absent: at rest
///
/// All other keys are kept and written back.

#include <string>
#include <string_view>

#include "lattice/io/lattice_file.h"

namespace espalier {

/// Throws FileError naming the line of a syntax error, or the element by its JSON path. O(n).
[[nodiscard]] RawLattice parse_json_lattice(const std::string& path, std::string_view text);

/// One vertex, face or cell a line, numbers in their shortest exact form. Sharp lists are written
/// where they differ from the automatic tags, the pose where there is one. Throws LatticeError if
/// extra_json is no JSON object.
[[nodiscard]] std::string json_text(const SubdivisionLattice& lattice);

/// The keys of a JSON object that are not ours, as a compact object, empty if there are none.
/// Throws FileError if `text` is no JSON object.
[[nodiscard]] std::string foreign_keys(const std::string& path, std::string_view text);

}  // namespace espalier
