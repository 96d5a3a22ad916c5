#pragma once

/// Bernstein coefficients along one line, and the lines of a tensor grid: the steps that scalar
/// polynomials and Bézier patches share. T: double or a vector of doubles.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace espalier {

/// n over k, exact up to n = 56.
[[nodiscard]] inline double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) {
    result = result * (n - k + i) / i;
  }
  return result;
}

/// Number of coefficients of a degree per axis.
[[nodiscard]] inline std::size_t n_coefficients(const std::array<int, 3>& degree) {
  return static_cast<std::size_t>((degree[0] + 1) * (degree[1] + 1) * (degree[2] + 1));
}

/// One step of de Casteljau's algorithm: line[i] becomes (1 − t) line[i] + t line[i+1]; the last
/// coefficient stays.
template <class T>
void de_casteljau_step(std::span<T> line, double t) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    line[i] = (1 - t) * line[i] + t * line[i + 1];
  }
}

/// The part [low, high]: coefficient i is the polynomial's blossom at n−i times `low` and i times
/// `high`. Ends are exact at 0 and 1; low and high may lie outside [0,1].
template <class T>
[[nodiscard]] std::vector<T> part_of_line(std::span<const T> line, double low, double high) {
  std::vector<T> result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::vector<T> blossom(line.begin(), line.end());
    for (std::size_t left = line.size(); left > 1; --left) {
      de_casteljau_step(std::span(blossom).first(left), left > i + 1 ? low : high);
    }
    result.push_back(blossom[0]);
  }
  return result;
}

/// The same polynomial, one degree higher.
template <class T>
[[nodiscard]] std::vector<T> elevated_line(std::span<const T> line) {
  std::vector<T> result = {line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(line.size());
    result.push_back(t * line[i - 1] + (1 - t) * line[i]);
  }
  result.push_back(line.back());
  return result;
}

/// Replaces every line along `axis` by make(line); `degree` becomes that of the result.
template <class T, class Make>
[[nodiscard]] std::vector<T> with_lines(std::array<int, 3>& degree, std::span<const T> values,
                                        int axis, const Make& make) {
  const auto along = static_cast<std::size_t>(axis);
  const auto n = static_cast<std::size_t>(degree[along] + 1);
  std::size_t stride = 1;
  for (std::size_t a = 0; a < along; ++a) {
    stride *= static_cast<std::size_t>(degree[a] + 1);
  }
  std::vector<T> result;
  std::vector<T> line(n);
  std::size_t n_made = n;
  for (std::size_t first = 0; first < values.size(); first += n * stride) {
    for (std::size_t offset = 0; offset < stride; ++offset) {
      for (std::size_t i = 0; i < n; ++i) {
        line[i] = values[first + offset + i * stride];
      }
      const std::vector<T> made = make(std::span<const T>(line));
      n_made = made.size();
      result.resize(values.size() / n * n_made);
      for (std::size_t i = 0; i < n_made; ++i) {
        result[first / n * n_made + offset + i * stride] = made[i];
      }
    }
  }
  degree[along] = static_cast<int>(n_made) - 1;
  return result;
}

}  // namespace espalier
