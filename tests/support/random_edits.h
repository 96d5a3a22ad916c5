#pragma once

/// Lattices edited at random.

#include <random>
#include <string>

#include "lattice/subdivision/subdivision_lattice.h"

namespace espalier::test {

/// One edit of a kind, of elements and by amounts that chance chooses; some are impossible.
struct RandomEdit {
  std::string name;
  SubdivisionLattice result;  ///< without a complex if the edit was refused
  std::string refusal;        ///< why; empty if it was not
};

[[nodiscard]] RandomEdit random_edit(const SubdivisionLattice& lattice, std::mt19937& random);

/// A small lattice of a kind that chance chooses, some posed, some with creases by hand.
[[nodiscard]] SubdivisionLattice random_seed(std::mt19937& random);

}  // namespace espalier::test
