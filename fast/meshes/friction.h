// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides for friction where the god-object would slide: whether it is held, how far it slips, and whether it slips on
// (docs/friction.md). At its point g the hand pulls it by t along the surface and presses it by z across: p is off by t along
// the slide and by z at a right angle to it.

#include "fast/meshes/rests.h"

namespace forceshade::fast {

inline constexpr RoundingBound kPulled = cross(kNormal, kOffset).x;       // a component of n x U
inline constexpr RoundingBound kPressed = cross(kDifference, kOffset).x;  // of e x U

// t² and z², both times the same positive number.
struct Load {
  DoubleWithError pull, pressure;
};

// The square of a vector whose components have this error.
FORCESHADE_INLINE DoubleWithError square_of(const Vector3<double>& a, double error) noexcept {
  const DoubleWithError x{a.x, error}, y{a.y, error}, z{a.z, error};
  return x * x + y * y + z * z;
}

// In a triangle: times n². U: 2^24(p - g).
FORCESHADE_INLINE Load load_in_triangle(const FaceNumbers& face, const Offset& U) noexcept {
  const DoubleWithError across{dot(face.n, U.U), kAcross.error * face.area * U.size};
  return {square_of(cross(face.n, U.U), kPulled.error * face.area * U.size), across * across};
}
// Along an edge e: times e².
FORCESHADE_INLINE Load load_on_edge(const Vector3<double>& e, const Offset& U) noexcept {
  const double size = size_of(e);
  const DoubleWithError along{dot(e, U.U), kAlong.error * size * U.size};
  return {along * along, square_of(cross(e, U.U), kPressed.error * size * U.size)};
}

// The same in integers.
template <class Pull, class Pressure>
struct ExactLoad {
  Pull pull;
  Pressure pressure;
};
template <class Pull, class Pressure>  // clang++ before version 17 deduces the types of no aggregate
ExactLoad(Pull, Pressure)->ExactLoad<Pull, Pressure>;
inline auto exact_load_in_triangle(const Face& face, const ExactOffset& U) noexcept {
  const auto n = ExactFace(face).n;
  const auto across = dot(n, U);
  return ExactLoad{square(cross(n, U)), across * across};
}
inline auto exact_load_on_edge(const ExactDifference& e, const ExactOffset& U) noexcept {
  const auto along = dot(e, U);
  return ExactLoad{along * along, square(cross(e, U))};
}

// The sign of (share/2^24)² t² - μ² z², the one polynomial that friction decides by. share: up to 2^25; coefficient: finite.
template <class Pull, class Pressure>
[[gnu::noinline]] int exact_order(const ExactLoad<Pull, Pressure>& load, std::uint32_t share, float coefficient) noexcept {
  const FixedInteger<26> of_pull(std::int64_t{share});
  const FixedInteger<44> of_pressure(static_cast<std::int64_t>(std::ldexp(static_cast<double>(coefficient), 33)));
  return (load.pull * (of_pull * of_pull)).template shifted<18>().compare(load.pressure * (of_pressure * of_pressure));
}

// exact(): the load in integers.
template <class Stages, class Exact>
class Friction {
 public:
  FORCESHADE_INLINE Friction(const Load& load, const Coefficients& of, const Stages& stages, const Exact& exact) noexcept
      : load_(load), of_(of), stages_(stages), exact_(exact) {}

  FORCESHADE_INLINE bool holds(bool is_slipping) const noexcept {
    return order(kGrid, is_slipping ? of_.dynamic_friction : of_.static_friction) <= 0;
  }
  // True if a god-object that slips goes on to do so, though it rests: t > μd z/2.
  FORCESHADE_INLINE bool slips_on() const noexcept { return order(2 * kGrid, of_.dynamic_friction) > 0; }

  // True if a slip that leaves this share of the way surely comes nearer to p, by more than the rounding of its end can take
  // away: a third of the square of the longest side of the grid's part (docs/friction.md). all: what the load is multiplied by;
  // longest: the square of the longest side of the triangle, or of the edge, or more.
  FORCESHADE_INLINE bool surely_brings_nearer(std::uint32_t left, double all, double longest) const noexcept {
    const double gone = 0x1p-24 * static_cast<double>(kGrid - left);
    return stages_.sure(3 * gone * (load_.pull.value - load_.pull.error) > (1 + 0x1p-20) * longest * all);
  }

  // The part of the way to p's nearest point that it stays behind if it is not held, in units of 2^-24, which is less than
  // 2^24: the most with which (share t)² <= (μd z)².
  FORCESHADE_INLINE std::uint32_t share_left() const noexcept {
    if (of_.dynamic_friction == 0) return 0;
    if (of_.dynamic_friction < HUGE_VALF) {
      const DoubleWithError share =
          times(0x1p24 * static_cast<double>(of_.dynamic_friction), square_root(load_.pressure / load_.pull));
      const auto floor = static_cast<std::int64_t>(share.value < 0x1p24 ? share.value : 0);
      if (stages_.sure(share.value - share.error > static_cast<double>(floor) + 0x1p-27 &&
                       share.value + share.error < static_cast<double>(floor) + (1 - 0x1p-27))) [[likely]]
        return static_cast<std::uint32_t>(floor);
    }
    return exact_share_left();
  }

 private:
  // The sign of (share/2^24)² t² - μ² z²; an infinite coefficient times no pressure is 0.
  FORCESHADE_INLINE int order(std::uint32_t share, float coefficient) const noexcept {
    if (coefficient == HUGE_VALF) {
      const int pressed = sign_of(load_.pressure, stages_, [&] { return exact_().pressure.sign(); });
      return pressed > 0 ? -1 : sign_of(load_.pull, stages_, [&] { return exact_().pull.sign(); });
    }
    const double pull = 0x1p-24 * static_cast<double>(share), pressure = static_cast<double>(coefficient);
    return sign_of(times(pull * pull, load_.pull) - times(pressure * pressure, load_.pressure), stages_,
                   [&] { return exact_order(exact_(), share, coefficient); });
  }

  [[gnu::noinline]] std::uint32_t exact_share_left() const noexcept {
    stages_.note(Stage::wide);
    const auto load = exact_();
    if (load.pressure.is_zero()) return 0;  // so it is with an infinite coefficient, which would have held it
    // Within a unit, for it is less than 2^24.
    const double guess = 0x1p24 * static_cast<double>(of_.dynamic_friction) *
                         std::sqrt(load.pressure.approximately() / load.pull.approximately());
    auto share = static_cast<std::uint32_t>(guess < 0x1p24 ? guess : 0x1p24 - 1);
    while (exact_order(load, share, of_.dynamic_friction) > 0) --share;
    while (exact_order(load, share + 1, of_.dynamic_friction) <= 0) ++share;
    return share;
  }

  const Load& load_;
  const Coefficients& of_;
  const Stages& stages_;
  const Exact& exact_;
};

// The god-object's weight after it has gone all but `left` of the way from the weight G/2^24 to that of p's nearest point,
// q/all: over all.
FORCESHADE_INLINE DoubleWithError weight_after(std::uint32_t left, std::uint32_t G, const DoubleWithError& q,
                                               const DoubleWithError& all) noexcept {
  return times(0x1p-48 * (static_cast<double>(left) * static_cast<double>(G)), all) +
         times(0x1p-24 * static_cast<double>(kGrid - left), q);
}
// The same over 2^48 all.
template <int kQ, int kAll>
auto exact_weight_after(std::uint32_t left, std::uint32_t G, const FixedInteger<kQ>& q,
                        const FixedInteger<kAll>& all) noexcept {
  return all * FixedInteger<49>(static_cast<std::int64_t>(std::uint64_t{left} * G)) +
         (q * FixedInteger<26>(std::int64_t{kGrid - left})).template shifted<24>();
}

}  // namespace forceshade::fast
