// SPDX-License-Identifier: BSD-3-Clause
// The naive loops with the base instructions, and the constants that all naive loops share.

#include "tests/bench/naive.h"

#include <cmath>

namespace forceshade::bench {

const NaiveTable kNaive = kNaiveLoops;

NaiveBump naive_bump(const Parameters& p) {
  const double R = static_cast<double>(p.radius);
  const double half = 0.5 * static_cast<double>(p.width);
  const double alpha = std::asin(half / R);
  const double d = std::sqrt(R * R - half * half);
  const double theta = 2 * alpha / 3;
  const double w_top = 2 * (half * std::cos(theta) - d * std::sin(theta));
  const double h_top = half * std::sin(theta) + d * std::cos(theta) - d;
  const auto f = [](double value) { return static_cast<float>(value); };
  return {p.radius,
          p.width,
          p.stiffness,
          f(d),
          f(R - d),
          f(w_top),
          f(h_top),
          f(std::sin(alpha / 2)),
          f(std::cos(alpha / 2)),
          f(std::sin(theta)),
          f(std::cos(theta))};
}

}  // namespace forceshade::bench
