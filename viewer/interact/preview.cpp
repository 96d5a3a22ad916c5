#include "viewer/interact/preview.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "deform/scene/operations.h"
#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

/// The name of the lattice that an operation makes; empty if it makes none.
std::string result_of(const OperationCall& call) {
  for (const Parameter& parameter : operation_named(call.operation).parameters) {
    if (parameter.type == ParameterType::Result && call.arguments.has(parameter.name)) {
      return call.arguments.text(parameter.name);
    }
  }
  return "";
}

/// Whether both scenes have a model bound to the lattice in the same way, and it is not huge.
bool is_still_bound(const Scene& before, const Scene& after, const std::string& lattice) {
  constexpr std::size_t kMostPoints = 400'000;
  std::size_t n_points = 0;
  bool is_bound = false;
  for (const auto& [names, bound] : before.bound) {
    const auto now = after.bound.find(names);
    if (now == after.bound.end() || now->second.binding != bound.binding) {
      return false;
    }
    n_points += bound.binding->status.size();
    is_bound |= names.second == lattice;
  }
  return is_bound && n_points <= kMostPoints;
}

}  // namespace

Progress impatience() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPatience(300);
  const Clock::time_point end = Clock::now() + kPatience;
  return Progress([end](std::string_view, double) { return Clock::now() < end; });
}

Preview preview_of(const OperationCall& call, const Scene& scene, const Progress& progress) {
  Preview preview;
  const std::string name = result_of(call);
  if (name.empty()) {
    return preview;
  }
  try {
    Scene after = apply(call, scene, progress);
    const auto found = after.lattices.find(name);
    if (found != after.lattices.end()) {
      const auto points = found->second.posed_points();
      for (const auto& ends : found->second.net()) {
        preview.segments.push_back(points[static_cast<std::size_t>(ends[0])]);
        preview.segments.push_back(points[static_cast<std::size_t>(ends[1])]);
      }
      if (is_still_bound(scene, after, name)) {
        preview.posed = std::move(after);
      }
    }
  } catch (const Cancelled&) {
    preview.was_stopped = true;
  } catch (const Error& error) {
    preview.error = error.what();
  }
  return preview;
}

}  // namespace espalier::viewer
