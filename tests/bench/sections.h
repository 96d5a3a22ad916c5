#pragma once

/// The sections of espalier_bench: each prints its tables.

namespace espalier::bench {

/// Building and refining complexes, to sorting and copying.
void bench_topology();
/// Certificates of patches, to sampling them; largest steps; the boundary, to the inside.
void bench_certificates();
/// Finding points in volumes, to evaluating them, and round trips.
void bench_embedding();
/// Making lattices round models.
void bench_fitting();
/// Patches, bytes and errors of frozen volumes.
void bench_freezing();
/// Evaluating bound points, with the mark of each line.
void bench_evaluation();
/// Dragging control points, with the mark of each line, and table 1 of [THB18] redone.
void bench_drags();
/// Moving the vertices of refined lattices with their control points, with the mark of each line.
void bench_reposing();
/// Taking picked points where they are wanted, with the mark of each line.
void bench_pulling();

/// Hierarchies of B-splines, embedding in grids, and how many points control points move.
void bench_tensor();

}  // namespace espalier::bench
