// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A minimum by the simplex method of Nelder and Mead (1965), Comput. J. 7:308-313.

#include <algorithm>
#include <array>
#include <cstddef>

namespace forceshade::analysis {

template <std::size_t n>
struct Vertex {
  std::array<double, n> at;
  double value;
};

// Reflection 1, expansion 2, contraction and shrinking 1/2. Ends when the values at the corners differ by less than
// `tolerance`, or after `most_calls` of the function.
template <std::size_t n, class Function>
Vertex<n> minimum(const Function& function, const std::array<double, n>& start, double step, double tolerance, int most_calls) {
  using Point = std::array<double, n>;
  int calls = 0;
  const auto vertex = [&](const Point& at) {
    ++calls;
    return Vertex<n>{at, function(at)};
  };
  std::array<Vertex<n>, n + 1> corners;
  corners[0] = vertex(start);
  for (std::size_t i = 0; i < n; ++i) {
    Point at = start;
    at[i] += step;
    corners[i + 1] = vertex(at);
  }
  const auto by_value = [](const Vertex<n>& a, const Vertex<n>& b) { return a.value < b.value; };
  while (true) {
    std::ranges::stable_sort(corners, by_value);
    Vertex<n>& worst = corners[n];
    if (worst.value - corners[0].value < tolerance || calls >= most_calls) return corners[0];
    Point centre{};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) centre[k] += corners[i].at[k] / static_cast<double>(n);
    // On the line through the worst corner and the centre of the others, which are at -1 and 0.
    const auto on_line = [&](double place) {
      Point at;
      for (std::size_t k = 0; k < n; ++k) at[k] = centre[k] + place * (centre[k] - worst.at[k]);
      return vertex(at);
    };
    const Vertex<n> reflected = on_line(1);
    if (reflected.value < corners[0].value) {
      const Vertex<n> expanded = on_line(2);
      worst = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < corners[n - 1].value) {
      worst = reflected;
    } else {
      const Vertex<n> contracted = on_line(reflected.value < worst.value ? 0.5 : -0.5);
      if (contracted.value < std::min(reflected.value, worst.value)) {
        worst = contracted;
        continue;
      }
      for (std::size_t i = 1; i <= n; ++i) {
        Point at;
        for (std::size_t k = 0; k < n; ++k) at[k] = (corners[0].at[k] + corners[i].at[k]) / 2;
        corners[i] = vertex(at);
      }
    }
  }
}

}  // namespace forceshade::analysis
