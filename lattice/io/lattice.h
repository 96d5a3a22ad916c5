#pragma once

/// A lattice of any type, as a value: what scenes, commands and viewers hold.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lattice/core/progress.h"
#include "lattice/io/lattice_file.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/subdivision/subdivision_lattice.h"
#include "lattice/tensor/tensor_lattice.h"
#include "lattice/tensor/thb_lattice.h"
#include "lattice/volume/volume.h"

namespace espalier {

/// How lattices freeze that do not freeze exactly: subdivision lattices.
struct FreezeOptions {
  AdaptiveOptions adaptive;
  int uniform_levels = 0;  ///< refine so often everywhere instead, 1 to 8; 0: adaptive
};

/// Copies are cheap: they share the lattice.
class Lattice {
 public:
  // NOLINTBEGIN(google-explicit-constructor): every lattice is one.
  Lattice(SubdivisionLattice lattice);
  Lattice(TensorLattice lattice);
  Lattice(ThbLattice lattice);
  // NOLINTEND(google-explicit-constructor)

  /// "subdivision", "bezier", "bspline", "nurbs" or "thb".
  [[nodiscard]] std::string_view type() const;

  /// #controls each, model units. The pose is at rest where there is none.
  [[nodiscard]] std::span<const glm::dvec3> rest_points() const;
  [[nodiscard]] std::span<const glm::dvec3> posed_points() const;

  /// What is drawn between control points: the edges of cells, or the lines of a grid, of each
  /// level of a hierarchy. #edges × 2
  [[nodiscard]] std::vector<std::array<std::int32_t, 2>> net() const;

  /// Throws LatticeError or ParameterError as the type's own function.
  [[nodiscard]] Volume freeze(const FreezeOptions& options = {},
                              const Progress& progress = {}) const;

  /// The same lattice in another pose, #controls points; none: at rest.
  [[nodiscard]] Lattice with_pose(std::vector<glm::dvec3> pose) const;

  /// What `visitor` makes of the lattice, which it gets as the type that it is.
  template <class Visitor>
  decltype(auto) visit(const Visitor& visitor) const {
    return std::visit([&](const auto& lattice) -> decltype(auto) { return visitor(*lattice); },
                      lattice_);
  }

  /// The lattice as one type, for operations that only this type has; none if it is another.
  template <class Type>
  [[nodiscard]] const Type* as() const {
    const auto* held = std::get_if<std::shared_ptr<const Type>>(&lattice_);
    return held == nullptr ? nullptr : held->get();
  }

 private:
  std::variant<std::shared_ptr<const SubdivisionLattice>, std::shared_ptr<const TensorLattice>,
               std::shared_ptr<const ThbLattice>>
      lattice_;
};

/// What a file of any type holds: a lattice, or the parts of a subdivision lattice, which may have
/// defects. Throws FileError as read_raw_lattice() and parse_json_tensor().
[[nodiscard]] std::variant<RawLattice, Lattice> read_lattice_parts(const std::string& path);

/// Reads a lattice file of any type: .json, or .ovm for a subdivision lattice. Throws FileError and
/// LatticeError as read_lattice() and parse_json_tensor().
[[nodiscard]] Lattice read_any_lattice(const std::string& path, const Progress& progress = {});

/// Writes a file by its extension; reading it back gives an equal lattice, bit for bit. Throws
/// FileError for a type that the format cannot hold, else as write_lattice() and json_text().
void write_any_lattice(const std::string& path, const Lattice& lattice);

}  // namespace espalier
