// The one place that knows all types of lattices.

#include "lattice/io/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/io/json_lattice.h"
#include "lattice/io/lattice_file.h"
#include "lattice/io/tensor_json.h"

namespace espalier {
namespace {

using Edges = std::vector<std::array<std::int32_t, 2>>;

std::string_view type_of(const SubdivisionLattice&) {
  return "subdivision";
}
std::string_view type_of(const TensorLattice& lattice) {
  return name_of(lattice.kind);
}
std::string_view type_of(const ThbLattice&) {
  return "thb";
}

Edges net_of(const SubdivisionLattice& lattice) {
  Edges edges;
  for (const EdgeId edge : lattice.complex->edges()) {
    const auto& ends = lattice.complex->vertices(edge);
    edges.push_back({ends[0].value, ends[1].value});
  }
  return edges;
}

Edges net_of(const TensorLattice& lattice) {
  Edges edges;
  std::int32_t stride = 1;
  for (const TensorAxis& axis : lattice.axes) {
    const int n = axis.n_controls();
    const bool is_ring = axis.ends() == Ends::Periodic && n > 1;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(lattice.rest.size()); ++i) {
      const int along = i / stride % n;
      if (along + 1 < n) {
        edges.push_back({i, i + stride});
      } else if (is_ring) {
        edges.push_back({i, i - along * stride});
      }
    }
    stride *= n;
  }
  return edges;
}

Edges net_of(const ThbLattice& lattice) {
  const ThbHierarchy& hierarchy = *lattice.hierarchy;
  std::vector<BrickGrid<std::int32_t>::Reader> numbers;
  for (int level = 0; level < hierarchy.n_levels(); ++level) {
    numbers.emplace_back(hierarchy.numbers(level));
  }
  Edges edges;
  for (std::size_t i = 0; i < hierarchy.controls().size(); ++i) {
    const auto& [level, f] = hierarchy.controls()[i];
    for (const GridIndex& next : {GridIndex{f.i + 1, f.j, f.k}, GridIndex{f.i, f.j + 1, f.k},
                                  GridIndex{f.i, f.j, f.k + 1}}) {
      const std::int32_t function = numbers[static_cast<std::size_t>(level)](next);
      const std::int32_t control =
          function < 0 ? -1 : hierarchy.function_controls()[static_cast<std::size_t>(function)];
      if (control >= 0) {
        edges.push_back({static_cast<std::int32_t>(i), control});
      }
    }
  }
  return edges;
}

Volume frozen(const SubdivisionLattice& lattice, const FreezeOptions& options,
              const Progress& progress) {
  return options.uniform_levels > 0 ? freeze_uniform(lattice, options.uniform_levels, progress)
                                    : freeze_adaptive(lattice, options.adaptive, progress);
}
Volume frozen(const TensorLattice& lattice, const FreezeOptions&, const Progress&) {
  return freeze(lattice);
}
Volume frozen(const ThbLattice& lattice, const FreezeOptions&, const Progress&) {
  return freeze(lattice);
}

bool is_json_path(const std::string& path) {
  std::string end = path.substr(path.size() - std::min<std::size_t>(5, path.size()));
  for (char& c : end) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return end == ".json";
}

/// Runs `work`; a LatticeError that leaves it begins with the path.
template <class Work>
auto naming_file(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const LatticeError& error) {
    throw LatticeError(path + ": " + error.what());
  }
}

}  // namespace

Lattice::Lattice(SubdivisionLattice lattice)
    : lattice_(std::make_shared<const SubdivisionLattice>(std::move(lattice))) {}
Lattice::Lattice(TensorLattice lattice)
    : lattice_(std::make_shared<const TensorLattice>(std::move(lattice))) {}
Lattice::Lattice(ThbLattice lattice)
    : lattice_(std::make_shared<const ThbLattice>(std::move(lattice))) {}

std::string_view Lattice::type() const {
  return std::visit([](const auto& lattice) { return type_of(*lattice); }, lattice_);
}

std::span<const glm::dvec3> Lattice::rest_points() const {
  return std::visit([](const auto& lattice) { return std::span<const glm::dvec3>(lattice->rest); },
                    lattice_);
}

std::span<const glm::dvec3> Lattice::posed_points() const {
  return std::visit([](const auto& lattice) { return lattice->posed_points(); }, lattice_);
}

std::vector<std::array<std::int32_t, 2>> Lattice::net() const {
  return std::visit([](const auto& lattice) { return net_of(*lattice); }, lattice_);
}

Volume Lattice::freeze(const FreezeOptions& options, const Progress& progress) const {
  return std::visit([&](const auto& lattice) { return frozen(*lattice, options, progress); },
                    lattice_);
}

Lattice Lattice::with_pose(std::vector<glm::dvec3> pose) const {
  return visit([&](auto lattice) {
    lattice.pose = std::move(pose);
    if constexpr (requires { lattice.pose_weights; }) {
      if (lattice.pose.empty()) {
        lattice.pose_weights.clear();
      }
    }
    return Lattice(std::move(lattice));
  });
}

std::variant<RawLattice, Lattice> read_lattice_parts(const std::string& path) {
  if (!is_json_path(path)) {
    return read_raw_lattice(path);
  }
  const std::string text = read_file(path);
  if (is_tensor_json(path, text)) {
    return std::visit([](auto lattice) { return Lattice(std::move(lattice)); },
                      parse_json_tensor(path, text));
  }
  return parse_json_lattice(path, text);
}

Lattice read_any_lattice(const std::string& path, const Progress& progress) {
  std::variant<RawLattice, Lattice> parts = read_lattice_parts(path);
  if (auto* raw = std::get_if<RawLattice>(&parts)) {
    return build_lattice(std::move(*raw), path, progress);
  }
  return std::get<Lattice>(std::move(parts));
}

void write_any_lattice(const std::string& path, const Lattice& lattice) {
  if (const auto* subdivision = lattice.as<SubdivisionLattice>()) {
    write_lattice(path, *subdivision);
    return;
  }
  require_lattice_path(path);
  if (!is_json_path(path)) {
    throw FileError(path, fmt::format("cannot hold a {} lattice, only .json can", lattice.type()));
  }
  const std::string text = naming_file(path, [&] {
    const auto* tensor = lattice.as<TensorLattice>();
    return tensor != nullptr ? json_text(*tensor) : json_text(*lattice.as<ThbLattice>());
  });
  write_file(path, text);
}

}  // namespace espalier
