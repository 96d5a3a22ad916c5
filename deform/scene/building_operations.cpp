/// Operations that build lattices further, as meshes are modelled: each leaves a valid lattice or
/// changes nothing.

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "deform/scene/element_lists.h"
#include "deform/scene/lattice_parameters.h"
#include "deform/scene/operations.h"
#include "lattice/build/cells.h"
#include "lattice/build/extrude_faces.h"
#include "lattice/build/reshape.h"
#include "lattice/build/split.h"
#include "lattice/build/weld.h"
#include "lattice/core/error.h"
#include "lattice/subdivision/edit.h"
#include "lattice/tensor/placed.h"
#include "lattice/topology/crease.h"

namespace espalier {
namespace {

using Type = ParameterType;
using Indices = std::vector<std::int32_t>;

constexpr std::string_view kModelling = "modelling its cells";

EdgeId edge_in(const CellComplex& complex, const std::array<std::int32_t, 2>& ends) {
  const auto n = static_cast<std::int32_t>(complex.n_vertices());
  const EdgeId edge = ends[0] < n && ends[1] < n
                          ? complex.find_edge(VertexId{ends[0]}, VertexId{ends[1]})
                          : EdgeId{};
  if (!edge.is_valid()) {
    throw ParameterError("there is no edge " + std::to_string(ends[0]) + "-" +
                         std::to_string(ends[1]));
  }
  return edge;
}

// Operations.

using MeshEdit = std::function<Edited(const CellMesh&, const Arguments&)>;

/// An operation from an edit of meshes.
std::function<Scene(const Scene&, const Arguments&, const Progress&)> editing(MeshEdit edit) {
  return [edit = std::move(edit)](const Scene& scene, const Arguments& arguments,
                                  const Progress& progress) {
    const SubdivisionLattice& lattice =
        subdivision_lattice_in(scene, arguments.text("lattice"), kModelling);
    return with_lattice(scene, arguments.text("output"),
                        edited_lattice(lattice, edit(mesh_of(lattice), arguments), progress));
  };
}

Edited extrude(const CellMesh& mesh, const Arguments& arguments) {
  if (arguments.has("by") == arguments.has("normal")) {
    throw ParameterError("'by' or --normal must be given, and not both");
  }
  const Indices faces = indices_of(arguments, "faces");
  const int layers = arguments.integer("layers");
  return arguments.has("by")
             ? extrude_faces_along(mesh, faces, arguments.vector("by"), layers)
             : extrude_faces_outward(mesh, faces, arguments.number("normal"), layers);
}

Edited attach(const CellMesh& mesh, const Arguments& arguments) {
  const Indices faces = indices_of(arguments, "faces");
  const Indices vertices = indices_of(arguments, "vertices");
  return faces.size() == 2 && vertices.empty() ? bridge_faces(mesh, faces[0], faces[1])
                                               : add_spanned_cell(mesh, faces, vertices);
}

double tolerance_of(const Arguments& arguments, const CellMesh& mesh) {
  const double tolerance =
      arguments.has("tolerance") ? arguments.number("tolerance") : usual_tolerance(mesh);
  if (tolerance < 0) {
    throw ParameterError("'tolerance' must be 0 or more");
  }
  return tolerance;
}

Scene merge(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::vector<std::string> names = arguments.texts("lattice");
  if (names.size() < 2) {
    throw ParameterError("lattice: two or more are merged");
  }
  SubdivisionLattice merged = subdivision_lattice_in(scene, names.front(), kModelling);
  for (std::size_t i = 1; i < names.size(); ++i) {
    const SubdivisionLattice& next = subdivision_lattice_in(scene, names[i], kModelling);
    const CellMesh both = side_by_side(mesh_of(merged), mesh_of(next));
    merged = merged_lattice(merged, next, tolerance_of(arguments, both), progress);
  }
  return with_lattice(scene, arguments.text("output"), std::move(merged));
}

Edited delete_elements(const CellMesh& mesh, const Arguments& arguments) {
  Indices cells = indices_of(arguments, "cells");
  const Indices vertices = indices_of(arguments, "vertices");
  if (!vertices.empty()) {
    check_selection(vertices, mesh.points.size(), "delete: vertex");
    const CellComplex complex(mesh.cells);
    for (const std::int32_t vertex : vertices) {
      for (const CellId cell : complex.cells(VertexId{vertex})) {
        cells.push_back(cell.value);
      }
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }
  return delete_cells(mesh, cells);
}

Edited split(const CellMesh& mesh, const Arguments& arguments) {
  const auto edges = edges_of(arguments, "edge");
  if (edges.size() != 1) {
    throw ParameterError("'edge' must be one edge");
  }
  return split_layer(mesh, edges[0][0], edges[0][1], arguments.number("at"));
}

Placement placement_of(const Arguments& arguments) {
  if (!arguments.has("move") && !arguments.has("rotate") && !arguments.has("scale")) {
    throw ParameterError("'move', --rotate or --scale must be given");
  }
  Placement placement;
  placement.about = arguments.vector("about");
  if (arguments.has("scale")) {
    const glm::dvec3 scale = arguments.vector("scale");
    placement.linear = glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
  }
  if (arguments.has("rotate")) {
    placement.linear =
        rotation(arguments.vector("axis"), arguments.number("rotate")) * placement.linear;
  }
  if (arguments.has("move")) {
    placement.by = arguments.vector("move");
  }
  return placement;
}

/// A lattice of any type as a whole, or some vertices of a subdivision lattice.
Scene transform(const Scene& scene, const Arguments& arguments, const Progress& progress) {
  const std::string& name = arguments.text("lattice");
  const std::string& output = arguments.text("output");
  const Placement placement = placement_of(arguments);
  const Lattice& lattice = lattice_in(scene, name);
  if (const auto* tensor = lattice.as<TensorLattice>(); tensor && !arguments.has("vertices")) {
    return with_lattice(scene, output, placed(*tensor, placement));
  }
  if (const auto* thb = lattice.as<ThbLattice>(); thb && !arguments.has("vertices")) {
    return with_lattice(scene, output, placed(*thb, placement));
  }
  const SubdivisionLattice& cells = subdivision_lattice_in(scene, name, "moving some vertices");
  const CellMesh mesh = mesh_of(cells);
  Indices vertices = indices_of(arguments, "vertices");
  if (!arguments.has("vertices")) {
    vertices.resize(mesh.points.size());
    std::iota(vertices.begin(), vertices.end(), 0);
  }
  return with_lattice(scene, output,
                      edited_lattice(cells, placed(mesh, vertices, placement), progress));
}

Scene crease(const Scene& scene, const Arguments& arguments, const Progress&) {
  SubdivisionLattice lattice = subdivision_lattice_in(scene, arguments.text("lattice"), kModelling);
  const CellComplex& complex = *lattice.complex;
  std::vector<EdgeId> edges;
  std::vector<VertexId> vertices;
  for (const auto& ends : edges_of(arguments, "edges")) {
    edges.push_back(edge_in(complex, ends));
  }
  for (const auto& ends : edges_of(arguments, "line")) {
    const std::vector<EdgeId> line = boundary_line(complex, edge_in(complex, ends));
    edges.insert(edges.end(), line.begin(), line.end());
  }
  for (const std::int32_t vertex : indices_of(arguments, "vertices")) {
    check_selection({&vertex, 1}, complex.n_vertices(), "vertex");
    vertices.push_back(VertexId{vertex});
  }
  if (arguments.has("angle")) {
    const Sharpness bent = sharpness_by_angle(complex, lattice.rest, arguments.number("angle"));
    for (const EdgeId edge : complex.edges()) {
      if (bent.edges[edge] > 0) {
        edges.push_back(edge);
      }
    }
  }
  const bool is_selected = arguments.has("edges") || arguments.has("line") ||
                           arguments.has("vertices") || arguments.has("angle");
  if (is_selected == arguments.flag("all")) {
    throw ParameterError("'edges', --line, --vertices and --angle, or --all, must be given");
  }
  if (arguments.flag("all")) {
    std::copy_if(complex.edges().begin(), complex.edges().end(), std::back_inserter(edges),
                 [&](EdgeId edge) { return complex.is_boundary(edge); });
    std::copy_if(complex.vertices().begin(), complex.vertices().end(), std::back_inserter(vertices),
                 [&](VertexId vertex) { return complex.is_boundary(vertex); });
  }
  lattice.sharpness = with_tags(complex, std::move(lattice.sharpness), edges, vertices,
                                static_cast<float>(arguments.number("sharpness")));
  return with_lattice(scene, arguments.text("output"), std::move(lattice));
}

// The table.

Parameter lattice_parameter() {
  return {.name = "lattice",
          .type = Type::Lattice,
          .help = "the lattice to change",
          .is_required = true,
          .is_positional = true};
}

Parameter list_parameter(const char* name, const char* help, bool is_required = false) {
  return {.name = name, .type = Type::Text, .help = help, .is_required = is_required};
}

Parameter vector_parameter(const char* name, const char* help) {
  return {.name = name, .type = Type::Numbers, .help = help, .count = 3};
}

Parameter vector_parameter(const char* name, const char* help, std::vector<double> fallback) {
  Parameter parameter = vector_parameter(name, help);
  parameter.fallback = Value(std::move(fallback));
  return parameter;
}

Parameter tolerance_parameter() {
  return {.name = "tolerance",
          .type = Type::Number,
          .help = "how far apart one place may be, model units (default 1e-6 of the diagonal)"};
}

std::vector<Operation> growing_operations() {
  return {
      {"extrude",
       "Grow cells from faces of a lattice, or insert them between cells",
       {lattice_parameter(),
        list_parameter("faces", "such as 0,3,7-9", true),
        vector_parameter("by", "direction and length dx dy dz"),
        {.name = "normal",
         .type = Type::Number,
         .help = "length along the faces' normals, instead of --by"},
        {.name = "layers",
         .type = Type::Integer,
         .help = "cells along the way (default 1)",
         .fallback = Value(std::int64_t{1})},
        result_parameter("the larger lattice")},
       editing(extrude)},
      {"attach",
       "Add a cell: a bridge between two faces of equal size, or what faces and vertices span",
       {lattice_parameter(), list_parameter("faces", "boundary faces, such as 0,3; two: a bridge"),
        list_parameter("vertices", "such as 0,3,7-9"), result_parameter("the larger lattice")},
       editing(attach)},
      {"split",
       "Split the layer of cells that an edge crosses in two",
       {lattice_parameter(),
        list_parameter("edge", "by its vertices, such as 0-4", true),
        {.name = "at",
         .type = Type::Number,
         .help = "where, as a fraction from the edge's first vertex (default 0.5)",
         .fallback = Value(0.5)},
        result_parameter("the finer lattice")},
       editing(split)},
      {"delete",
       "Take cells away",
       {lattice_parameter(), list_parameter("cells", "such as 0,3,7-9"),
        list_parameter("vertices", "the same: all cells at them"),
        result_parameter("the smaller lattice")},
       editing(delete_elements)},
  };
}

std::vector<Operation> joining_operations() {
  Parameter lattices = lattice_parameter();
  lattices.is_list = true;
  lattices.help = "two or more lattices; the first one's scheme is kept";
  return {
      {"merge",
       "Put lattices together, sharing the vertices and faces that coincide",
       {lattices, tolerance_parameter(), result_parameter("the lattice of all")},
       merge},
      {"weld",
       "Make vertices that coincide one, and cells that touch neighbours",
       {lattice_parameter(), tolerance_parameter(), result_parameter("the welded lattice")},
       editing([](const CellMesh& mesh, const Arguments& arguments) {
         return weld(mesh, tolerance_of(arguments, mesh));
       })},
      {"mirror",
       "Add a lattice's mirror image, welded at the plane",
       {lattice_parameter(), vector_parameter("point", "of the plane (default 0 0 0)", {0, 0, 0}),
        vector_parameter("across", "the plane's normal (default 1 0 0)", {1, 0, 0}),
        tolerance_parameter(), result_parameter("the lattice of both halves")},
       editing([](const CellMesh& mesh, const Arguments& arguments) {
         return mirror(mesh, arguments.vector("point"), arguments.vector("across"),
                       tolerance_of(arguments, mesh));
       })},
  };
}

std::vector<Operation> shaping_operations() {
  return {
      {"transform",
       "Scale, rotate and move a lattice, its pose too, or some of its vertices, in this order",
       {lattice_parameter(),
        list_parameter("vertices", "of a subdivision lattice, such as 0,3,7-9 (default: all)"),
        vector_parameter("move", "by dx dy dz, model units"),
        {.name = "rotate", .type = Type::Number, .help = "by an angle in degrees"},
        vector_parameter("axis", "to rotate about (default 0 0 1)", {0, 0, 1}),
        vector_parameter("scale", "factors along x y z"),
        vector_parameter("about", "what rotating and scaling keep (default 0 0 0)", {0, 0, 0}),
        result_parameter("the lattice")},
       transform},
      {"relax",
       "Even out the inner vertices of a lattice; its boundary stays",
       {lattice_parameter(),
        {.name = "steps",
         .type = Type::Integer,
         .help = "how often they move to the mean of their neighbours (default 10)",
         .fallback = Value(std::int64_t{10})},
        result_parameter("the lattice")},
       editing([](const CellMesh& mesh, const Arguments& arguments) {
         return relaxed(mesh, arguments.integer("steps"));
       })},
      {"crease",
       "Mark or clear sharp edges and vertices",
       {lattice_parameter(),
        list_parameter("edges", "by their vertices, such as 0-1,4-5"),
        list_parameter("line", "the same: whole lines of edges through them"),
        list_parameter("vertices", "such as 0,3,7-9"),
        {.name = "angle",
         .type = Type::Number,
         .help = "edges where the boundary bends by more degrees"},
        {.name = "all", .type = Type::Flag, .help = "all edges and vertices of the boundary"},
        {.name = "sharpness",
         .type = Type::Number,
         .help = "0 smooth, from 10 infinitely sharp (default 10)",
         .fallback = Value(10.0)},
        result_parameter("the lattice")},
       crease},
  };
}

}  // namespace

std::vector<Operation> building_operations() {
  std::vector<Operation> operations;
  for (auto part : {growing_operations(), joining_operations(), shaping_operations()}) {
    std::move(part.begin(), part.end(), std::back_inserter(operations));
  }
  return operations;
}

}  // namespace espalier
