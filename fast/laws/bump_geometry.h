// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// d, h, w′, h′ and the face angles of a bump, in any Ball arithmetic (fast/numbers/ball.h); R and w are as in laws.md's domain.

#include <cstdint>

#include "fast/numbers/ball.h"

namespace forceshade::fast {

// d = √((R - w/2)(R + w/2)), mm: depth of the cylinder's axis below the plane.
template <class N>
N axis_depth(float radius, float width) noexcept {
  const N R = N::exactly(static_cast<double>(radius));
  const N half = N::exactly(0.5 * static_cast<double>(width));
  return square_root((R - half) * (R + half));
}

// A side face of a polygonal bump: its height over the plane is tangent·(w/2 - |x|), its normal (±sine, cosine).
template <class N>
struct BumpFace {
  N sine, cosine, tangent;
};

// Two polygons: the face's slope angle is α/2 with sin α = w/2R. h = (w/2)·tangent.
template <class N>
BumpFace<N> two_polygon_face(float radius, float width) noexcept {
  const N R = N::exactly(static_cast<double>(radius));
  const N half = N::exactly(0.5 * static_cast<double>(width));
  const N sum = R + axis_depth<N>(radius, width);
  const N cosine = square_root(sum / (R + R));
  return {half / ((R + R) * cosine), cosine, half / sum};
}

// The root of an increasing or decreasing f in the interval `enclosure`, by Newton's method and then its interval form:
// root ∈ x - f(x)/f′(enclosure). `steps` brings a start good to 2^-50 to full precision.
template <class N, class F, class Derivative>
N newton_root(double start, int steps, const F& f, const Derivative& derivative) noexcept {
  N x = N::exactly(start);
  for (int i = 1; i <= steps; ++i) x = truncated(x - f(x) / derivative(x), std::int64_t{50} << i);
  return x - f(x) / derivative(widened(x, -40));
}

// t = sin(α/3), the root of 4t³ - 3t + s = 0 in (0, ½], s = w/2R. Towards s = 1 two roots meet at ½, so there
// u = ½ - t is found instead, from 6u² - 4u³ = 1 - s, in which s → 1 costs no accuracy.
template <class N>
N sine_of_third(float radius, float width) noexcept {
  const double R = static_cast<double>(radius);
  const double half = 0.5 * static_cast<double>(width);
  const double s = half / R;
  const N one = N::exactly(1);
  const N exact_s = N::exactly(half) / N::exactly(R);
  if (s <= 0.5) {
    double t = s / 3;
    for (int i = 0; i < 4; ++i) t -= ((4 * t * t - 3) * t + s) / (12 * t * t - 3);
    const auto f = [&](const N& y) { return (N::exactly(4) * y * y - N::exactly(3)) * y + exact_s; };
    const auto derivative = [](const N& y) { return N::exactly(12) * y * y - N::exactly(3); };
    return newton_root<N>(t, N::kNewtonSteps, f, derivative);
  }
  const N half_turn = N::exactly(0.5);
  if (half == R) return half_turn;
  const double rest = (R - half) / R;
  double u = std::sqrt(rest / 5);
  for (int i = 0; i < 5; ++i) u -= ((6 - 4 * u) * u * u - rest) / (12 * u * (1 - u));
  const N exact_rest = N::exactly(R - half) / N::exactly(R);
  const auto f = [&](const N& y) { return (N::exactly(6) - N::exactly(4) * y) * y * y - exact_rest; };
  const auto derivative = [&](const N& y) { return N::exactly(12) * y * (one - y); };
  return half_turn - newton_root<N>(u, N::kNewtonSteps, f, derivative);
}

// Three polygons: the side faces' slope angle is θ = 2α/3; the flat top is w′ wide and h′ high.
template <class N>
struct ThreePolygons {
  N half_top;  // w′/2, mm
  N height;    // h′, mm
  BumpFace<N> face;
};

template <class N>
ThreePolygons<N> three_polygons(float radius, float width) noexcept {
  const N one = N::exactly(1);
  const N t = sine_of_third<N>(radius, width);
  const N half_top = N::exactly(static_cast<double>(radius)) * t;
  const N sine = N::exactly(2) * t * square_root((one - t) * (one + t));
  const N cosine = one - N::exactly(2) * t * t;
  return {half_top, N::exactly(2) * half_top * sine, {sine, cosine, sine / cosine}};
}

}  // namespace forceshade::fast
