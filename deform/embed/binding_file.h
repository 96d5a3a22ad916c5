#pragma once

/// Bindings in and out of files, with what they were made for.
///
/// All numbers are little-endian; arrays follow each other without gaps:
///
///     "ESPLBIND"                    8 bytes
///     version = 1                   u32
///     n_points, n_held, n_fringe, n_freeze, n_outside  u32 each
///     topology, scheme, tags, rest, model, volume      u64 each, see BindingSource
///     freeze, outside               n_freeze and n_outside bytes of text
///     status                        n_points × u8, in the order of PointStatus
///     points, patches               n_held × i32 each
///     uvw                           n_held × 3 × f64
///     of the fringe: points, patches                  n_fringe × i32 each
///     its uvw, weights, weight slopes, uvw slopes      n_fringe × 3, 1, 3, 9 × f64
///     checksum                      u64, Fingerprint of all bytes before it

#include <cstdint>
#include <string>
#include <string_view>

#include "deform/embed/embed.h"

namespace espalier {

/// Fingerprints of what a binding depends on, and the options it was made with.
struct BindingSource {
  std::uint64_t topology = 0;  ///< the lattice's faces and cells, or its axes or its hierarchy
  std::uint64_t scheme = 0;    ///< and the lattice's type
  std::uint64_t tags = 0;      ///< sharpness of edges and vertices, or weights
  std::uint64_t rest = 0;      ///< bits of the lattice's points at rest
  std::uint64_t model = 0;     ///< bits of the model's points
  std::uint64_t volume = 0;    ///< the frozen volume's patches, see fingerprint_of()
  std::string freeze;          ///< the option the lattice was frozen with, at most 1000 bytes
  std::string outside;         ///< what outside points do, the same
  bool operator==(const BindingSource&) const = default;
};

/// A binding with what it was made for.
struct SavedBinding {
  BindingSource source;
  Binding binding;
};

/// Fingerprint of which points each patch has and how. The same on every machine, as no rounded
/// number enters.
[[nodiscard]] std::uint64_t fingerprint_of(const Volume& volume);

/// Throws FileError naming `path` and the first thing that differs from what the binding in it was
/// made for; the volume is compared only if `current` has its fingerprint, not 0.
void require_same_source(const std::string& path, const BindingSource& saved,
                         const BindingSource& current);

/// The bytes of a file, and back. Throws FileError for bytes that are cut short, damaged, of
/// another version, or hold no binding: every index is in range, patches ascend, every (u, v, w) is
/// finite and in or near [0,1]³. Only the range of the patches waits for require_patches().
[[nodiscard]] std::string binding_bytes(const SavedBinding& saved);
[[nodiscard]] SavedBinding parse_binding(const std::string& path, std::string_view bytes);

/// Throws FileError unless the binding's patches are patches of the volume.
void require_patches(const std::string& path, const Binding& binding, const Volume& volume);

}  // namespace espalier
