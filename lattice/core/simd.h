#pragma once

/// A thin wrapper over vector registers, for kernels only: a source that includes this is compiled
/// once per instruction set, and everything here lives in a namespace of that set, so that no two
/// versions of one function meet in the linker. Every operation acts lane by lane; the kernels that
/// keep to them give the same bits wherever in a vector a point stands.

#include <immintrin.h>

#include <cstddef>

#ifdef __AVX2__
#define ESPALIER_SIMD avx2
#else
#define ESPALIER_SIMD baseline
#endif
#define ESPALIER_INLINE [[gnu::always_inline]] inline

namespace espalier::simd::ESPALIER_SIMD {

/// As many numbers as a register holds. `fused` rounds once where the set can, else twice.
template <class Real>
struct Vector;

#ifdef __AVX2__

template <>
struct Vector<float> {
  static constexpr std::size_t kWidth = 8;
  __m256 lanes;

  ESPALIER_INLINE static Vector all(float x) { return {_mm256_set1_ps(x)}; }
  ESPALIER_INLINE static Vector load(const float* from) { return {_mm256_loadu_ps(from)}; }
  /// The four numbers at a, then the four at b.
  ESPALIER_INLINE static Vector load_fours(const float* a, const float* b) {
    return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(a)), _mm_loadu_ps(b), 1)};
  }
  /// a four times, then b.
  ESPALIER_INLINE static Vector fours(float a, float b) {
    return {_mm256_insertf128_ps(_mm256_set1_ps(a), _mm_set1_ps(b), 1)};
  }
  ESPALIER_INLINE void store(float* to) const { _mm256_storeu_ps(to, lanes); }
  ESPALIER_INLINE friend Vector operator+(Vector a, Vector b) {
    return {_mm256_add_ps(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator-(Vector a, Vector b) {
    return {_mm256_sub_ps(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator*(Vector a, Vector b) {
    return {_mm256_mul_ps(a.lanes, b.lanes)};
  }
  /// a b + c
  ESPALIER_INLINE friend Vector fused(Vector a, Vector b, Vector c) {
    return {_mm256_fmadd_ps(a.lanes, b.lanes, c.lanes)};
  }
  /// c − a b
  ESPALIER_INLINE friend Vector fused_negative(Vector a, Vector b, Vector c) {
    return {_mm256_fnmadd_ps(a.lanes, b.lanes, c.lanes)};
  }
  /// The larger of each two; b where one is not a number.
  ESPALIER_INLINE friend Vector larger(Vector a, Vector b) {
    return {_mm256_max_ps(a.lanes, b.lanes)};
  }
  /// a, its sign changed where that of b is minus.
  ESPALIER_INLINE friend Vector flipped(Vector a, Vector b) {
    return {_mm256_xor_ps(a.lanes, _mm256_and_ps(b.lanes, _mm256_set1_ps(-0.0F)))};
  }
  /// −0 where the last bit of a is 1, else 0.
  ESPALIER_INLINE friend Vector last_bit_as_sign(Vector a) {
    return {_mm256_castsi256_ps(_mm256_slli_epi32(_mm256_castps_si256(a.lanes), 31))};
  }
  /// 1 / √a, correctly rounded steps; 0 where a is not positive.
  ESPALIER_INLINE friend Vector inverse_root_or_zero(Vector a) {
    const __m256 root = _mm256_div_ps(_mm256_set1_ps(1), _mm256_sqrt_ps(a.lanes));
    return {_mm256_and_ps(root, _mm256_cmp_ps(a.lanes, _mm256_setzero_ps(), _CMP_GT_OQ))};
  }
};

template <>
struct Vector<double> {
  static constexpr std::size_t kWidth = 4;
  __m256d lanes;

  ESPALIER_INLINE static Vector all(double x) { return {_mm256_set1_pd(x)}; }
  ESPALIER_INLINE static Vector load(const double* from) { return {_mm256_loadu_pd(from)}; }
  ESPALIER_INLINE void store(double* to) const { _mm256_storeu_pd(to, lanes); }
  ESPALIER_INLINE friend Vector operator+(Vector a, Vector b) {
    return {_mm256_add_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator-(Vector a, Vector b) {
    return {_mm256_sub_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator*(Vector a, Vector b) {
    return {_mm256_mul_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector fused(Vector a, Vector b, Vector c) {
    return {_mm256_fmadd_pd(a.lanes, b.lanes, c.lanes)};
  }
  ESPALIER_INLINE friend Vector fused_negative(Vector a, Vector b, Vector c) {
    return {_mm256_fnmadd_pd(a.lanes, b.lanes, c.lanes)};
  }
  ESPALIER_INLINE friend Vector larger(Vector a, Vector b) {
    return {_mm256_max_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector flipped(Vector a, Vector b) {
    return {_mm256_xor_pd(a.lanes, _mm256_and_pd(b.lanes, _mm256_set1_pd(-0.0)))};
  }
  ESPALIER_INLINE friend Vector last_bit_as_sign(Vector a) {
    return {_mm256_castsi256_pd(_mm256_slli_epi64(_mm256_castpd_si256(a.lanes), 63))};
  }
  ESPALIER_INLINE friend Vector inverse_root_or_zero(Vector a) {
    const __m256d root = _mm256_div_pd(_mm256_set1_pd(1), _mm256_sqrt_pd(a.lanes));
    return {_mm256_and_pd(root, _mm256_cmp_pd(a.lanes, _mm256_setzero_pd(), _CMP_GT_OQ))};
  }
};

/// Writes x0 y0 z0 x1 y1 z1 …: 3 × kWidth numbers.
ESPALIER_INLINE void store_interleaved(const Vector<float> (&xyz)[3], float* to) {
  const __m256 x = xyz[0].lanes;
  const __m256 y = xyz[1].lanes;
  const __m256 z = xyz[2].lanes;
  const __m256 xy = _mm256_shuffle_ps(x, y, _MM_SHUFFLE(2, 0, 2, 0));
  const __m256 yz = _mm256_shuffle_ps(y, z, _MM_SHUFFLE(3, 1, 3, 1));
  const __m256 zx = _mm256_shuffle_ps(z, x, _MM_SHUFFLE(3, 1, 2, 0));
  const __m256 a = _mm256_shuffle_ps(xy, zx, _MM_SHUFFLE(2, 0, 2, 0));
  const __m256 b = _mm256_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
  const __m256 c = _mm256_shuffle_ps(zx, yz, _MM_SHUFFLE(3, 1, 3, 1));
  _mm256_storeu_ps(to, _mm256_permute2f128_ps(a, b, 0x20));
  _mm256_storeu_ps(to + 8, _mm256_permute2f128_ps(c, a, 0x30));
  _mm256_storeu_ps(to + 16, _mm256_permute2f128_ps(b, c, 0x31));
}

ESPALIER_INLINE void store_interleaved(const Vector<double> (&xyz)[3], double* to) {
  const __m256d xy = _mm256_unpacklo_pd(xyz[0].lanes, xyz[1].lanes);
  const __m256d zx = _mm256_shuffle_pd(xyz[2].lanes, xyz[0].lanes, 0b1010);
  const __m256d yz = _mm256_unpackhi_pd(xyz[1].lanes, xyz[2].lanes);
  _mm256_storeu_pd(to, _mm256_permute2f128_pd(xy, zx, 0x20));
  _mm256_storeu_pd(to + 4, _mm256_permute2f128_pd(yz, xy, 0x30));
  _mm256_storeu_pd(to + 8, _mm256_permute2f128_pd(zx, yz, 0x31));
}

/// a0 a0 a0 a1 a1 a1 …: a number for each of what store_interleaved() writes.
ESPALIER_INLINE void spread(Vector<float> a, Vector<float> (&out)[3]) {
  out[0] = {_mm256_permutevar8x32_ps(a.lanes, _mm256_setr_epi32(0, 0, 0, 1, 1, 1, 2, 2))};
  out[1] = {_mm256_permutevar8x32_ps(a.lanes, _mm256_setr_epi32(2, 3, 3, 3, 4, 4, 4, 5))};
  out[2] = {_mm256_permutevar8x32_ps(a.lanes, _mm256_setr_epi32(5, 5, 6, 6, 6, 7, 7, 7))};
}

ESPALIER_INLINE void spread(Vector<double> a, Vector<double> (&out)[3]) {
  out[0] = {_mm256_permute4x64_pd(a.lanes, _MM_SHUFFLE(1, 0, 0, 0))};
  out[1] = {_mm256_permute4x64_pd(a.lanes, _MM_SHUFFLE(2, 2, 1, 1))};
  out[2] = {_mm256_permute4x64_pd(a.lanes, _MM_SHUFFLE(3, 3, 3, 2))};
}

#else

template <>
struct Vector<float> {
  static constexpr std::size_t kWidth = 4;
  __m128 lanes;

  ESPALIER_INLINE static Vector all(float x) { return {_mm_set1_ps(x)}; }
  ESPALIER_INLINE static Vector load(const float* from) { return {_mm_loadu_ps(from)}; }
  ESPALIER_INLINE void store(float* to) const { _mm_storeu_ps(to, lanes); }
  ESPALIER_INLINE friend Vector operator+(Vector a, Vector b) {
    return {_mm_add_ps(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator-(Vector a, Vector b) {
    return {_mm_sub_ps(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator*(Vector a, Vector b) {
    return {_mm_mul_ps(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector fused(Vector a, Vector b, Vector c) { return a * b + c; }
  ESPALIER_INLINE friend Vector fused_negative(Vector a, Vector b, Vector c) { return c - a * b; }
  ESPALIER_INLINE friend Vector larger(Vector a, Vector b) {
    return {_mm_max_ps(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector flipped(Vector a, Vector b) {
    return {_mm_xor_ps(a.lanes, _mm_and_ps(b.lanes, _mm_set1_ps(-0.0F)))};
  }
  ESPALIER_INLINE friend Vector last_bit_as_sign(Vector a) {
    return {_mm_castsi128_ps(_mm_slli_epi32(_mm_castps_si128(a.lanes), 31))};
  }
  ESPALIER_INLINE friend Vector inverse_root_or_zero(Vector a) {
    const __m128 root = _mm_div_ps(_mm_set1_ps(1), _mm_sqrt_ps(a.lanes));
    return {_mm_and_ps(root, _mm_cmpgt_ps(a.lanes, _mm_setzero_ps()))};
  }
};

template <>
struct Vector<double> {
  static constexpr std::size_t kWidth = 2;
  __m128d lanes;

  ESPALIER_INLINE static Vector all(double x) { return {_mm_set1_pd(x)}; }
  ESPALIER_INLINE static Vector load(const double* from) { return {_mm_loadu_pd(from)}; }
  ESPALIER_INLINE void store(double* to) const { _mm_storeu_pd(to, lanes); }
  ESPALIER_INLINE friend Vector operator+(Vector a, Vector b) {
    return {_mm_add_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator-(Vector a, Vector b) {
    return {_mm_sub_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector operator*(Vector a, Vector b) {
    return {_mm_mul_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector fused(Vector a, Vector b, Vector c) { return a * b + c; }
  ESPALIER_INLINE friend Vector fused_negative(Vector a, Vector b, Vector c) { return c - a * b; }
  ESPALIER_INLINE friend Vector larger(Vector a, Vector b) {
    return {_mm_max_pd(a.lanes, b.lanes)};
  }
  ESPALIER_INLINE friend Vector flipped(Vector a, Vector b) {
    return {_mm_xor_pd(a.lanes, _mm_and_pd(b.lanes, _mm_set1_pd(-0.0)))};
  }
  ESPALIER_INLINE friend Vector last_bit_as_sign(Vector a) {
    return {_mm_castsi128_pd(_mm_slli_epi64(_mm_castpd_si128(a.lanes), 63))};
  }
  ESPALIER_INLINE friend Vector inverse_root_or_zero(Vector a) {
    const __m128d root = _mm_div_pd(_mm_set1_pd(1), _mm_sqrt_pd(a.lanes));
    return {_mm_and_pd(root, _mm_cmpgt_pd(a.lanes, _mm_setzero_pd()))};
  }
};

ESPALIER_INLINE void store_interleaved(const Vector<float> (&xyz)[3], float* to) {
  const __m128 x = xyz[0].lanes;
  const __m128 y = xyz[1].lanes;
  const __m128 z = xyz[2].lanes;
  const __m128 xy = _mm_shuffle_ps(x, y, _MM_SHUFFLE(2, 0, 2, 0));
  const __m128 yz = _mm_shuffle_ps(y, z, _MM_SHUFFLE(3, 1, 3, 1));
  const __m128 zx = _mm_shuffle_ps(z, x, _MM_SHUFFLE(3, 1, 2, 0));
  _mm_storeu_ps(to, _mm_shuffle_ps(xy, zx, _MM_SHUFFLE(2, 0, 2, 0)));
  _mm_storeu_ps(to + 4, _mm_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0)));
  _mm_storeu_ps(to + 8, _mm_shuffle_ps(zx, yz, _MM_SHUFFLE(3, 1, 3, 1)));
}

ESPALIER_INLINE void store_interleaved(const Vector<double> (&xyz)[3], double* to) {
  _mm_storeu_pd(to, _mm_unpacklo_pd(xyz[0].lanes, xyz[1].lanes));
  _mm_storeu_pd(to + 2, _mm_shuffle_pd(xyz[2].lanes, xyz[0].lanes, 0b10));
  _mm_storeu_pd(to + 4, _mm_unpackhi_pd(xyz[1].lanes, xyz[2].lanes));
}

ESPALIER_INLINE void spread(Vector<float> a, Vector<float> (&out)[3]) {
  out[0] = {_mm_shuffle_ps(a.lanes, a.lanes, _MM_SHUFFLE(1, 0, 0, 0))};
  out[1] = {_mm_shuffle_ps(a.lanes, a.lanes, _MM_SHUFFLE(2, 2, 1, 1))};
  out[2] = {_mm_shuffle_ps(a.lanes, a.lanes, _MM_SHUFFLE(3, 3, 3, 2))};
}

ESPALIER_INLINE void spread(Vector<double> a, Vector<double> (&out)[3]) {
  out[0] = {_mm_unpacklo_pd(a.lanes, a.lanes)};
  out[1] = a;
  out[2] = {_mm_unpackhi_pd(a.lanes, a.lanes)};
}

#endif

}  // namespace espalier::simd::ESPALIER_SIMD
