#pragma once

#include <string>

#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier {

/// The lattice as OpenVolumeMesh ASCII, see ovm_reader.h; half-faces look into their cells, as in
/// the files of OpenVolumeMesh. Sharpness is written where it differs from the automatic tags, the
/// pose where there is one. Throws LatticeError if extra_json is no JSON object.
[[nodiscard]] std::string ovm_text(const SubdivisionLattice& lattice);

}  // namespace espalier
