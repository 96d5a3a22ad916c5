#include "deform/scene/bind.h"

#include "deform/embed/binding_file.h"
#include "deform/embed/fringe.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/core/hash.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

std::uint64_t fingerprint_of(const CellComplex& complex) {
  const Polyhedra polyhedra = complex.polyhedra();
  Fingerprint print;
  print.add(polyhedra.n_vertices);
  for (const auto* rows : {&polyhedra.faces, &polyhedra.cells}) {
    print.add(std::uint64_t{rows->n_rows()});
    for (std::size_t i = 0; i < rows->n_rows(); ++i) {
      print.add_all((*rows)[i]);
    }
  }
  return print.value();
}

std::uint64_t fingerprint_of(const Sharpness& sharpness) {
  Fingerprint print;
  print.add_all(std::span(sharpness.edges.values()));
  print.add_all(std::span(sharpness.vertices.values()));
  return print.value();
}

std::uint64_t fingerprint_of(std::span<const glm::dvec3> points) {
  Fingerprint print;
  print.add_all(points);
  return print.value();
}

/// Numbers of types of lattices; those of subdivision lattices are their schemes, from 0.
constexpr std::uint64_t kFirstTensorKind = 16;
constexpr std::uint64_t kThb = 32;

/// What a binding depends on of a lattice alone.
BindingSource lattice_source(const SubdivisionLattice& lattice) {
  BindingSource source;
  source.topology = fingerprint_of(*lattice.complex);
  source.scheme = static_cast<std::uint64_t>(lattice.scheme);
  source.tags = fingerprint_of(lattice.sharpness);
  source.rest = fingerprint_of(lattice.rest);
  return source;
}

BindingSource lattice_source(const TensorLattice& lattice) {
  Fingerprint topology;
  for (const TensorAxis& axis : lattice.axes) {
    topology.add(std::int32_t{axis.n_controls()});
    topology.add(std::int32_t{axis.degree()});
    topology.add(static_cast<std::uint64_t>(axis.ends()));
    topology.add_all(axis.knots());
  }
  Fingerprint weights;
  weights.add_all(std::span(lattice.weights));
  Fingerprint rest;
  rest.add_all(std::span(lattice.rest));
  rest.add_all(std::span<const glm::dvec3>(lattice.thickness));
  BindingSource source;
  source.topology = topology.value();
  source.scheme = kFirstTensorKind + static_cast<std::uint64_t>(lattice.kind);
  source.tags = weights.value();
  source.rest = rest.value();
  return source;
}

BindingSource lattice_source(const ThbLattice& lattice) {
  Fingerprint topology;
  topology.add_all(std::span<const std::int32_t>(lattice.hierarchy->counts()));
  topology.add_all(std::span<const std::int32_t>(lattice.hierarchy->degree()));
  for (const std::vector<GridIndex>& cells : lattice.hierarchy->domains()) {
    topology.add(std::uint64_t{cells.size()});
    for (const GridIndex& cell : cells) {
      topology.add(cell.key());
    }
  }
  BindingSource source;
  source.topology = topology.value();
  source.scheme = kThb;
  source.rest = fingerprint_of(lattice.rest);
  return source;
}

/// All but the volume's fingerprint.
BindingSource source_of(const Lattice& lattice, const Model& model, const BindOptions& options) {
  BindingSource source = lattice.visit([](const auto& held) { return lattice_source(held); });
  source.model = fingerprint_of(model.points());
  source.freeze = options.freeze;
  source.outside = options.outside;
  return source;
}

/// The distance in "falloff:DISTANCE"; 0 for "keep".
double reach_of(const std::string& option) {
  constexpr std::string_view kFalloff = "falloff:";
  double reach = 0;
  if (option == "keep" || (option.starts_with(kFalloff) &&
                           parse_number(std::string_view(option).substr(kFalloff.size()), reach) &&
                           reach > 0 && reach <= kLargestCoordinate)) {
    return reach;
  }
  throw ParameterError("'outside' is '" + option +
                       "', must be keep, or falloff:DISTANCE with a distance above 0");
}

/// "TOLERANCE", or "TOLERANCE:GRADIENT_TOLERANCE". False for anything else.
bool parse_tolerances(std::string_view text, AdaptiveOptions& options) {
  const std::size_t colon = text.find(':');
  const bool has_gradient = colon != std::string_view::npos;
  double& tolerance = options.tolerance;
  double& gradient = options.gradient_tolerance;
  return parse_number(text.substr(0, colon), tolerance) && tolerance >= 1e-12 && tolerance <= 0.1 &&
         (!has_gradient ||
          (parse_number(text.substr(colon + 1), gradient) && gradient >= 1e-12 && gradient <= 1));
}

}  // namespace

Volume freeze(const Lattice& lattice, const std::string& option, const Progress& progress) {
  const std::size_t colon = option.find(':');
  const std::string_view mode = std::string_view(option).substr(0, colon);
  const std::string_view number =
      colon == std::string::npos ? "" : std::string_view(option).substr(colon + 1);
  FreezeOptions options;
  if (option == "adaptive" || (mode == "adaptive" && parse_tolerances(number, options.adaptive))) {
    return lattice.freeze(options, progress);
  }
  std::int64_t levels = 0;
  if (mode == "uniform" && parse_integer(number, levels) && levels >= 1 && levels <= 8) {
    options.uniform_levels = static_cast<int>(levels);
    return lattice.freeze(options, progress);
  }
  throw ParameterError(
      "'freeze' is '" + option +
      "', must be adaptive, adaptive:TOLERANCE from 1e-12 to 0.1, "
      "adaptive:TOLERANCE:TOLERANCE_OF_DERIVATIVES, or uniform:N with N from 1 to 8");
}

Scene with_bound(const Scene& scene, const std::string& model, const std::string& lattice,
                 const BindOptions& options, const Progress& progress) {
  const auto found = scene.bound.find({model, lattice});
  if (found != scene.bound.end() && found->second.freeze == options.freeze &&
      found->second.outside == options.outside) {
    return scene;
  }
  const double reach = reach_of(options.outside);
  auto volume =
      std::make_shared<const Volume>(freeze(lattice_in(scene, lattice), options.freeze, progress));
  const std::span<const glm::dvec3> points = model_in(scene, model).points();
  Binding binding = embed(*volume, points, progress);
  if (reach > 0) {
    binding.fringe = make_fringe(*volume, points, binding.status, reach, progress);
  }
  Scene result = scene;
  result.bound.insert_or_assign({model, lattice},
                                BoundModel{options.freeze, options.outside, std::move(volume),
                                           std::make_shared<const Binding>(std::move(binding))});
  return result;
}

void save_binding(const Scene& scene, const std::string& model, const std::string& lattice,
                  const std::string& path) {
  const BoundModel& bound = scene.bound.at({model, lattice});
  BindingSource source =
      source_of(lattice_in(scene, lattice), model_in(scene, model), {bound.freeze, bound.outside});
  source.volume = fingerprint_of(*bound.volume);
  write_file(path, binding_bytes({std::move(source), *bound.binding}));
}

Scene with_saved_binding(const Scene& scene, const std::string& model, const std::string& lattice,
                         const std::string& path, const BindOptions& options,
                         const Progress& progress) {
  SavedBinding saved = parse_binding(path, read_file(path));
  const BindOptions complete = {options.freeze.empty() ? saved.source.freeze : options.freeze,
                                options.outside.empty() ? saved.source.outside : options.outside};
  BindingSource source = source_of(lattice_in(scene, lattice), model_in(scene, model), complete);
  require_same_source(path, saved.source, source);
  auto volume =
      std::make_shared<const Volume>(freeze(lattice_in(scene, lattice), complete.freeze, progress));
  source.volume = fingerprint_of(*volume);
  require_same_source(path, saved.source, source);
  require_patches(path, saved.binding, *volume);
  Scene result = scene;
  result.bound.insert_or_assign(
      {model, lattice}, BoundModel{complete.freeze, complete.outside, std::move(volume),
                                   std::make_shared<const Binding>(std::move(saved.binding))});
  return result;
}

}  // namespace espalier
