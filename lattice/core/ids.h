#pragma once

/// Typed indices of the elements of a cell complex, and arrays indexed by them.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier {

/// An index that knows what it counts. The default is "none".
template <class Tag>
struct Id {
  std::int32_t value = -1;

  [[nodiscard]] constexpr bool is_valid() const { return value >= 0; }
  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  constexpr auto operator<=>(const Id&) const = default;
};

using VertexId = Id<struct VertexTag>;
using EdgeId = Id<struct EdgeTag>;
using FaceId = Id<struct FaceTag>;
using CellId = Id<struct CellTag>;

/// One side of a face. Side 0 of face f is half-face 2f: seen from outside its cell, the face's
/// loop runs counter-clockwise. Side 1 is half-face 2f + 1, with the loop reversed.
struct HalfFaceId : Id<struct HalfFaceTag> {
  constexpr HalfFaceId() = default;
  constexpr explicit HalfFaceId(std::int32_t half_face) : Id{half_face} {}
  constexpr HalfFaceId(FaceId face, int side) : Id{2 * face.value + side} {}

  [[nodiscard]] constexpr FaceId face() const { return FaceId{value >> 1}; }
  [[nodiscard]] constexpr int side() const { return value & 1; }
  [[nodiscard]] constexpr HalfFaceId opposite() const { return HalfFaceId(value ^ 1); }
};

/// The ids 0 … n-1, for range-based loops.
template <class IdType>
class IdRange {
 public:
  constexpr explicit IdRange(std::size_t n) : n_(static_cast<std::int32_t>(n)) {}

  class Iterator {
   public:
    constexpr explicit Iterator(std::int32_t at) : at_(at) {}
    constexpr IdType operator*() const { return IdType{at_}; }
    constexpr Iterator& operator++() {
      ++at_;
      return *this;
    }
    constexpr bool operator==(const Iterator&) const = default;

   private:
    std::int32_t at_;
  };

  [[nodiscard]] constexpr Iterator begin() const { return Iterator(0); }
  [[nodiscard]] constexpr Iterator end() const { return Iterator(n_); }

 private:
  std::int32_t n_;
};

/// A vector indexed by one kind of id.
template <class IdType, class T>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t n, const T& value = T()) : values_(n, value) {}
  explicit IdVector(std::vector<T> values) : values_(std::move(values)) {}

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  typename std::vector<T>::reference operator[](IdType id) { return values_[id.index()]; }
  typename std::vector<T>::const_reference operator[](IdType id) const {
    return values_[id.index()];
  }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }
  [[nodiscard]] auto begin() { return values_.begin(); }
  [[nodiscard]] auto end() { return values_.end(); }
  [[nodiscard]] const std::vector<T>& values() const { return values_; }
  [[nodiscard]] std::size_t bytes() const { return values_.capacity() * sizeof(T); }
  bool operator==(const IdVector&) const = default;

 private:
  std::vector<T> values_;
};

}  // namespace espalier
