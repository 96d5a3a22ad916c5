#include "lattice/topology/sharpness.h"

#include <gtest/gtest.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <memory>

#include "lattice/core/error.h"
#include "tests/lattice/shapes.h"

namespace espalier {
namespace {

using shapes::Shape;

std::ptrdiff_t n_sharp(const auto& values) {
  return std::count(values.begin(), values.end(), kInfiniteSharpness);
}

EdgeId edge(const CellComplex& complex, int a, int b) {
  return complex.find_edge(VertexId{a}, VertexId{b});
}

TEST(AutomaticSharpness, makes_the_borders_and_corners_of_a_cube_grid_sharp) {
  const CellComplex complex(shapes::box_grid(2, 3, 4).polyhedra);
  const Sharpness sharpness = automatic_sharpness(complex);
  EXPECT_EQ(n_sharp(sharpness.edges), 4 * (2 + 3 + 4));
  EXPECT_EQ(n_sharp(sharpness.vertices), 8);
  EXPECT_EQ(sharpness.edges[edge(complex, 0, 1)], kInfiniteSharpness);
  EXPECT_EQ(sharpness.edges[edge(complex, 1, 4)], 0);
  EXPECT_EQ(sharpness.vertices[VertexId{0}], kInfiniteSharpness);
  EXPECT_EQ(sharpness.vertices[VertexId{1}], 0);
}

TEST(AutomaticSharpness, keeps_the_side_of_a_one_layer_cylinder_round) {
  const CellComplex complex(shapes::wedge_cylinder(6).polyhedra);
  const Sharpness sharpness = automatic_sharpness(complex);
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    EXPECT_EQ(sharpness.edges[edge(complex, 2 + 2 * i, 3 + 2 * i)], 0) << "on the side";
    EXPECT_EQ(sharpness.edges[edge(complex, 2 + 2 * i, 2 + 2 * next)], kInfiniteSharpness);
    EXPECT_EQ(sharpness.edges[edge(complex, 3 + 2 * i, 3 + 2 * next)], kInfiniteSharpness);
    EXPECT_EQ(sharpness.edges[edge(complex, 0, 2 + 2 * i)], 0) << "on the end";
  }
  EXPECT_EQ(n_sharp(sharpness.vertices), 0);
}

TEST(AutomaticSharpness, makes_a_lone_cell_sharp_everywhere) {
  const CellComplex complex(shapes::tetrahedron().polyhedra);
  const Sharpness sharpness = automatic_sharpness(complex);
  EXPECT_EQ(n_sharp(sharpness.edges), 6);
  EXPECT_EQ(n_sharp(sharpness.vertices), 4);
}

TEST(SharpnessByAngle, makes_edges_sharp_that_bend_by_more) {
  const Shape grid = shapes::box_grid(2, 2, 2);
  const CellComplex complex(grid.polyhedra);
  EXPECT_EQ(sharpness_by_angle(complex, grid.points, 89).edges, automatic_sharpness(complex).edges);
  EXPECT_EQ(n_sharp(sharpness_by_angle(complex, grid.points, 89).vertices), 8);
  EXPECT_EQ(sharpness_by_angle(complex, grid.points, 90), smooth_sharpness(complex));

  const Shape cylinder = shapes::wedge_cylinder(6);  // its side bends by 60 degrees
  const CellComplex wedges(cylinder.polyhedra);
  EXPECT_EQ(n_sharp(sharpness_by_angle(wedges, cylinder.points, 59).edges), 18);
  EXPECT_EQ(n_sharp(sharpness_by_angle(wedges, cylinder.points, 61).edges), 12);
}

TEST(SharpnessByAngle, makes_edges_sharp_where_cells_only_touch) {
  const Shape columns = shapes::columns_sharing_a_line(1);
  const CellComplex complex(columns.polyhedra);
  const Sharpness sharpness = sharpness_by_angle(complex, columns.points, 180);
  EXPECT_EQ(n_sharp(sharpness.edges), 1);
  EXPECT_EQ(sharpness.edges[edge(complex, 0, 7)], kInfiniteSharpness);
}

TEST(SharpnessByAngle, refuses_what_is_no_angle) {
  const Shape cube = shapes::cube();
  const CellComplex complex(cube.polyhedra);
  for (const double bad : {-1.0, 181.0, std::nan("")}) {
    EXPECT_THROW((void)sharpness_by_angle(complex, cube.points, bad), ParameterError);
  }
}

TEST(TouchingElements, leave_a_manifold_boundary_as_it_is) {
  for (const Shape& shape : {shapes::box_grid(2, 2, 2), shapes::wedge_cylinder(5)}) {
    const CellComplex complex(shape.polyhedra);
    EXPECT_EQ(with_touching_elements(complex, smooth_sharpness(complex)),
              smooth_sharpness(complex));
  }
}

TEST(TouchingElements, are_sharp_where_two_cubes_share_a_vertex) {
  const CellComplex complex(shapes::cubes_sharing_a_vertex().polyhedra);
  const Sharpness sharpness = with_touching_elements(complex, smooth_sharpness(complex));
  EXPECT_EQ(n_sharp(sharpness.edges), 0);
  EXPECT_EQ(n_sharp(sharpness.vertices), 1);
  EXPECT_EQ(sharpness.vertices[VertexId{0}], kInfiniteSharpness);
}

TEST(TouchingElements, are_sharp_along_a_shared_line_but_for_vertices_inside_it) {
  const CellComplex complex(shapes::columns_sharing_a_line(3).polyhedra);
  const Sharpness sharpness = with_touching_elements(complex, smooth_sharpness(complex));
  EXPECT_EQ(n_sharp(sharpness.edges), 3);
  EXPECT_EQ(n_sharp(sharpness.vertices), 2);
  EXPECT_EQ(sharpness.vertices[VertexId{0}], kInfiniteSharpness);
  EXPECT_EQ(sharpness.vertices[VertexId{7}], 0) << "the crease rule applies";
  EXPECT_EQ(sharpness.vertices[VertexId{21}], kInfiniteSharpness);
}

/// OpenSubdiv's own view of a boundary without tags.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_of_boundary(const CellComplex& complex) {
  namespace Far = OpenSubdiv::Far;
  namespace Sdc = OpenSubdiv::Sdc;
  std::vector<int> sizes;
  std::vector<int> vertices;
  for (const FaceId face : complex.faces()) {
    if (complex.is_boundary(face)) {
      std::vector<VertexId> loop(complex.vertices(face).begin(), complex.vertices(face).end());
      if (complex.inner_half_face(face).side() == 1) {
        std::reverse(loop.begin(), loop.end());
      }
      sizes.push_back(static_cast<int>(loop.size()));
      for (const VertexId vertex : loop) {
        vertices.push_back(vertex.value);
      }
    }
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(complex.n_vertices());
  descriptor.numFaces = static_cast<int>(sizes.size());
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = vertices.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return std::unique_ptr<Far::TopologyRefiner>(
      Factory::Create(descriptor, {Sdc::SCHEME_CATMARK, options}));
}

TEST(TouchingElements, are_sharp_exactly_where_OpenSubdiv_makes_them_so) {
  for (const Shape& shape : {shapes::cubes_sharing_a_vertex(), shapes::columns_sharing_a_line(1),
                             shapes::columns_sharing_a_line(3), shapes::box_grid(2, 2, 1)}) {
    const CellComplex complex(shape.polyhedra);
    const Sharpness ours = with_touching_elements(complex, smooth_sharpness(complex));
    const auto refiner = refiner_of_boundary(complex);
    const auto level = refiner->GetLevel(0);
    for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
      EXPECT_EQ(ours.vertices[VertexId{vertex}], level.GetVertexSharpness(vertex)) << vertex;
    }
    for (int i = 0; i < level.GetNumEdges(); ++i) {
      const auto ends = level.GetEdgeVertices(i);
      EXPECT_EQ(ours.edges[edge(complex, ends[0], ends[1])], level.GetEdgeSharpness(i));
    }
  }
}

}  // namespace
}  // namespace espalier
