#pragma once

/// The index orders of this library, drawn once.
///
///      6-----------7          corner  i + 2j + 4k            axes   u: i    v: j    w: k
///     /|          /|          (i, j, k in {0, 1})            grids  i + nu·(j + nv·k), u fastest
///    4-----------5 |
///    | |         | |          face 0: u = 0    face 1: u = 1
///    | |   w     | |          face 2: v = 0    face 3: v = 1
///    | 2---|--v--|-3          face 4: w = 0    face 5: w = 1
///    |/    |/    |/           edge 4a + b + 2c runs along axis a; b and c are its places on the
///    0-----+--u--1            two other axes, the lower axis first
///
/// A half-face's loop runs counter-clockwise seen from outside its cell (see ids.h).

#include <array>

namespace espalier {

/// Corners of each face, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> kHexahedronFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

}  // namespace espalier
