// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bits that an exact number can take: the number on which the compiler runs the longest expressions of the shaded force,
// once, to prove that the last stage's numbers hold them.

#include <algorithm>

#include "fast/meshes/vector3.h"

namespace forceshade::fast {

// A whole multiple of 2^low that is below 2^high in size.
struct BitSpan {
  int low, high;

  constexpr int bits() const noexcept { return high - low; }

  friend constexpr BitSpan operator+(const BitSpan& a, const BitSpan& b) noexcept {
    return {a.low < b.low ? a.low : b.low, (a.high > b.high ? a.high : b.high) + 1};
  }
  friend constexpr BitSpan operator-(const BitSpan& a, const BitSpan& b) noexcept { return a + b; }
  friend constexpr BitSpan operator*(const BitSpan& a, const BitSpan& b) noexcept { return {a.low + b.low, a.high + b.high}; }
};

// The longest bits of a, b or of what lies between the two when they are subtracted.
constexpr int bits_to_compare(const BitSpan& a, const BitSpan& b) noexcept {
  return (a - b).bits();
}

// ---- What the shaded force is made of, in mm and N/mm.

inline constexpr BitSpan kCoordinateSpan{-53, 14};  // 0, or 2^-30 to 10^4 mm
inline constexpr BitSpan kNormalSpan{-149, 128};    // a corner normal's component: any finite binary32
inline constexpr BitSpan kWeightSpan{0, 25};        // a parameter of the grid, up to 2^24
inline constexpr BitSpan kStiffnessSpan{-33, 10};   // a binary32 in [10^-3, 10^3]
inline constexpr BitSpan kTieSpan{-150, 129};       // midway between two neighbours in binary32
inline constexpr BitSpan kUnitSpan{-149, 1};        // a component of a unit vector, rounded to binary32
using Span3 = Vector3<BitSpan>;

constexpr Span3 all_three(const BitSpan& span) noexcept {
  return {span, span, span};
}
constexpr Span3 scaled_span(const BitSpan& factor, const Span3& a) noexcept {
  return {factor * a.x, factor * a.y, factor * a.z};
}
// The span of the binary32 nearest to the length of a vector.
constexpr BitSpan rounded_length(const Span3& a) noexcept {
  return {-149, square(a).high / 2 + 2};
}

// A way r - p = vector/length, and a direction that a force along it can have.
struct ShadedCase {
  Span3 way;
  BitSpan length;
  Span3 direction;
};

// The comparison of the square of K |way| direction/(length |direction|) with that of a tie, less the fractions.
constexpr int bits_of_force(const ShadedCase& of) noexcept {
  const BitSpan size = kStiffnessSpan * of.direction.x, bound = kTieSpan * of.length;
  return bits_to_compare(size * size * square(of.way), bound * bound * square(of.direction));
}
// The sign of way·direction, which comes before it.
constexpr int bits_of_side(const ShadedCase& of) noexcept {
  return dot(of.way, of.direction).bits();
}
constexpr int most_bits(const ShadedCase& of) noexcept {
  return bits_of_force(of) > bits_of_side(of) ? bits_of_force(of) : bits_of_side(of);
}

inline constexpr Span3 kEdgeSpan = all_three(kCoordinateSpan - kCoordinateSpan);  // also p less a corner
inline constexpr Span3 kFaceNormalSpan = cross(kEdgeSpan, kEdgeSpan);
// From a goal to r, and from p past the goal: -(n·w) n, over n·n; e x (e x w), over e·e.
inline constexpr Span3 kFootInTriangle = scaled_span(dot(kFaceNormalSpan, kEdgeSpan), kFaceNormalSpan);
inline constexpr Span3 kFootOnEdge = cross(kEdgeSpan, cross(kEdgeSpan, kEdgeSpan));
inline constexpr Span3 kWayInTriangle = all_three(kFootInTriangle.x + square(kFaceNormalSpan) * kEdgeSpan.x);
inline constexpr Span3 kWayOnEdge = all_three(kFootOnEdge.x + square(kEdgeSpan) * kEdgeSpan.x);
inline constexpr Span3 kWayAtGridPoint =
    all_three(kWeightSpan * kEdgeSpan.x + kWeightSpan * kEdgeSpan.x + kWeightSpan * kEdgeSpan.x);

// The spans of a corner's weight in a triangle, and of an end's on an edge.
inline constexpr BitSpan kWeightInTriangle = square(kFaceNormalSpan) - (dot(cross(kEdgeSpan, kEdgeSpan), kFaceNormalSpan) +
                                                                        dot(cross(kEdgeSpan, kEdgeSpan), kFaceNormalSpan));
inline constexpr BitSpan kWeightOnEdge = square(kEdgeSpan) - dot(kEdgeSpan, kEdgeSpan);

// The vertex scheme: three normals, interpolated; two of them; and across an edge, α q1 N1 + β q2 N2.
constexpr Span3 interpolated(const BitSpan& weight) noexcept {
  const BitSpan one = weight * kNormalSpan;
  return all_three(one + one + one);
}
constexpr Span3 across_edge(const Span3& way, const BitSpan& weight) noexcept {
  const BitSpan part = dot(cross(way, kFaceNormalSpan), cross(kFaceNormalSpan, kFaceNormalSpan));
  const BitSpan one = part * rounded_length(kFaceNormalSpan) * interpolated(weight).x;
  return all_three(one + one);
}
// The edge scheme: weight·side·side·(N + N' + N + N''), three of them.
constexpr Span3 by_edges(const BitSpan& weight) noexcept {
  const BitSpan side = rounded_length(kEdgeSpan), pair = kUnitSpan + kUnitSpan, one = weight * (side * side) * (pair + pair);
  return all_three(one + one + one);
}

inline constexpr BitSpan kGridSpan{24, 25};  // 2^24
inline constexpr ShadedCase kShadedCases[]{
    {kWayInTriangle, square(kFaceNormalSpan), interpolated(kWeightInTriangle)},
    {kWayInTriangle, square(kFaceNormalSpan), by_edges(kWeightInTriangle)},
    {kWayOnEdge, square(kEdgeSpan), interpolated(kWeightOnEdge)},
    {kWayOnEdge, square(kEdgeSpan), across_edge(kWayOnEdge, kWeightOnEdge)},
    {kWayAtGridPoint, kGridSpan, interpolated(kWeightSpan)},
    {kWayAtGridPoint, kGridSpan, by_edges(kWeightSpan)},
    {kWayAtGridPoint, kGridSpan, across_edge(kWayAtGridPoint, kWeightSpan)},
};

// Cases in which friction takes a part of the force: what presses, at the point of the grid, and its directions; and r - q less
// the fraction 1/(2^24 length), which is added to the root.
inline constexpr ShadedCase kPulledCases[]{
    {kFootInTriangle, square(kFaceNormalSpan), interpolated(kWeightSpan)},
    {kFootInTriangle, square(kFaceNormalSpan), by_edges(kWeightSpan)},
    {kFootInTriangle, square(kFaceNormalSpan), across_edge(kFootInTriangle, kWeightSpan)},
    {kFootOnEdge, square(kEdgeSpan), interpolated(kWeightSpan)},
    {kFootOnEdge, square(kEdgeSpan), across_edge(kFootOnEdge, kWeightSpan)},
};
constexpr int bits_of_pulled_force(const ShadedCase& of) noexcept {
  const BitSpan pull = of.length * kWayAtGridPoint.x - kGridSpan * of.way.x, root = kStiffnessSpan * of.direction.x;
  const BitSpan rest = kTieSpan * (kGridSpan * of.length) - kStiffnessSpan * pull;
  return bits_to_compare(kGridSpan * kGridSpan * (root * root * square(of.way)), rest * rest * square(of.direction));
}

constexpr int most_bits_of_shaded_force() noexcept {
  int most = 0;
  for (const ShadedCase& one : kShadedCases)
    if (most_bits(one) > most) most = most_bits(one);
  for (const ShadedCase& one : kPulledCases)
    if (const int bits = std::max(bits_of_side(one), bits_of_pulled_force(one)); bits > most) most = bits;
  return most;
}

}  // namespace forceshade::fast
