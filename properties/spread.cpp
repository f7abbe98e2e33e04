// SPDX-License-Identifier: BSD-3-Clause
#include "properties/spread.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace forceshade::properties {
namespace {

// The domain that fast::Law::build() and reference::Law::build() state; mm and N/mm.
constexpr float kSmallestRadius = 0.1F, kLargestRadius = 1e4F, kSmallestWidth = 1e-3F;
constexpr float kSmallestStiffness = 1e-3F, kLargestStiffness = 1e3F;

}  // namespace

double ParameterSource::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

float ParameterSource::drawn(float low, float high, bool few_bits) {
  double value = std::exp2(uniform(std::log2(static_cast<double>(low)), std::log2(static_cast<double>(high))));
  if (few_bits) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    value = std::ldexp(std::round(std::ldexp(fraction, 6)), exponent - 6);
  }
  return std::clamp(static_cast<float>(value), low, high);
}

// R, w/2 and d are a Pythagorean triple times a power of two.
void ParameterSource::make_rational(Parameters& p) {
  constexpr std::array<std::array<float, 2>, 8> kTriples{
      {{5, 3}, {5, 4}, {13, 5}, {13, 12}, {17, 8}, {17, 15}, {25, 7}, {25, 24}}};
  const auto [hypotenuse, leg] = kTriples[random_() % kTriples.size()];
  const int scale = static_cast<int>(random_() % 14) - 5;  // 2^-5 · 5 to 2^8 · 25 mm
  p.radius = std::ldexp(hypotenuse, scale);
  p.width = std::ldexp(2 * leg, scale);
}

Parameters ParameterSource::next() {
  const std::uint64_t choice = random_();
  const bool few_bits = choice % 8 == 0, is_rational = choice % 8 == 1;
  Parameters p;
  p.radius = drawn(kSmallestRadius, kLargestRadius, few_bits);
  p.stiffness = drawn(kSmallestStiffness, kLargestStiffness, few_bits);
  const std::uint64_t end = choice / 8 % 48;  // of 48, six are an end
  if (end == 0) p.radius = kSmallestRadius;
  if (end == 1) p.radius = kLargestRadius;
  if (end == 2) p.stiffness = kSmallestStiffness;
  if (end == 3) p.stiffness = kLargestStiffness;
  p.width = drawn(kSmallestWidth, 2 * p.radius, few_bits);
  if (end == 4) p.width = kSmallestWidth;
  if (end == 5) p.width = 2 * p.radius;
  if (is_rational) make_rational(p);
  return p;
}

}  // namespace forceshade::properties
