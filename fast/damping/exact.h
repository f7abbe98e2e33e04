// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The last word on damping: integers whose types prove that they hold every number of docs/damping.md. The lists of units say
// of which power of two each is a multiple.

#include <array>
#include <cmath>

#include "fast/meshes/vector3.h"
#include "fast/numbers/ball.h"
#include "fast/numbers/fixed_integer.h"
#include "forceshade/damping.h"

namespace forceshade::fast {

// A number in units of 2^kUnit, of which it is a whole multiple. |value| < 2^(kBits + kUnit).
template <int kBits, int kUnit>
FixedInteger<kBits> in_units_of(double value) noexcept {
  int exponent = 0;
  auto significand = static_cast<std::int64_t>(std::frexp(value, &exponent) * 0x1p53);
  if (significand == 0) return {};
  int shift = exponent - 53 - kUnit;
  if (shift < 0) {
    significand >>= -shift;  // zeros
    shift = 0;
  }
  return FixedInteger<kBits>::scaled(significand, shift);
}

inline Sign sign_named(int sign) noexcept {
  return sign < 0 ? Sign::negative : sign == 0 ? Sign::zero : Sign::positive;
}

// The binary32 nearest to over/under·2^kUnit; under > 0. Ties are multiples of 2^kTie below 2^kTieEnd in size.
template <int kUnit, int kTie, int kTieEnd, int kOver, int kUnder>
float nearest_quotient(const FixedInteger<kOver>& over, const FixedInteger<kUnder>& under) noexcept {
  // Within 2^-50, so that a neighbour of its rounding at most is nearest.
  const double quotient = std::ldexp(over.approximately() / under.approximately(), kUnit);
  const auto sign_beside = [&](double tie) {
    const auto times = in_units_of<kTieEnd - kTie, kTie>(tie) * under;
    if constexpr (kTie < kUnit)
      return sign_named(over.template shifted<kUnit - kTie>().compare(times));
    else
      return sign_named(over.compare(times.template shifted<kTie - kUnit>()));
  };
  return round_to_binary32(quotient, sign_beside).value_or(0.0F);  // three steps always suffice
}

// The velocity after a period: RN(v + α(r(x - x⁻)/n - v)), and what is below 2^-21 then stands for what is below 2^-20 mm/s.
[[gnu::noinline]] inline float exact_velocity(float v, float x, float before, const damping::Parameters& p,
                                              int periods) noexcept {
  const FixedInteger<5> n(periods);                                               // up to 16
  const auto rate = in_units_of<41, -23>(static_cast<double>(p.rate));            // up to 2^17
  const auto share = in_units_of<34, -33>(static_cast<double>(p.share));          // up to 1
  const auto now = n * in_units_of<76, -43>(static_cast<double>(v));              // v up to 2^32
  const auto gain = rate * (in_units(x) - in_units(before)) - now.shifted<33>();  // unit 2^-76
  const auto after = now.shifted<66>() + share * gain;                            // n times the velocity, unit 2^-109
  if (std::fabs(after.approximately()) < 0x1p-21 * 0x1p109 * periods) return 0;
  return nearest_quotient<-109, -46, 33>(after, n);
}

// f: not 0, each component below 2^26 N in size; velocities up to 2^32 mm/s.
[[gnu::noinline]] inline std::array<float, 3> exact_force(const std::array<float, 3>& velocity,
                                                          const std::array<float, 3>& force,
                                                          const damping::Parameters& p) noexcept {
  const auto forces = [&](std::size_t i) { return in_units_of<175, -149>(static_cast<double>(force[i])); };
  const auto speeds = [&](std::size_t i) { return in_units_of<76, -43>(static_cast<double>(velocity[i])); };
  const Vector3<FixedInteger<175>> f{forces(0), forces(1), forces(2)};
  const Vector3<FixedInteger<76>> v{speeds(0), speeds(1), speeds(2)};
  const auto square = ::forceshade::fast::square(f);                               // unit 2^-298
  const auto along = dot(v, f);                                                    // unit 2^-192
  const auto turn = in_units_of<48, -43>(static_cast<double>(p.damping)) * along;  // unit 2^-235
  const auto rest = square - turn.template shifted<63>();                          // f² - B v·f, unit 2^-298
  if (rest.sign() <= 0) return {};
  // N = s f², unit 2^-321.
  auto pressed = rest.template shifted<23>();
  if (std::isfinite(p.most)) {
    const auto most = in_units_of<34, -23>(static_cast<double>(p.most)) * square;
    if (most.compare(pressed) < 0) pressed = most;
  }
  // The components are below 2^38 N in size.
  if (p.drag == 0) {
    const auto component = [&](const auto& f_i) { return nearest_quotient<-172, -150, 39>(pressed * f_i, square); };
    return {component(f.x), component(f.y), component(f.z)};
  }
  const auto full_at = in_units_of<44, -33>(static_cast<double>(p.full_at));
  const auto full = full_at * full_at;  // F₀², unit 2^-66
  auto dragged = pressed;               // λ F₀²
  if (const auto limit = full.template shifted<255>(); limit.compare(pressed) < 0) dragged = limit;
  const auto drag = in_units_of<48, -43>(static_cast<double>(p.drag)) * dragged;  // unit 2^-364
  const auto component = [&](const auto& v_i, const auto& f_i) {
    const auto across = v_i * square - along * f_i;                                    // f² c, unit 2^-341
    const auto over = (pressed * full * f_i).template shifted<169>() - drag * across;  // unit 2^-705
    return nearest_quotient<-705 + 298 + 66, -150, 39>(over, full * square);
  };
  return {component(v.x, f.x), component(v.y, f.y), component(v.z, f.z)};
}

}  // namespace forceshade::fast
