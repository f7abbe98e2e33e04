// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The batch's form of the laws of polygons, shaded or not (fast/simd/form.inl): a gap times a normal inside of the bump, the
// wall beside it.
//
// The gap of a side is slope·(w/2 - |x|) - z. The difference is exact where |x| is 0 or not far below w/2, and the fused
// product rounds once, relative to what is left: three operations in place of the first stage's eight. x is taken as |x|, and
// the force given the sign in the end. Errors: bump_form.g.

#include <algorithm>
#include <cmath>

#include "fast/laws/polygon_gap.h"
#include "fast/simd/form.inl"
#include "fast/simd/wall_form.inl"

namespace forceshade::fast {
namespace {

// Below this share of w/2, other than 0, |x| makes w/2 - |x| round.
inline constexpr double kLeastShareOfWidth = 0x1p-28;
// Nearer to the surface than this share of the bump's height, a gap is known too roughly.
inline constexpr double kLeastShareOfHeight = 0x1p-20;

inline float least_coordinate_of(double half_width) {
  return std::max(kPositionQuantum, static_cast<float>(kLeastShareOfWidth * half_width));
}

// On a flat polygon the gap is -z, exactly.
struct GapOfPlane {
  static constexpr double least = 0;
  static constexpr float least_coordinate = kPositionQuantum;

  template <class Law>
  explicit GapOfPlane(const Law&) {}
  FORCESHADE_INLINE Two at(Watch&, Floats, const Two& z) const { return -z; }
};

struct GapOfSides {
  Two half_width, slope, slope_tail;
  double least;
  float least_coordinate;

  GapOfSides(const LinearGap& gap, double half)
      : half_width(half),
        slope(gap.slope.head),
        slope_tail(gap.slope.tail),
        least(kLeastShareOfHeight * gap.height),
        least_coordinate(least_coordinate_of(half)) {}
  template <class Law>
  explicit GapOfSides(const Law& law) : GapOfSides(law.gap, law.half_width) {}

  FORCESHADE_INLINE Two at(Watch& watch, Floats size_of_x, const Two& z) const {
    return from_edge(watch, half_width - widened(size_of_x), slope_tail, z);
  }
  FORCESHADE_INLINE Two from_edge(Watch& watch, const Two& distance, const Two& tail, const Two& z) const {
    const Two gap = fused_add(tail, distance, fused_less(slope, distance, z));
    watch.distance(gap.first, gap.second);
    return gap;
  }
};

struct TopEdge {
  Floats edge;  // the last binary32 on the top
  Two wide_edge;

  explicit TopEdge(float half_top) : edge(half_top), wide_edge(static_cast<double>(half_top)) {}
  FORCESHADE_INLINE Two::Mask holds(Floats size_of_x) const { return widened(size_of_x) <= wide_edge; }
};

// A flat top is as high as the side at its last binary32, and what is missing to h′ is in the tail.
struct GapOfSidesAndTop : GapOfSides {
  TopEdge top;
  Two top_tail;

  template <class Law>
  explicit GapOfSidesAndTop(const Law& law)
      : GapOfSides(law.gap.side, law.half_width),
        top(law.half_top),
        top_tail(tail_of(law.gap.top, law.gap.side.slope.head, law.half_width - static_cast<double>(law.half_top))) {}
  static double tail_of(const LinearGap& top, double slope, double from_edge) {
    return (std::fma(-slope, from_edge, top.height) + top.height_tail) / from_edge;
  }

  FORCESHADE_INLINE Two at(Watch& watch, Floats size_of_x, const Two& z) const {
    return from_edge(watch, half_width - widened(larger(size_of_x, top.edge)),
                     select(top.holds(size_of_x), top_tail, slope_tail), z);
  }
};

// The normals of |x|, times K and the depth.
struct NormalOfSides {
  Two K_sine, K_cosine;

  template <class Law>
  explicit NormalOfSides(const Law& law) : K_sine(law.K_sine), K_cosine(law.K_cosine) {}
  template <class Law>
  static double stiffness(const Law& law) {
    return law.K;
  }
  FORCESHADE_INLINE Components times(const Two& depth, Floats) const { return {depth * K_sine, depth * K_cosine}; }
  FORCESHADE_INLINE Floats::Mask leans(Floats, Floats::Mask is_inside) const { return is_inside; }
};

struct NormalOfSidesAndTop : NormalOfSides {
  Two K;
  TopEdge top;

  template <class Law>
  explicit NormalOfSidesAndTop(const Law& law) : NormalOfSides(law), K(law.K), top(law.half_top) {}
  FORCESHADE_INLINE Components times(const Two& depth, Floats size_of_x) const {
    return {depth * K_sine, depth * select(top.holds(size_of_x), K, K_cosine)};
  }
  FORCESHADE_INLINE Floats::Mask leans(Floats size_of_x, Floats::Mask is_inside) const {
    return is_inside & (size_of_x > top.edge);
  }
};

struct NormalOfCylinder {
  Two K_over_R, R_squared;

  template <class Law>
  explicit NormalOfCylinder(const Law& law) : K_over_R(law.shading.K_over_R), R_squared(law.shading.R * law.shading.R) {}
  template <class Law>
  static double stiffness(const Law& law) {
    return law.shading.K_over_R * law.shading.R;  // K, once it is rounded to binary32
  }
  FORCESHADE_INLINE Components times(const Two& depth, Floats size_of_x) const {
    const Two x = widened(size_of_x), scale = depth * K_over_R;
    return {scale * x, scale * square_root(fused_subtract_from(x, x, R_squared))};  // R² is exact
  }
  FORCESHADE_INLINE Floats::Mask leans(Floats, Floats::Mask is_inside) const { return is_inside; }
};

template <class Definition, class Gap, class Normal>
struct BumpForm {
  static constexpr int kWindow = doubt_window(Definition::kErrorBound);

  Gap gap;
  Normal normal;
  WallForm plane;  // beside the bump
  Floats half_width;

  explicit BumpForm(const Definition& law) : gap(law), normal(law), plane(Normal::stiffness(law)), half_width(law.half_width) {}

  float least_coordinate() const { return gap.least_coordinate; }
  double least_distance() const { return gap.least; }

  FORCESHADE_INLINE Components components(Watch& watch, const float* x, const float* z) const {
    const Floats size_of_x = absolute(Floats::load(x));
    const Two depth = larger(gap.at(watch, size_of_x, Two::load(z)), Two(0));
    return normal.times(depth, size_of_x);
  }
  // The components are those of |x|.
  FORCESHADE_INLINE Forces forces(Floats of_size, Floats up, Floats x, Floats z) const {
    const Floats size_of_x = absolute(x);
    const Floats::Mask is_inside = size_of_x <= half_width;
    const Floats zero(0.0F);  // added, it turns -0 into +0: x = -0 lies to the right
    const Floats sideways = times_sign(of_size, x + zero) & normal.leans(size_of_x, is_inside);
    return {sideways + zero, select(is_inside, up, plane.force_z(z))};
  }
};

}  // namespace
}  // namespace forceshade::fast
