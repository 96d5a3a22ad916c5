#include "deform/scene/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "lattice/core/error.h"

namespace espalier {
namespace {

/// The vertices of every cell, cells sorted: what a lattice and its pose must have in common.
std::vector<std::vector<VertexId>> sorted_cells(const CellComplex& complex) {
  std::vector<std::vector<VertexId>> cells;
  cells.reserve(complex.n_cells());
  for (const CellId cell : complex.cells()) {
    const auto vertices = complex.vertices(cell);
    cells.emplace_back(vertices.begin(), vertices.end());
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::string text_of(const std::array<int, 3>& numbers) {
  return fmt::format("{} {} {}", numbers[0], numbers[1], numbers[2]);
}

std::array<int, 3> degrees_of(const TensorLattice& lattice) {
  return {lattice.axes[0].degree(), lattice.axes[1].degree(), lattice.axes[2].degree()};
}

/// Compares lattices of all types with the poses meant for them; names begin the errors.
struct Comparison {
  const std::string& lattice_name;
  const std::string& pose_name;

  void operator()(const SubdivisionLattice& lattice, const CellComplex& pose) const {
    const CellComplex& complex = *lattice.complex;
    if (complex.n_vertices() != pose.n_vertices() || complex.n_cells() != pose.n_cells()) {
      fail(fmt::format("has {} vertices and {} cells, the lattice {} has {} and {}",
                       pose.n_vertices(), pose.n_cells(), lattice_name, complex.n_vertices(),
                       complex.n_cells()));
    }
    if (sorted_cells(complex) != sorted_cells(pose)) {
      fail("its cells are not those of the lattice " + lattice_name);
    }
  }

  void operator()(const TensorLattice& lattice, const TensorLattice& pose) const {
    if (lattice.kind != pose.kind) {
      fail_type(name_of(pose.kind), name_of(lattice.kind));
    }
    require_same_counts("control points", lattice.counts(), pose.counts());
    require_same_counts("degree", degrees_of(lattice), degrees_of(pose));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(lattice.axes[axis] == pose.axes[axis])) {
        fail(fmt::format("its ends or knots along {} are not those of the lattice {}", "uvw"[axis],
                         lattice_name));
      }
    }
  }

  void operator()(const ThbLattice& lattice, const ThbLattice& pose) const {
    require_same_counts("control points on level 0", lattice.hierarchy->counts(),
                        pose.hierarchy->counts());
    require_same_counts("degree", lattice.hierarchy->degree(), pose.hierarchy->degree());
    if (lattice.hierarchy->domains() != pose.hierarchy->domains()) {
      fail("its levels are not refined where those of the lattice " + lattice_name + " are");
    }
  }

  /// Of different types.
  template <class Rest, class Posed>
  void operator()(const Rest& lattice, const Posed& pose) const {
    fail_type(type_of(pose), Lattice(lattice).type());
  }

 private:
  [[nodiscard]] static std::string_view type_of(const CellComplex&) { return "subdivision"; }
  template <class Posed>
  [[nodiscard]] static std::string type_of(const Posed& pose) {
    return std::string(Lattice(pose).type());
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw LatticeError(pose_name + ": " + what);
  }
  [[noreturn]] void fail_type(std::string_view pose, std::string_view lattice) const {
    fail(fmt::format("is a {} lattice, the lattice {} is of type {}", pose, lattice_name, lattice));
  }
  void require_same_counts(std::string_view what, const std::array<int, 3>& lattice,
                           const std::array<int, 3>& pose) const {
    if (lattice != pose) {
      fail(fmt::format("has {} {}, the lattice {} has {}", what, text_of(pose), lattice_name,
                       text_of(lattice)));
    }
  }
};

/// The weights of a pose, if they are not those at rest.
std::vector<double> changed_weights(const TensorLattice& rest, const TensorLattice& pose) {
  const std::span<const double> posed = pose.posed_weights();
  return std::ranges::equal(rest.weights, posed) ? std::vector<double>()
                                                 : std::vector<double>(posed.begin(), posed.end());
}

std::vector<glm::dvec3> points_of(std::span<const glm::dvec3> points) {
  return {points.begin(), points.end()};
}

}  // namespace

Pose read_pose(const std::string& path) {
  std::variant<RawLattice, Lattice> parts = read_lattice_parts(path);
  if (auto* raw = std::get_if<RawLattice>(&parts)) {
    try {
      return {CellComplex(std::move(raw->polyhedra)), raw->pose.empty() ? raw->rest : raw->pose};
    } catch (const LatticeError& error) {
      throw LatticeError(path + ": " + error.what());
    }
  }
  const auto& lattice = std::get<Lattice>(parts);
  Pose pose{ThbLattice(), points_of(lattice.posed_points())};
  if (const auto* tensor = lattice.as<TensorLattice>()) {
    pose.lattice = *tensor;
  } else {
    pose.lattice = *lattice.as<ThbLattice>();
  }
  return pose;
}

ControlPose own_pose(const Lattice& lattice) {
  const auto* tensor = lattice.as<TensorLattice>();
  return {points_of(lattice.posed_points()),
          tensor == nullptr ? std::vector<double>() : changed_weights(*tensor, *tensor)};
}

std::vector<glm::dvec3> posed_controls(const std::string& name, const Lattice& lattice) {
  ControlPose pose = own_pose(lattice);
  if (!pose.weights.empty()) {
    throw LatticeError(name +
                       ": its pose_weights are not its weights at rest, which is for deform, "
                       "eval and check only");
  }
  return std::move(pose.points);
}

ControlPose pose_for(const Scene& scene, const std::string& lattice, const std::string& pose) {
  const Pose& found = pose_in(scene, pose);
  const Lattice& at_rest = lattice_in(scene, lattice);
  at_rest.visit([&](const auto& rest) {
    std::visit([&](const auto& posed) { Comparison{lattice, pose}(rest, posed); }, found.lattice);
  });
  const auto* rest = at_rest.as<TensorLattice>();
  const auto* posed = std::get_if<TensorLattice>(&found.lattice);
  return {found.points, rest != nullptr && posed != nullptr ? changed_weights(*rest, *posed)
                                                            : std::vector<double>()};
}

}  // namespace espalier
