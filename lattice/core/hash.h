#pragma once

/// A fingerprint of values, to tell whether they changed. Not against people who try to deceive.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace espalier {

/// The same on every machine. Every step is a bijection of the state and of the value that goes
/// in: two sequences of one length that differ in one value never have the same fingerprint.
class Fingerprint {
 public:
  void add(std::uint64_t value) {
    state_ = (state_ ^ value) * 0x9E3779B97F4A7C15u;
    state_ ^= state_ >> 32;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
  void add(std::int32_t value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
  void add(const glm::dvec3& point) {
    add(point.x);
    add(point.y);
    add(point.z);
  }
  /// The number of values, then each.
  template <class T>
  void add_all(std::span<const T> values) {
    add(std::uint64_t{values.size()});
    for (const T& value : values) {
      add(value);
    }
  }
  /// Eight bytes at a time, the first the lowest.
  void add_bytes(std::string_view bytes) {
    add(std::uint64_t{bytes.size()});
    for (std::size_t begin = 0; begin < bytes.size(); begin += 8) {
      std::uint64_t word = 0;
      for (std::size_t i = 0; i < 8 && begin + i < bytes.size(); ++i) {
        word |= std::uint64_t{static_cast<unsigned char>(bytes[begin + i])} << (8 * i);
      }
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325u;
};

}  // namespace espalier
