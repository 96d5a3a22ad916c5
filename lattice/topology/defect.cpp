#include "lattice/topology/defect.h"

#include <array>

#include "lattice/core/error.h"

namespace espalier {

std::string_view name_of(DefectKind kind) {
  static constexpr std::array<std::string_view, 22> kNames = {
      "no-cells",           "index-out-of-range",    "face-too-small",      "face-repeats-vertex",
      "duplicate-face",     "cell-too-small",        "cell-repeats-face",   "face-used-too-often",
      "cell-not-closed",    "cell-not-sphere",       "cells-on-one-side",   "unused-face",
      "unused-vertex",      "too-few-faces-at-edge", "edge-enclosed-twice", "not-finite",
      "zero-length-edge",   "self-touching-cell",    "inverted-cell",       "vertex-inside-edge",
      "vertex-inside-face", "intersecting-cells"};
  return kNames[static_cast<std::size_t>(kind)];
}

void throw_if_defective(const std::vector<Defect>& defects) {
  if (defects.empty()) {
    return;
  }
  std::string message = "invalid lattice: " + defects.front().message;
  if (defects.size() > 1) {
    const std::size_t n_more = defects.size() - 1;
    message +=
        " (and " + std::to_string(n_more) + (n_more == 1 ? " more defect)" : " more defects)");
  }
  throw LatticeError(message);
}

}  // namespace espalier
