#pragma once

/// Models and lattices as a drawing.

#include <span>

#include "deform/model/model.h"
#include "lattice/io/lattice.h"
#include "viewer/render/drawing.h"
#include "viewer/render/drawing_frame.h"

namespace espalier::viewer {

/// Which of a lattice's points to draw.
enum class LatticeShape { Posed, Rest };

/// Models shaded, lattices as lines in the colours of [MJ96] figure 5: corner vertices yellow,
/// sharp edges red, boundary edges green, inner edges blue. Lines between control points on one
/// side of a grid are boundary edges. In the units of `frame`.
[[nodiscard]] Drawing draw_scene(std::span<const Model> models, std::span<const Lattice> lattices,
                                 LatticeShape shape, const DrawingFrame& frame, float pen = 1);

/// The box of everything that draw_scene() would show, in model units.
[[nodiscard]] Box bounds(std::span<const Model> models, std::span<const Lattice> lattices,
                         LatticeShape shape);

}  // namespace espalier::viewer
