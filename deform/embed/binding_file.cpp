#include "deform/embed/binding_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/core/hash.h"

namespace espalier {
namespace {

constexpr std::string_view kMagic = "ESPLBIND";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 8 + 6 * 4 + 6 * 8;
constexpr std::size_t kChecksumBytes = 8;
constexpr std::size_t kHeldBytes = 2 * 4 + 3 * 8;
constexpr std::size_t kFringeBytes = 2 * 4 + 16 * 8;
constexpr std::size_t kMostOptionBytes = 1000;

template <class Unsigned>
void append(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
  }
}

/// Takes numbers off the front of bytes that are known to be enough.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class Unsigned>
  [[nodiscard]] Unsigned take() {
    Unsigned value = 0;
    for (const char byte : take_bytes(sizeof(Unsigned))) {
      value = static_cast<Unsigned>(value >> 8 | Unsigned{static_cast<unsigned char>(byte)}
                                                     << (8 * (sizeof(Unsigned) - 1)));
    }
    return value;
  }
  [[nodiscard]] std::string_view take_bytes(std::size_t n) {
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }

 private:
  std::string_view rest_;
};

struct Header {
  std::uint32_t n_points = 0;
  std::uint32_t n_held = 0;
  std::uint32_t n_fringe = 0;
  std::uint32_t n_freeze = 0;
  std::uint32_t n_outside = 0;
  std::array<std::uint64_t, 6> fingerprints{};

  [[nodiscard]] std::uint64_t file_size() const {
    return kHeaderBytes + std::uint64_t{n_freeze} + n_outside + n_points +
           kHeldBytes * std::uint64_t{n_held} + kFringeBytes * std::uint64_t{n_fringe} +
           kChecksumBytes;
  }
};

std::uint64_t checksum(std::string_view bytes) {
  Fingerprint sum;
  sum.add_bytes(bytes);
  return sum.value();
}

/// The header of a file that is whole and undamaged.
Header checked_header(const std::string& path, std::string_view bytes) {
  if (bytes.substr(0, kMagic.size()) != kMagic.substr(0, bytes.size()) || bytes.empty()) {
    throw FileError(path, "is no binding: it does not begin with ESPLBIND");
  }
  if (bytes.size() < kHeaderBytes + kChecksumBytes) {
    throw FileError(path, "is cut short: " + std::to_string(bytes.size()) + " bytes");
  }
  ByteReader reader(bytes.substr(kMagic.size()));
  if (const auto version = reader.take<std::uint32_t>(); version != kVersion) {
    throw FileError(path, "is a binding of version " + std::to_string(version) +
                              ", this program knows version 1: bind again");
  }
  Header header;
  header.n_points = reader.take<std::uint32_t>();
  header.n_held = reader.take<std::uint32_t>();
  header.n_fringe = reader.take<std::uint32_t>();
  header.n_freeze = reader.take<std::uint32_t>();
  header.n_outside = reader.take<std::uint32_t>();
  for (std::uint64_t& fingerprint : header.fingerprints) {
    fingerprint = reader.take<std::uint64_t>();
  }
  if (header.file_size() != bytes.size()) {
    throw FileError(path, "is cut short or damaged: " + std::to_string(bytes.size()) +
                              " bytes, its header announces " + std::to_string(header.file_size()));
  }
  const std::size_t n = bytes.size() - kChecksumBytes;
  if (ByteReader(bytes.substr(n)).take<std::uint64_t>() != checksum(bytes.substr(0, n))) {
    throw FileError(path, "is damaged: its checksum does not match; bind again");
  }
  if (std::max(header.n_freeze, header.n_outside) > kMostOptionBytes ||
      header.n_points > 0x7FFFFFFFu ||
      std::uint64_t{header.n_held} + header.n_fringe > header.n_points) {
    throw FileError(path, "is no binding: its header announces " + std::to_string(header.n_points) +
                              " points, " + std::to_string(header.n_held) + " held and " +
                              std::to_string(header.n_fringe) + " in the fringe");
  }
  return header;
}

bool is_held(PointStatus status) {
  return status == PointStatus::Inside || status == PointStatus::Border;
}

bool is_in_reach(const glm::dvec3& uvw) {
  constexpr double kReach = 1.001 * kLeafReach;  // and round-off
  bool is_in = true;
  for (int axis = 0; axis < 3; ++axis) {
    is_in = is_in && uvw[axis] >= -kReach && uvw[axis] <= 1 + kReach;  // false for NaN
  }
  return is_in;
}

/// Throws unless every index is that of a point which `may_be` allows, once, and patches ascend.
/// what: names the points in errors.
template <class MayBe>
void require_valid_places(const std::string& path, const std::string& what,
                          std::span<const std::int32_t> points,
                          std::span<const std::int32_t> patches,
                          std::span<const PointStatus> status, const MayBe& may_be) {
  std::vector<bool> is_seen(status.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fail = [&](const std::string& why) {
      throw FileError(path, what + " " + std::to_string(i) + " " + why);
    };
    if (points[i] < 0 || static_cast<std::size_t>(points[i]) >= status.size()) {
      fail("has index " + std::to_string(points[i]) + ", must be 0 to " +
           std::to_string(static_cast<std::int64_t>(status.size()) - 1));
    }
    const auto at = static_cast<std::size_t>(points[i]);
    if (is_seen[at] || !may_be(status[at])) {
      fail("has index " + std::to_string(points[i]) + ", which " +
           (is_seen[at] ? "occurs twice" : "is " + std::string(name_of(status[at]))));
    }
    is_seen[at] = true;
    if (patches[i] < (i > 0 ? patches[i - 1] : 0)) {
      fail("is in patch " + std::to_string(patches[i]) + ": patches must ascend from 0");
    }
  }
}

void require_valid(const std::string& path, const Binding& binding) {
  require_valid_places(path, "held point", binding.points, binding.patches, binding.status,
                       is_held);
  for (std::size_t i = 0; i < binding.uvw.size(); ++i) {
    if (!is_in_reach(binding.uvw[i])) {
      throw FileError(path,
                      "held point " + std::to_string(i) + " has parameters outside of its patch");
    }
  }
  const StatusCounts counts = binding.counts();
  if (counts.inside + counts.border != binding.points.size()) {
    throw FileError(path, std::to_string(counts.inside + counts.border) +
                              " points are inside, but patches hold " +
                              std::to_string(binding.points.size()));
  }
}

bool is_finite(const glm::dvec3& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

void require_valid(const std::string& path, const Fringe& fringe,
                   std::span<const PointStatus> status) {
  require_valid_places(path, "fringe point", fringe.points, fringe.patches, status,
                       [](PointStatus each) { return each == PointStatus::Outside; });
  for (std::size_t i = 0; i < fringe.points.size(); ++i) {
    const glm::dmat3& slope = fringe.uvw_slopes[i];
    if (!(fringe.weights[i] >= 0 && fringe.weights[i] <= 1) || !is_in_reach(fringe.uvw[i]) ||
        !is_finite(fringe.weight_slopes[i]) || !is_finite(slope[0]) || !is_finite(slope[1]) ||
        !is_finite(slope[2])) {
      throw FileError(path, "fringe point " + std::to_string(i) +
                                " has a weight, parameters or slopes out of range");
    }
  }
}

void append(std::string& bytes, std::span<const std::int32_t> indices) {
  for (const std::int32_t index : indices) {
    append(bytes, static_cast<std::uint32_t>(index));
  }
}

/// Vectors and matrices as their coordinates.
template <class T>
void append_numbers(std::string& bytes, const std::vector<T>& values) {
  for (const T& value : values) {
    const auto* numbers = reinterpret_cast<const double*>(&value);
    for (std::size_t i = 0; i < sizeof(T) / sizeof(double); ++i) {
      append(bytes, std::bit_cast<std::uint64_t>(numbers[i]));
    }
  }
}

void take_indices(ByteReader& reader, std::size_t n, std::vector<std::int32_t>& indices) {
  indices.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    indices.push_back(std::bit_cast<std::int32_t>(reader.take<std::uint32_t>()));
  }
}

template <class T>
void take_numbers(ByteReader& reader, std::size_t n, std::vector<T>& values) {
  values.resize(n);
  for (T& value : values) {
    auto* numbers = reinterpret_cast<double*>(&value);
    for (std::size_t i = 0; i < sizeof(T) / sizeof(double); ++i) {
      numbers[i] = std::bit_cast<double>(reader.take<std::uint64_t>());
    }
  }
}

void append_fingerprints(std::string& bytes, const BindingSource& source) {
  for (const std::uint64_t fingerprint :
       {source.topology, source.scheme, source.tags, source.rest, source.model, source.volume}) {
    append(bytes, fingerprint);
  }
}

}  // namespace

std::uint64_t fingerprint_of(const Volume& volume) {
  Fingerprint print;
  print.add(std::uint64_t{volume.n_points()});
  for (std::size_t i = 0; i < volume.n_patches(); ++i) {
    const Patch& patch = volume.patch(i);
    for (const std::uint16_t extraction : patch.extractions) {
      print.add(std::uint64_t{extraction});
    }
    print.add(std::uint64_t{patch.boundary_faces} << 2 | std::uint64_t{patch.is_pyramid} << 1 |
              std::uint64_t{patch.is_leaf});
    print.add_all(volume.block(i));
  }
  return print.value();
}

void require_same_source(const std::string& path, const BindingSource& saved,
                         const BindingSource& current) {
  const auto require = [&](bool is_same, const char* what) {
    if (!is_same) {
      throw FileError(path, std::string(what) + "; bind again");
    }
  };
  require(saved.topology == current.topology,
          "the lattice's cells or knots are not those the binding was made for");
  require(saved.scheme == current.scheme,
          "the lattice's scheme changed, or its type, since the binding was made");
  require(
      saved.tags == current.tags,
      "the lattice's sharp edges or vertices changed, or its weights, since the binding was made");
  require(saved.rest == current.rest,
          "the lattice's rest shape changed since the binding was made");
  require(saved.model == current.model, "the model's points changed since the binding was made");
  if (saved.freeze != current.freeze) {
    throw FileError(path, "was made with --freeze " + saved.freeze + ", not " + current.freeze +
                              "; bind again, or leave --freeze out");
  }
  if (saved.outside != current.outside) {
    throw FileError(path, "was made with --outside " + saved.outside + ", not " + current.outside +
                              "; bind again, or leave --outside out");
  }
  require(current.volume == 0 || saved.volume == current.volume,
          "was made by a program that freezes the lattice in another way");
}

std::string binding_bytes(const SavedBinding& saved) {
  const Binding& binding = saved.binding;
  if (std::max(saved.source.freeze.size(), saved.source.outside.size()) > kMostOptionBytes) {
    throw ParameterError("an option of a binding is longer than 1000 bytes");
  }
  const Fringe& fringe = binding.fringe;
  std::string bytes(kMagic);
  append(bytes, kVersion);
  for (const std::size_t n : {binding.status.size(), binding.points.size(), fringe.points.size(),
                              saved.source.freeze.size(), saved.source.outside.size()}) {
    append(bytes, static_cast<std::uint32_t>(n));
  }
  append_fingerprints(bytes, saved.source);
  bytes += saved.source.freeze + saved.source.outside;
  for (const PointStatus status : binding.status) {
    append(bytes, static_cast<std::uint8_t>(status));
  }
  append(bytes, std::span<const std::int32_t>(binding.points));
  append(bytes, std::span<const std::int32_t>(binding.patches));
  append_numbers(bytes, binding.uvw);
  append(bytes, std::span<const std::int32_t>(fringe.points));
  append(bytes, std::span<const std::int32_t>(fringe.patches));
  append_numbers(bytes, fringe.uvw);
  append_numbers(bytes, fringe.weights);
  append_numbers(bytes, fringe.weight_slopes);
  append_numbers(bytes, fringe.uvw_slopes);
  append(bytes, checksum(bytes));
  return bytes;
}

SavedBinding parse_binding(const std::string& path, std::string_view bytes) {
  const Header header = checked_header(path, bytes);
  ByteReader reader(bytes.substr(kHeaderBytes));
  SavedBinding saved;
  const auto& prints = header.fingerprints;
  saved.source = {prints[0],
                  prints[1],
                  prints[2],
                  prints[3],
                  prints[4],
                  prints[5],
                  std::string(reader.take_bytes(header.n_freeze)),
                  std::string(reader.take_bytes(header.n_outside))};
  Binding& binding = saved.binding;
  binding.status.reserve(header.n_points);
  for (const char byte : reader.take_bytes(header.n_points)) {
    if (static_cast<unsigned char>(byte) > static_cast<int>(PointStatus::Unconverged)) {
      throw FileError(path, "point " + std::to_string(binding.status.size()) +
                                " has an unknown status, " +
                                std::to_string(static_cast<unsigned char>(byte)));
    }
    binding.status.push_back(static_cast<PointStatus>(byte));
  }
  take_indices(reader, header.n_held, binding.points);
  take_indices(reader, header.n_held, binding.patches);
  take_numbers(reader, header.n_held, binding.uvw);
  Fringe& fringe = binding.fringe;
  take_indices(reader, header.n_fringe, fringe.points);
  take_indices(reader, header.n_fringe, fringe.patches);
  take_numbers(reader, header.n_fringe, fringe.uvw);
  take_numbers(reader, header.n_fringe, fringe.weights);
  take_numbers(reader, header.n_fringe, fringe.weight_slopes);
  take_numbers(reader, header.n_fringe, fringe.uvw_slopes);
  require_valid(path, binding);
  require_valid(path, fringe, binding.status);
  return saved;
}

void require_patches(const std::string& path, const Binding& binding, const Volume& volume) {
  for (const auto* patches : {&binding.patches, &binding.fringe.patches}) {
    if (!patches->empty() && static_cast<std::size_t>(patches->back()) >= volume.n_patches()) {
      throw FileError(path, "names patch " + std::to_string(patches->back()) +
                                ", the lattice has " + std::to_string(volume.n_patches()));
    }
  }
}

}  // namespace espalier
