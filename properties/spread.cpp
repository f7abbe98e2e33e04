// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/spread.h"

#include <algorithm>
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

Parameters ParameterSource::next() {
  const std::uint64_t choice = random_();
  const bool few_bits = choice % 4 == 0;
  Parameters p;
  p.radius = drawn(kSmallestRadius, kLargestRadius, few_bits);
  p.stiffness = drawn(kSmallestStiffness, kLargestStiffness, few_bits);
  const std::uint64_t end = choice / 4 % 48;  // of 48, six are an end
  if (end == 0) p.radius = kSmallestRadius;
  if (end == 1) p.radius = kLargestRadius;
  if (end == 2) p.stiffness = kSmallestStiffness;
  if (end == 3) p.stiffness = kLargestStiffness;
  p.width = drawn(kSmallestWidth, 2 * p.radius, few_bits);
  if (end == 4) p.width = kSmallestWidth;
  if (end == 5) p.width = 2 * p.radius;
  return p;
}

}  // namespace forceshade::properties
