// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy/shaded_strip.h"

#include "reference/numbers/intervals.h"

namespace forceshade::reference {
namespace {

// The place where a function on [low, high] changes its sign from + to -, as far as `is_before` and `is_after` are sure of it.
// Encloses the change if there is one, else the end that the function keeps its sign up to.
template <class Before, class After>
Enclosure change_between(Multiprecision low, Multiprecision high, const Before& is_before, const After& is_after) {
  for (unsigned bit = 0; bit < kEnergyBits; ++bit) {
    const Multiprecision middle = (low + high) / 2;
    if (is_before(Enclosure(middle)))
      low = middle;
    else if (is_after(Enclosure(middle)))
      high = middle;
    else
      break;
  }
  return {low, high};
}

}  // namespace

Enclosure circulation(const BumpGeometry<Enclosure>& g, const Strip& strip, const Enclosure& x,
                      const Enclosure& below_surface) {
  const Enclosure r = height_over_axis(g, x);
  return g.K / g.R * (x + strip.slope * r - below_surface * x / r);
}

ShadedStrip::ShadedStrip(const BumpGeometry<Enclosure>& g, const Strip& strip, const Enclosure& depth)
    : g_(g), strip_(strip), slope_(-strip.slope), depth_(depth) {
  start_ = larger(strip.left, g.R * slope_ / sqrt(1 + slope_ * slope_));
  const auto rate = [&](const Enclosure& x) { return slope_ * (g.R * g.R / (x * x) + 1) - x / height_over_axis(g, x); };
  const auto is_shallower = [&](const Enclosure& x) { return surely_less(sign_change(x), depth); };
  const auto is_deeper = [&](const Enclosure& x) { return surely_less(depth, sign_change(x)); };
  const Enclosure peak = change_between(
      lower(start_), upper(strip.right), [&](const Enclosure& x) { return surely_less(0, rate(x)); },
      [&](const Enclosure& x) { return surely_less(rate(x), 0); });
  first_ = change_between(lower(start_), upper(peak), is_shallower, is_deeper);
  second_ = change_between(lower(peak), upper(strip.right), is_deeper, is_shallower);
}

Enclosure ShadedStrip::sign_change(const Enclosure& x) const {
  const Enclosure r = height_over_axis(g_, x);
  return is_flat() ? r : r - slope_ * r * r / x;
}

// Antiderivative of (x - g r)·D - D²·x/2r, the integral of κ·R/K over δ from 0 to D.
Enclosure ShadedStrip::down_to_depth(const Enclosure& x) const {
  return depth_ * (x * x / 2 - slope_ * area_over_axis(g_, x)) + depth_ * depth_ * height_over_axis(g_, x) / 2;
}

// Antiderivative of (r/2x)·(x - g r)², the integral of κ·R/K over δ from 0 to q.
Enclosure ShadedStrip::down_to_sign_change(const Enclosure& x) const {
  const Enclosure s = x / g_.R, r = height_over_axis(g_, x), c = r / g_.R, g = slope_;
  Enclosure sum = -c * c * c / 3;
  if (!is_flat()) sum += g * (g * (log(x / (g_.R + r)) + c + c * c * c / 3) - 2 * (s - s * s * s / 3));
  return g_.R * g_.R * g_.R / 2 * sum;
}

Enclosure ShadedStrip::positive() const {
  const Enclosure shallow = down_to_sign_change(first_) - down_to_sign_change(start_) + down_to_sign_change(strip_.right) -
                            down_to_sign_change(second_);
  return larger(0, g_.K / g_.R * (shallow + down_to_depth(second_) - down_to_depth(first_)));
}

Enclosure ShadedStrip::negative() const {
  if (is_flat() && surely_at_most(depth_, height_over_axis(g_, strip_.right))) return 0;  // r is least there
  return larger(0, positive() - g_.K / g_.R * (down_to_depth(strip_.right) - down_to_depth(strip_.left)));
}

}  // namespace forceshade::reference
