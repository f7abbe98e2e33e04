// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One part in 2^48 beside a tie, and then back. K·Z (Z = -z), a product of two binary32 numbers, misses a tie by one unit of
// its last place, one part in 2^47 to 2^48, or not at all. F_z is K(Z + e) with an excess e of the second order in the width
// of the bump or in x, so these can be chosen for K(Z + e) to be that tie, as nearly as binary32 numbers allow.

#include <optional>
#include <random>
#include <utility>

#include "candidate.h"
#include "fast/evaluate.h"

namespace forceshade::tests {

// a·b = a tie + beside, in units of its last place: 48 bits, rounded to 24.
struct BesideTie {
  std::uint64_t a, b;

  // For an odd a of 24 bits there is one such b, or none.
  static std::optional<BesideTie> of(std::uint64_t a, int beside) {
    std::uint64_t inverse = a;  // modulo 2^64, by Newton's method
    for (int i = 0; i < 6; ++i) inverse *= 2 - a * inverse;
    const std::uint64_t b = (inverse * static_cast<std::uint64_t>((1 << 23) + beside)) & 0xFFFFFF;
    if (b >> 23 == 0 || (a * b) >> 47 == 0) return std::nullopt;
    return BesideTie{a, b};
  }
  std::uint64_t product() const { return a * b; }
  float stiffness() const { return std::ldexp(static_cast<float>(a), -24); }  // 1/2 to 1 N/mm
  float depth() const { return std::ldexp(static_cast<float>(b), -11); }      // 4096 to 8192 mm
};

// Measures with BigFloatBall, for double-double cannot distinguish the nearest from ties.
template <class Definition>
void offer_beside_tie(Hardest& hardest, const Parameters& p, float x, float z) {
  using BigFloatBall = fast::BigFloatBall<Definition::kWideLimbs>;
  const fast::Built<Definition> law(p);
  const Truth known = truth(law.definition.template exact<BigFloatBall>(p, fast::wide_geometry<Definition>(p), x, z).z);
  if (known.from_tie == 0) return;
  hardest.offer("Fz: beside a tie and back", {p, x, z, -std::log2(known.from_tie)});
  const auto second = law.definition.template exact<DoubleDouble>(p, law.kept_geometry(), x, z);
  if (const double share = needed_error(second.z, known.right); share > 0)
    hardest.offer("Fz: double-double lands across a tie it is not on", {p, x, z, share});
}

// Unshaded, x = 0: F_z = K(depths·Z + e), and e grows with the square of w. For each radius there is one width; rounding it
// leaves a relative 2^-25 of 2^-48, and the best of N radii an N-th of that. excess(R, w/2, Z) must be good to 2^-60 of itself.
template <class Definition, class F>
void search_widths(Hardest& hardest, std::uint64_t tries, std::mt19937_64& random, double depths, const F& excess) {
  constexpr std::uint64_t kRadiiPerTie = 20000;
  double best = 2;
  for (std::uint64_t done = 0; done < tries; done += kRadiiPerTie) {
    const auto tie = BesideTie::of((random() & 0xFFFFFF) | 0x800001, -1);
    if (!tie) continue;
    const float z = -tie->depth() / static_cast<float>(depths);
    const long double Z = -z, wanted = tie->depth() / static_cast<long double>(tie->product());
    for (std::uint64_t i = 0; i < kRadiiPerTie; ++i) {
      const float R = 8192 + 0x1p-10F * static_cast<float>(random() % 1851392);  // up to the domain's end
      long double c = 0x1p-23L * R;
      for (int step = 0; step < 2; ++step) c *= std::sqrt(wanted / excess(R, c, Z));
      const auto half = static_cast<float>(c);
      const auto off = static_cast<double>(std::fabs(excess(R, half, Z) / wanted - 1));
      if (off > 4 * best || 2 * half < 1e-3F) continue;
      best = std::min(best, off);
      offer_beside_tie<Definition>(hardest, {R, 2 * half, tie->stiffness()}, 0, z);
    }
  }
}

// Shaded, on the edge, x = w/2, where H = 0: F_z = KZ·√(1 - x²/R²), so x/R is prescribed, and of all fractions of binary32
// numbers the convergents of its continued fraction come nearest: to 2^-48, and the best of N ties to an N-th of that. Every
// odd significand of K is tried.
template <class Definition>
void search_fractions(Hardest& hardest) {
  for (std::uint64_t a = (1U << 23) + 1; a < 1U << 24; a += 2) {
    const auto tie = BesideTie::of(a, 1);
    if (!tie) continue;
    const auto product = static_cast<long double>(tie->product());
    // √(1 - x²/R²) = (product - 1)/product; 2^23·x/R is in [1/2, 1).
    const long double ratio = std::ldexp(std::sqrt(2 * product - 1) / product, 23);
    long double rest = ratio;
    std::uint64_t x = 0, R = 1, last_x = 1, last_R = 0;
    while (rest != 0) {
      const long double inverse = 1 / rest;
      const auto whole = static_cast<std::uint64_t>(inverse);
      const std::uint64_t next_x = whole * x + last_x, next_R = whole * R + last_R;
      if (whole > 1U << 24 || next_R >= 1U << 24) break;
      last_x = std::exchange(x, next_x);
      last_R = std::exchange(R, next_R);
      rest = inverse - static_cast<long double>(whole);
    }
    const auto fR = static_cast<float>(R), fx = static_cast<float>(x);
    const long double off = std::fabs(static_cast<long double>(x) / (ratio * static_cast<long double>(R)) - 1);
    if (off > 0x1p-58L) continue;
    const int scale = 12 - std::ilogb(fR);  // R in [4096, 8192)
    const float edge = std::ldexp(fx, scale - 23);
    if (2 * edge >= 1e-3F)
      offer_beside_tie<Definition>(hardest, {std::ldexp(fR, scale), 2 * edge, tie->stiffness()}, edge, -tie->depth());
  }
}

inline long double bump_height(long double R, long double c) {
  return c * c / (R + std::sqrt((R - c) * (R + c)));
}

template <class Definition>
void search_beside_ties(Hardest& hardest, std::uint64_t tries, std::mt19937_64& random) {
  const auto height = [](long double R, long double c, long double) { return bump_height(R, c); };
  if constexpr (std::is_same_v<Definition, fast::Cylinder>) search_widths<Definition>(hardest, 20 * tries, random, 1, height);
  if constexpr (std::is_same_v<Definition, fast::BumpCylinder>)
    search_widths<Definition>(hardest, 20 * tries, random, 2, height);
  if constexpr (std::is_same_v<Definition, fast::Bump2p>)
    search_widths<Definition>(hardest, 20 * tries, random, 1, [](long double R, long double c, long double Z) {
      const long double sine = std::sqrt(bump_height(R, c) / (2 * R)), cosine = std::sqrt(1 - sine * sine);
      return c * sine - Z * sine * sine / (1 + cosine);
    });
  if constexpr (std::is_same_v<Definition, fast::Bump3p>)
    search_widths<Definition>(hardest, 20 * tries, random, 1, [](long double R, long double c, long double) {
      const long double t = c / (3 * R) + 4 * std::pow(c / (3 * R), 3) / 3;  // sin(α/3), for these bumps are all but flat
      return 4 * R * t * t * std::sqrt(1 - t * t);
    });
  if constexpr (requires(const Definition& law) { law.shading; }) search_fractions<Definition>(hardest);
}

}  // namespace forceshade::tests
