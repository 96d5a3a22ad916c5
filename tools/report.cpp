#include "tools/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "lattice/core/box.h"
#include "lattice/topology/corner_check.h"
#include "lattice/topology/sharpness.h"
#include "lattice/topology/validate.h"

namespace espalier::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kDefectsShown = 20;

Json to_json(const glm::dvec3& point) {
  return Json::array({point.x, point.y, point.z});
}

/// How often each number occurs, as an object with the numbers as keys.
Json histogram(const std::map<std::size_t, std::size_t>& counts) {
  Json object = Json::object();
  for (const auto& [number, count] : counts) {
    object[std::to_string(number)] = count;
  }
  return object;
}

void add_bounds(Json& json, std::span<const glm::dvec3> points) {
  const Box bounds = box_of(points);
  json["min"] = points.empty() ? Json() : to_json(bounds.min);
  json["max"] = points.empty() ? Json() : to_json(bounds.max);
}

Json valences(const CellComplex& complex) {
  std::map<std::size_t, std::size_t> inner_edges;
  std::map<std::size_t, std::size_t> boundary_edges;
  for (const EdgeId edge : complex.edges()) {
    ++(complex.is_boundary(edge) ? boundary_edges : inner_edges)[complex.half_faces(edge).size()];
  }
  std::map<std::size_t, std::size_t> cells;
  for (const CellId cell : complex.cells()) {
    ++cells[complex.half_faces(cell).size()];
  }
  return {{"faces_at_inner_edges", histogram(inner_edges)},
          {"faces_at_boundary_edges", histogram(boundary_edges)},
          {"faces_of_cells", histogram(cells)}};
}

/// Where cells meet only in an edge or a vertex.
Json touching(const CellComplex& complex) {
  const Sharpness sharp = with_touching_elements(complex, smooth_sharpness(complex));
  const auto is_sharp = [](float value) { return value > 0; };
  return {{"edges", std::count_if(sharp.edges.begin(), sharp.edges.end(), is_sharp)},
          {"vertices", std::count_if(sharp.vertices.begin(), sharp.vertices.end(), is_sharp)}};
}

Json tags(const Sharpness& sharpness) {
  const auto is_infinite = [](float s) { return s >= kInfiniteSharpness; };
  const auto is_semi = [](float s) { return s > 0 && s < kInfiniteSharpness; };
  const auto& edges = sharpness.edges;
  const auto& vertices = sharpness.vertices;
  return {{"sharp_edges", std::count_if(edges.begin(), edges.end(), is_infinite)},
          {"semi_sharp_edges", std::count_if(edges.begin(), edges.end(), is_semi)},
          {"corners", std::count_if(vertices.begin(), vertices.end(), is_infinite)},
          {"semi_sharp_vertices", std::count_if(vertices.begin(), vertices.end(), is_semi)}};
}

Json lattice_json(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  Json json = {{"type", "subdivision"},
               {"scheme", name_of(lattice.scheme)},
               {"vertices", complex.n_vertices()},
               {"edges", complex.n_edges()},
               {"faces", complex.n_faces()},
               {"cells", complex.n_cells()},
               {"valences", valences(complex)},
               {"non_manifold", touching(complex)},
               {"inverted_at_corner", count_cells_inverted_at_corners(complex, lattice.rest)},
               {"tags", tags(lattice.sharpness)},
               {"has_pose", !lattice.pose.empty()},
               {"valid", true},
               {"defects", Json::array()}};
  add_bounds(json, lattice.rest);
  return json;
}

/// A lattice that is no valid one: its tables' sizes and what is wrong with them.
Json defective_json(const LatticeReport& report) {
  Json json = {{"type", "subdivision"},
               {"scheme", name_of(report.raw.scheme)},
               {"vertices", report.raw.polyhedra.n_vertices},
               {"edges", nullptr},
               {"faces", report.raw.polyhedra.faces.n_rows()},
               {"cells", report.raw.polyhedra.cells.n_rows()},
               {"has_pose", !report.raw.pose.empty()},
               {"valid", false}};
  Json defects = Json::array();
  for (const Defect& defect : report.defects) {
    defects.push_back({{"kind", name_of(defect.kind)},
                       {"element", defect.element},
                       {"index", defect.index < 0 ? Json() : Json(defect.index)},
                       {"message", defect.message}});
  }
  json["defects"] = std::move(defects);
  add_bounds(json, report.raw.rest);
  return json;
}

std::string text_of(const glm::dvec3& point) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", point.x, point.y, point.z);
}

std::string histogram_text(const Json& counts) {
  std::string text;
  for (const auto& [number, count] : counts.items()) {
    text += fmt::format("{}{} × {}", text.empty() ? "" : ", ", count.get<std::size_t>(), number);
  }
  return text.empty() ? "none" : text;
}

std::string counts_text(const SubdivisionLattice& lattice) {
  const CellComplex& complex = *lattice.complex;
  return fmt::format("{} vertices, {} edges, {} faces, {} cells", complex.n_vertices(),
                     complex.n_edges(), complex.n_faces(), complex.n_cells());
}

/// What kinds of edges and cells there are, from the lattice's report in JSON.
std::string shape_text(const Json& json) {
  const Json& valence = json["valences"];
  return fmt::format(
      "  faces at inner edges     {}\n"
      "  faces at boundary edges  {}\n"
      "  faces of cells           {}\n"
      "  cells meet in an edge only at {} edges, in a vertex only at {} vertices\n"
      "  cells inverted at a corner: {}\n",
      histogram_text(valence["faces_at_inner_edges"]),
      histogram_text(valence["faces_at_boundary_edges"]), histogram_text(valence["faces_of_cells"]),
      json["non_manifold"]["edges"].dump(), json["non_manifold"]["vertices"].dump(),
      json["inverted_at_corner"].dump());
}

std::string lattice_text(const SubdivisionLattice& lattice) {
  const Json json = lattice_json(lattice);
  const Box bounds = box_of(lattice.rest);
  const Json& tag = json["tags"];
  return fmt::format(
      "subdivision lattice, {} scheme{}\n"
      "  {}\n"
      "{}"
      "  sharp edges {}, semi-sharp {}; corners {}, semi-sharp {}\n"
      "  box {}  to  {}\n"
      "  valid\n",
      name_of(lattice.scheme), lattice.pose.empty() ? "" : ", posed", counts_text(lattice),
      shape_text(json), tag["sharp_edges"].dump(), tag["semi_sharp_edges"].dump(),
      tag["corners"].dump(), tag["semi_sharp_vertices"].dump(), text_of(bounds.min),
      text_of(bounds.max));
}

template <class Numbers>
std::string joined(const Numbers& numbers, const char* separator) {
  return fmt::format("{}", fmt::join(numbers, separator));
}

std::string counts_text(const TensorLattice& lattice) {
  return fmt::format("{} control points", joined(lattice.counts(), " x "));
}

std::string counts_text(const ThbLattice& lattice) {
  const int n = lattice.hierarchy->n_levels();
  return fmt::format("{} control points on {} level{}", lattice.rest.size(), n, n == 1 ? "" : "s");
}

/// How each axis ends, "knots" where it has its own.
std::array<std::string_view, 3> ends_of(const TensorLattice& lattice) {
  std::array<std::string_view, 3> ends;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Ends named = lattice.axes[axis].ends();
    ends[axis] = named == Ends::Explicit ? "knots" : name_of(named);
  }
  return ends;
}

std::array<int, 3> degree_of(const TensorLattice& lattice) {
  return {lattice.axes[0].degree(), lattice.axes[1].degree(), lattice.axes[2].degree()};
}

/// Adds what lattices of all types without cells have.
template <class GridLattice>
Json finished(Json json, const GridLattice& lattice) {
  json["control_points"] = lattice.rest.size();
  json["has_pose"] = !lattice.pose.empty();
  json["valid"] = true;
  json["defects"] = Json::array();
  add_bounds(json, lattice.rest);
  return json;
}

Json lattice_json(const TensorLattice& lattice) {
  Json json = {{"type", name_of(lattice.kind)},
               {"counts", lattice.counts()},
               {"degree", degree_of(lattice)},
               {"ends", ends_of(lattice)}};
  if (!lattice.weights.empty()) {
    const auto [low, high] = std::ranges::minmax(lattice.weights);
    json["weights"] = {{"min", low}, {"max", high}};
  }
  return finished(std::move(json), lattice);
}

Json lattice_json(const ThbLattice& lattice) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  return finished({{"type", "thb"},
                   {"counts", hierarchy.counts()},
                   {"degree", hierarchy.degree()},
                   {"levels", hierarchy.n_controls_by_level()},
                   {"leaves", hierarchy.leaves().size()}},
                  lattice);
}

std::string bounds_text(std::span<const glm::dvec3> points) {
  const Box bounds = box_of(points);
  return fmt::format("  box {}  to  {}\n  valid\n", text_of(bounds.min), text_of(bounds.max));
}

std::string lattice_text(const TensorLattice& lattice) {
  std::string text =
      fmt::format("{} lattice{}\n  {}\n  degree {}, ends {}\n", name_of(lattice.kind),
                  lattice.pose.empty() ? "" : ", posed", counts_text(lattice),
                  joined(degree_of(lattice), " "), joined(ends_of(lattice), " "));
  if (!lattice.weights.empty()) {
    const auto [low, high] = std::ranges::minmax(lattice.weights);
    text += fmt::format("  weights {:.6g} to {:.6g}\n", low, high);
  }
  return text + bounds_text(lattice.rest);
}

std::string lattice_text(const ThbLattice& lattice) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  return fmt::format("thb lattice{}\n  {}: {}; {} cells\n  {} on a grid of level 0, degree {}\n",
                     lattice.pose.empty() ? "" : ", posed", counts_text(lattice),
                     joined(hierarchy.n_controls_by_level(), ", "), hierarchy.leaves().size(),
                     joined(hierarchy.counts(), " x "), joined(hierarchy.degree(), " ")) +
         bounds_text(lattice.rest);
}

/// "1 face", "2 faces".
std::string counted(std::size_t n, std::string_view one, std::string_view more) {
  return fmt::format("{} {}", n, n == 1 ? one : more);
}

std::string defective_text(const LatticeReport& report) {
  std::string text =
      fmt::format("subdivision lattice with {} vertices, {} faces, {}\n  not valid, {}\n",
                  report.raw.polyhedra.n_vertices, report.raw.polyhedra.faces.n_rows(),
                  counted(report.raw.polyhedra.cells.n_rows(), "cell", "cells"),
                  counted(report.defects.size(), "defect", "defects"));
  for (std::size_t i = 0; i < std::min(report.defects.size(), kDefectsShown); ++i) {
    text += fmt::format("  {}: {}\n", name_of(report.defects[i].kind), report.defects[i].message);
  }
  if (report.defects.size() > kDefectsShown) {
    text +=
        fmt::format("  … and {} more; --json lists all\n", report.defects.size() - kDefectsShown);
  }
  return text;
}

Json model_json(const Model& model) {
  Json json = {{"type", "model"},
               {"points", model.points().size()},
               {"faces", model.faces().n_rows()},
               {"normals", model.normals().size()}};
  add_bounds(json, model.points());
  return json;
}

Json counts_json(const StatusCounts& counts) {
  return {{"inside", counts.inside},
          {"border", counts.border},
          {"outside", counts.outside},
          {"unconverged", counts.unconverged}};
}

/// Names of files may be no UTF-8, which JSON is.
std::string line(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json lock_json(const Lock& lock) {
  return {{"option", lock.option}, {"faces", lock.faces}, {"controls", lock.controls.size()}};
}

std::string lock_text(const Lock& lock) {
  if (lock.faces.empty()) {
    return "  no boundary face locked: the model does not cross the lattice's boundary\n";
  }
  return fmt::format("  {} locked {}: {} as unmoved\n",
                     counted(lock.faces.size(), "boundary face", "boundary faces"),
                     lock.option.substr(0, lock.option.find(':')),
                     counted(lock.controls.size(), "control point counts", "control points count"));
}

/// Nothing where the lattice froze as exactly as was asked.
std::string freeze_error_text(double error) {
  return error == 0 ? ""
                    : fmt::format(
                          "  the lattice is frozen only to about {:.0e} of its diagonal: its "
                          "cells have too many faces for more\n",
                          error);
}

/// Adds how many faces tore.
void add_torn_faces(const Scene& scene, const std::string& name, Json& json, std::string& text) {
  const auto torn = scene.torn_faces.find(name);
  const std::size_t n = torn == scene.torn_faces.end() ? 0 : torn->second;
  json["torn_faces"] = n;
  if (n > 0) {
    text += fmt::format(
        "  {} torn where the model leaves the lattice; --outside falloff:D or --lock C1 joins {}\n",
        counted(n, "face is", "faces are"), n == 1 ? "it" : "them");
  }
}

/// Adds how many points each lattice holds, and its lock, to a report in JSON and in text.
void add_counts(const Scene& scene, Json& json, std::string& text) {
  for (const auto& [names, bound] : scene.bound) {
    Json counts = counts_json(bound.binding->counts());
    const bool is_locked = bound.lock.option != "none";
    if (is_locked) {
      counts["lock"] = lock_json(bound.lock);
    }
    counts["freeze_error"] = bound.volume->freeze_error();
    counts["gradient_error"] = bound.volume->gradient_error();
    if (scene.bound.size() == 1) {
      json.update(counts);
    } else {
      json["lattices"][names.second] = counts;
      text += fmt::format("  {}:\n", names.second);
    }
    text += fmt::format("  {} inside, {} on the border, {} outside, {} unconverged\n",
                        counts["inside"].dump(), counts["border"].dump(), counts["outside"].dump(),
                        counts["unconverged"].dump());
    text += is_locked ? lock_text(bound.lock) : "";
    text += freeze_error_text(bound.volume->freeze_error());
  }
}

/// Adds how much of a model a new lattice holds, and where its limbs share cells.
void add_conversion(const Conversion& conversion, Json& json, std::string& text) {
  if (conversion.n_points == 0) {
    return;
  }
  const double share =
      static_cast<double>(conversion.n_inside) / static_cast<double>(conversion.n_points);
  json["model"] = {
      {"points", conversion.n_points}, {"inside", conversion.n_inside}, {"share_inside", share}};
  text += fmt::format("  {} of the model's {} inside: {:.4g} %\n", conversion.n_inside,
                      counted(conversion.n_points, "point", "points"), 100 * share);
  json["shared"] = Json::array();
  for (const SharedPlace& place : conversion.shared) {
    json["shared"].push_back(
        {{"cells", place.n_cells}, {"center", to_json(place.center)}, {"gap", place.gap}});
    text += fmt::format("  limbs share {} round {} though they do not touch there\n",
                        counted(place.n_cells, "cell", "cells"), text_of(place.center));
  }
  if (!conversion.shared.empty()) {
    json["wrap_to_part"] = conversion.cells_to_part == 0 ? Json() : Json(conversion.cells_to_part);
    text += conversion.cells_to_part == 0
                ? "  they are too close for any grid: part them in the model\n"
                : fmt::format("  to keep them apart try --wrap {}\n", conversion.cells_to_part);
  }
}

}  // namespace

std::string lattice_report(const LatticeReport& report, bool is_json) {
  if (!report.defects.empty()) {
    return is_json ? line(defective_json(report)) : defective_text(report);
  }
  return lattice_report(build_lattice(report.raw, ""), is_json);
}

std::string lattice_report(const Lattice& lattice, bool is_json) {
  return lattice.visit(
      [&](const auto& held) { return is_json ? line(lattice_json(held)) : lattice_text(held); });
}

std::string lattice_report(const Lattice& lattice, const ModelInfluence& influence, bool is_json) {
  const StatusCounts& n = influence.counts;
  return lattice.visit([&](const auto& held) {
    if (!is_json) {
      return lattice_text(held) +
             fmt::format(
                 "  of the model {} points inside, {} on the border, {} outside, {} "
                 "unconverged\n",
                 n.inside, n.border, n.outside, n.unconverged) +
             influence_text(influence.levels);
    }
    Json json = lattice_json(held);
    json["model"] = counts_json(n);
    add_influence(influence.levels, "influence", json);
    return line(json);
  });
}

std::string model_report(const Model& model, bool is_json) {
  if (is_json) {
    return line(model_json(model));
  }
  const Box bounds = box_of(model.points());
  return fmt::format("model with {} points, {} faces, {} normals\n  box {}  to  {}\n",
                     model.points().size(), model.faces().n_rows(), model.normals().size(),
                     text_of(bounds.min), text_of(bounds.max));
}

std::string picture_report(const std::string& path, int width, int height, bool is_json) {
  return is_json ? line({{"output", path}, {"width", width}, {"height", height}})
                 : fmt::format("{}: {} x {} pixels\n", path, width, height);
}

std::string result_report(const Scene& scene, const std::string& name, const std::string& path,
                          bool is_json) {
  if (const auto lattice = scene.lattices.find(name); lattice != scene.lattices.end()) {
    return lattice->second.visit([&](const auto& held) {
      Json json = lattice_json(held);
      json["output"] = path;
      std::string text = fmt::format("{}: {}\n", path, counts_text(held));
      if (const auto found = scene.conversions.find(name); found != scene.conversions.end()) {
        text += json.contains("valences") ? shape_text(json) : "";
        add_conversion(found->second, json, text);
      }
      return is_json ? line(json) : text;
    });
  }
  const Model& model = model_in(scene, name);
  Json json = model_json(model);
  json["output"] = path;
  std::string text =
      fmt::format("{}: {} points, {} faces\n", path, model.points().size(), model.faces().n_rows());
  if (!scene.bound.empty()) {
    add_counts(scene, json, text);
    add_torn_faces(scene, name, json, text);
  }
  return is_json ? line(json) : text;
}

std::string binding_report(const Scene& scene, const std::string& path, bool is_json) {
  Json json = {{"type", "binding"}};
  std::string text = fmt::format("{}:\n", path);
  add_counts(scene, json, text);
  json["output"] = path;
  return is_json ? line(json) : text;
}

std::string series_report(const std::vector<std::string>& reports, bool is_json) {
  std::string text;
  for (const std::string& report : reports) {
    text += (is_json && !text.empty() ? "," : "") + report;
  }
  return is_json ? "[" + text + "]\n" : text;
}

}  // namespace espalier::tools
