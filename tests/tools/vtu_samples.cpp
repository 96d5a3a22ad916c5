/// vtu_samples FOLDER: volumes as .vtu files, and beside each a .csv of places in them, as this
/// library evaluates them, for another reader to compare: cell, degrees, u, v, w, x, y, z.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <iterator>
#include <numeric>
#include <string>

#include "lattice/core/file.h"
#include "lattice/io/vtu_writer.h"
#include "lattice/subdivision/freeze.h"
#include "lattice/tensor/thb_lattice.h"
#include "tests/support/families.h"

namespace espalier::test {
namespace {

/// Some places on corners, edges and faces, and some inside.
std::vector<glm::dvec3> places() {
  std::vector<glm::dvec3> result;
  for (const double w : {0.0, 0.3125, 1.0}) {
    for (const double v : {0.0, 0.6875, 1.0}) {
      for (const double u : {0.0, 0.4375, 1.0}) {
        result.emplace_back(u, v, w);
      }
    }
  }
  result.emplace_back(0.1, 0.2, 0.3);
  result.emplace_back(0.9, 0.7, 0.8);
  return result;
}

/// Up to 200 cells spread over the volume; weights: empty for the volume's own.
void write_samples(const std::string& stem, const Volume& volume,
                   std::span<const glm::dvec3> points, std::span<const double> weights = {}) {
  write_file(stem + ".vtu", vtu_text(volume, points, weights));
  std::vector<glm::dvec3> numerators(points.begin(), points.end());
  std::vector<glm::dvec3> denominators(points.size(), glm::dvec3(1));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    numerators[i] *= weights[i];
    denominators[i] *= weights[i];
  }
  std::string text = "cell,p,q,r,u,v,w,x,y,z\n";
  const std::size_t step = 1 + volume.n_patches() / 200;
  for (std::size_t i = 0; i < volume.n_patches(); i += step) {
    const auto [p, q, r] = volume.degree(i);
    const BezierPatch numerator = volume.bezier(i, numerators);
    const BezierPatch denominator = volume.bezier(i, denominators);
    for (const glm::dvec3& uvw : places()) {
      const glm::dvec3 x = numerator.value(uvw) / denominator.value(uvw);
      fmt::format_to(std::back_inserter(text),
                     "{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", i, p, q, r,
                     uvw.x, uvw.y, uvw.z, x.x, x.y, x.z);
    }
  }
  write_file(stem + ".csv", text);
}

/// One patch of any degree, its points a bent and jittered grid.
Volume single_patch(const std::array<int, 3>& degree) {
  VolumeTables tables;
  Patch patch;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    tables.extractions.push_back(bezier_extraction(degree[axis]));
    patch.extractions[axis] = static_cast<std::uint16_t>(axis);
  }
  tables.patches = {patch};
  std::vector<glm::dvec3> points;
  for (int k = 0; k <= degree[2]; ++k) {
    for (int j = 0; j <= degree[1]; ++j) {
      for (int i = 0; i <= degree[0]; ++i) {
        points.emplace_back(i + 0.1 * j * k, 2 * j - 0.2 * i, 3 * k + 0.3 * i * j);
      }
    }
  }
  points = jittered(points, 0.2, 5);
  std::vector<std::int32_t> block(points.size());
  std::iota(block.begin(), block.end(), 0);
  tables.blocks = CompressedRows<std::int32_t>::uniform(block.size(), block);
  tables.stencils = StencilTable::build(
      points.size(), points.size(),
      [](std::size_t i, StencilRow& row) { row.add(static_cast<std::int32_t>(i), 1); });
  return {std::move(tables), std::move(points)};
}

/// Lattices on grids of knots: with weights, round a ring, in a plane, and of several levels.
void write_tensor_lattices(const std::string& folder) {
  const TensorAxis open = TensorAxis::make(5, 3, Ends::Open);
  const TensorAxis ring = TensorAxis::make(6, 3, Ends::Periodic);
  const TensorAxis natural = TensorAxis::make(4, 3, Ends::Natural);
  const auto write = [&](const std::string& name, TensorLattice lattice) {
    for (std::size_t i = 0; i < lattice.weights.size(); ++i) {
      lattice.weights[i] = 1 + 0.5 * std::sin(static_cast<double>(i));
    }
    const Volume volume = freeze(lattice);
    write_samples(fmt::format("{}/{}", folder, name), volume,
                  volume.points(jittered(lattice.rest, 0.05, 11)));
  };
  write("bspline_ring", make_tensor_lattice(TensorKind::BSpline, {ring, open, natural}, {}));
  write("bspline_plane", make_tensor_lattice(TensorKind::BSpline, {open, open, TensorAxis()}, {}));
  write("nurbs_rational", make_tensor_lattice(TensorKind::Nurbs, {open, natural, open}, {}));
  ThbLattice thb = make_thb_lattice({5, 5, 5}, {3, 2, 1}, {});
  thb = with_cells(thb, 1, cells_of_box(*thb.hierarchy, 1, glm::dvec3(0), {1, 1, 0.5}));
  thb = with_cells(thb, 2, cells_of_box(*thb.hierarchy, 2, glm::dvec3(0), {0.5, 0.5, 0.5}));
  const Volume volume = freeze(thb);
  write_samples(folder + "/thb", volume, volume.points(jittered(thb.rest, 0.03, 12)));
}

void write_all(const std::string& folder) {
  write_tensor_lattices(folder);
  for (const int valence : {3, 5}) {
    const SubdivisionLattice lattice = prism(flower_section(valence), 3);
    const std::vector<glm::dvec3> pose = jittered(lattice.rest, 0.2, 7);
    const std::string stem = fmt::format("{}/flower{}", folder, valence);
    const Volume adaptive = freeze_adaptive(lattice);
    write_samples(stem + "_adaptive", adaptive, adaptive.points(pose));
    const Volume uniform = freeze_uniform(lattice, 1);
    write_samples(stem + "_uniform", uniform, uniform.points(pose));
  }
  const SubdivisionLattice lattice = pyramid_on_cube();
  const Volume volume = freeze_uniform(lattice, 1);
  write_samples(folder + "/pyramid", volume, volume.points(jittered(lattice.rest, 0.1, 9)));
  for (const auto& degree : {std::array{1, 2, 4}, std::array{4, 1, 3}, std::array{3, 5, 2}}) {
    const Volume patch = single_patch(degree);
    const auto name = fmt::format("{}/degree{}{}{}", folder, degree[0], degree[1], degree[2]);
    write_samples(name, patch, patch.rest_points());
    std::vector<double> weights;
    for (std::size_t i = 0; i < patch.n_points(); ++i) {
      weights.push_back(1 + 0.5 * std::sin(static_cast<double>(i)));
    }
    write_samples(name + "_rational", patch, patch.rest_points(), weights);
  }
}

}  // namespace
}  // namespace espalier::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: vtu_samples FOLDER\n", stderr);
    return 2;
  }
  try {
    espalier::test::write_all(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vtu_samples: %s\n", error.what());
    return 1;
  }
  return 0;
}
