/// Grids for VTK, format version 2.1: the first whose edges along w are numbered round the cell.

#include "lattice/io/vtu_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "lattice/core/error.h"
#include "lattice/topology/hexahedron.h"

namespace espalier {
namespace {

constexpr std::uint8_t kVtkVertex = 1;
constexpr std::uint8_t kVtkLine = 3;
constexpr std::uint8_t kVtkQuad = 9;
constexpr std::uint8_t kVtkHexahedron = 12;
constexpr std::uint8_t kVtkPolyhedron = 42;
constexpr std::uint8_t kVtkBezierHexahedron = 79;

/// A corner of a square, anticlockwise.
constexpr std::array<std::array<int, 2>, 4> kRound = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
/// Our corners of a hexahedron in VTK's order.
constexpr std::array<std::size_t, 8> kVtkCorners = {0, 1, 3, 2, 4, 5, 7, 6};

void append_base64(std::string& text, std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (k < n ? bytes[i + k] : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= n ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
}

template <class T>
constexpr std::string_view vtk_name();
template <>
constexpr std::string_view vtk_name<double>() {
  return "Float64";
}
template <>
constexpr std::string_view vtk_name<std::int64_t>() {
  return "Int64";
}
template <>
constexpr std::string_view vtk_name<std::int32_t>() {
  return "Int32";
}
template <>
constexpr std::string_view vtk_name<std::uint8_t>() {
  return "UInt8";
}

/// A DataArray: the length of the data in bytes and the data, both in one base64 text.
template <class T>
void append_array(std::string& text, std::string_view name, std::size_t n_components,
                  std::span<const T> values) {
  const std::uint64_t n_bytes = values.size_bytes();
  std::vector<std::uint8_t> bytes(sizeof n_bytes + n_bytes);
  std::memcpy(bytes.data(), &n_bytes, sizeof n_bytes);
  if (n_bytes > 0) {
    std::memcpy(bytes.data() + sizeof n_bytes, values.data(), n_bytes);
  }
  text += fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">)",
                      vtk_name<T>(), name, n_components);
  append_base64(text, bytes);
  text += "</DataArray>\n";
}

template <class T>
void append_array(std::string& text, std::string_view name, const std::vector<T>& values) {
  append_array(text, name, 1, std::span<const T>(values));
}

/// What a file holds. Empty arrays that VTK does not ask for are left out.
struct Grid {
  std::vector<glm::dvec3> points;
  std::vector<double> weights;  ///< #points, or empty
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;  ///< ends of the cells in `connectivity`
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> degrees;       ///< three a cell, or empty
  std::vector<std::int32_t> levels;        ///< one a cell, or empty
  std::vector<std::int64_t> faces;         ///< of a polyhedron: how many, then each with its length
  std::vector<std::int64_t> face_offsets;  ///< ends of the cells in `faces`, -1 for other cells
};

std::string text_of(const Grid& grid) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"2.1\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", grid.points.size(),
      grid.types.size());
  if (!grid.weights.empty()) {
    text += "<PointData RationalWeights=\"RationalWeights\">\n";
    append_array(text, "RationalWeights", grid.weights);
    text += "</PointData>\n";
  }
  if (!grid.degrees.empty()) {
    text += "<CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n";
    append_array(text, "HigherOrderDegrees", 3, std::span<const std::int32_t>(grid.degrees));
    text += "</CellData>\n";
  }
  if (!grid.levels.empty()) {
    text += "<CellData Scalars=\"Level\">\n";
    append_array(text, "Level", grid.levels);
    text += "</CellData>\n";
  }
  text += "<Points>\n";
  const double* coordinates = grid.points.empty() ? nullptr : glm::value_ptr(grid.points.front());
  append_array(text, "Points", 3, std::span<const double>(coordinates, 3 * grid.points.size()));
  text += "</Points>\n<Cells>\n";
  append_array(text, "connectivity", grid.connectivity);
  append_array(text, "offsets", grid.offsets);
  append_array(text, "types", grid.types);
  if (!grid.faces.empty()) {
    append_array(text, "faces", grid.faces);
    append_array(text, "faceoffsets", grid.face_offsets);
  }
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return text;
}

/// A point with its weight, as bits.
using PointBits = std::array<std::uint64_t, 4>;

struct PointBitsHash {
  std::size_t operator()(const PointBits& bits) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : bits) {
      hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// The points of a grid, each once.
class PointMerger {
 public:
  explicit PointMerger(Grid& grid) : grid_(&grid) {}

  /// The index of a point; weight: of a rational grid.
  std::int64_t add(const glm::dvec3& point, std::optional<double> weight) {
    const auto bits_of = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // no -0
    const PointBits bits = {bits_of(point.x), bits_of(point.y), bits_of(point.z),
                            bits_of(weight.value_or(1))};
    const auto n = static_cast<std::int64_t>(grid_->points.size());
    const auto [found, is_new] = indices_.try_emplace(bits, n);
    if (is_new) {
      grid_->points.push_back(point);
      if (weight) {
        grid_->weights.push_back(*weight);
      }
    }
    return found->second;
  }

 private:
  Grid* grid_;
  std::unordered_map<PointBits, std::int64_t, PointBitsHash> indices_;
};

void require_count(std::size_t n, std::size_t n_wanted, std::string_view what,
                   std::string_view owner) {
  if (n != n_wanted) {
    throw ParameterError(fmt::format("{} {} were given, the {} has {}", n, what, owner, n_wanted));
  }
}

void require_positive(std::span<const double> weights) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) {
      throw ParameterError(fmt::format("weight {} is {}, must be positive", i, weights[i]));
    }
  }
}

void append_hexahedron(Grid& grid, const Hexahedron& cell) {
  for (const std::size_t corner : kVtkCorners) {
    grid.connectivity.push_back(cell.corners[corner].value);
  }
  grid.types.push_back(kVtkHexahedron);
  grid.face_offsets.push_back(-1);
}

void append_polyhedron(Grid& grid, const CellComplex& complex, CellId cell) {
  for (const VertexId vertex : complex.vertices(cell)) {
    grid.connectivity.push_back(vertex.value);
  }
  const auto sides = complex.half_faces(cell);
  grid.faces.push_back(static_cast<std::int64_t>(sides.size()));
  for (const HalfFaceId side : sides) {
    const std::vector<VertexId> vertices = loop(complex, side);
    grid.faces.push_back(static_cast<std::int64_t>(vertices.size()));
    for (const VertexId vertex : vertices) {
      grid.faces.push_back(vertex.value);
    }
  }
  grid.types.push_back(kVtkPolyhedron);
  grid.face_offsets.push_back(static_cast<std::int64_t>(grid.faces.size()));
}

}  // namespace

std::vector<std::int32_t> vtk_point_order(const std::array<int, 3>& degree) {
  const auto [p, q, r] = degree;
  assert(p > 0 && q > 0 && r > 0);
  std::vector<std::int32_t> order;
  const auto add = [&, p = p, q = q](int i, int j, int k) {
    order.push_back(i + (p + 1) * (j + (q + 1) * k));
  };
  for (const int k : {0, r}) {
    for (const auto& [a, b] : kRound) {
      add(a * p, b * q, k);
    }
  }
  const auto edge_u = [&, p = p](int j, int k) {
    for (int i = 1; i < p; ++i) {
      add(i, j, k);
    }
  };
  const auto edge_v = [&, q = q](int i, int k) {
    for (int j = 1; j < q; ++j) {
      add(i, j, k);
    }
  };
  for (const int k : {0, r}) {
    edge_u(0, k);
    edge_v(p, k);
    edge_u(q, k);
    edge_v(0, k);
  }
  for (const auto& [a, b] : kRound) {
    for (int k = 1; k < r; ++k) {
      add(a * p, b * q, k);
    }
  }
  for (const int i : {0, p}) {
    for (int k = 1; k < r; ++k) {
      edge_v(i, k);
    }
  }
  for (const int j : {0, q}) {
    for (int k = 1; k < r; ++k) {
      edge_u(j, k);
    }
  }
  const auto layer = [&, q = q](int k) {
    for (int j = 1; j < q; ++j) {
      edge_u(j, k);
    }
  };
  layer(0);
  layer(r);
  for (int k = 1; k < r; ++k) {
    layer(k);
  }
  return order;
}

std::string vtu_text(const Volume& volume, std::span<const glm::dvec3> points,
                     std::span<const double> weights) {
  require_count(points.size(), volume.n_points(), "points", "volume");
  if (weights.empty()) {
    weights = volume.weights();
  } else {
    require_count(weights.size(), volume.n_points(), "weights", "volume");
    require_positive(weights);
  }
  Grid grid;
  PointMerger merger(grid);
  BezierPatch patch;
  std::array<int, 3> degree{};
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    volume.bezier(i, points, weights, patch);
    if (patch.degree != degree) {
      degree = patch.degree;
      order = vtk_point_order(degree);
    }
    for (const std::int32_t place : order) {
      const auto at = static_cast<std::size_t>(place);
      const auto weight = weights.empty() ? std::nullopt : std::optional(patch.weights[at]);
      grid.connectivity.push_back(merger.add(patch.view().position(at), weight));
    }
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.types.push_back(kVtkBezierHexahedron);
    grid.degrees.insert(grid.degrees.end(), degree.begin(), degree.end());
  }
  return text_of(grid);
}

std::string vtu_text(const CellComplex& complex, std::span<const glm::dvec3> points) {
  require_count(points.size(), complex.n_vertices(), "points", "lattice");
  Grid grid;
  grid.points.assign(points.begin(), points.end());
  for (const CellId cell : complex.cells()) {
    if (const auto as_hexahedron = hexahedron(complex, cell)) {
      append_hexahedron(grid, *as_hexahedron);
    } else {
      append_polyhedron(grid, complex, cell);
    }
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
  }
  return text_of(grid);
}

std::string vtu_text(const ControlNet& net, std::span<const glm::dvec3> points) {
  Grid grid;
  grid.points.assign(points.begin(), points.end());
  grid.levels = net.levels;
  for (std::size_t i = 0; i < net.cells.n_rows(); ++i) {
    const std::span<const std::int32_t> corners = net.cells[i];
    for (std::size_t n = 0; n < corners.size(); ++n) {
      // Two of the corners along v are the other way round in VTK, which goes round a face.
      grid.connectivity.push_back(corners[corners.size() > 2 ? kVtkCorners[n] : n]);
    }
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.types.push_back(corners.size() == 8   ? kVtkHexahedron
                         : corners.size() == 4 ? kVtkQuad
                         : corners.size() == 2 ? kVtkLine
                                               : kVtkVertex);
  }
  return text_of(grid);
}

bool is_vtu_path(const std::string& path) {
  std::string end = path.substr(path.size() - std::min<std::size_t>(4, path.size()));
  for (char& c : end) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return end == ".vtu";
}

}  // namespace espalier
