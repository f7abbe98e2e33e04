// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The circulation under a shaded strip. With g = -slope, r = √(R² - x²) and the depth δ = H - z,
// κ = (K/R)·(x - g r - δ x/r), which is positive above the depth q(x) = r - g r²/x and negative below. q is concave, because
// its derivative -x/r + g(R²/x² + 1) falls. Callers hold exact_arithmetic.

#include "reference/energy/strips.h"

namespace forceshade::reference {

// κ in the depth `below_surface` at an x of the strip.
Enclosure circulation(const BumpGeometry<Enclosure>& g, const Strip& strip, const Enclosure& x, const Enclosure& below_surface);

class ShadedStrip {
 public:
  // depth: D, mm. Both must outlive this.
  ShadedStrip(const BumpGeometry<Enclosure>& g, const Strip& strip, const Enclosure& depth);

  // q, mm, for x > 0.
  Enclosure sign_change(const Enclosure& x) const;

  // q = 0 at `start`, or the strip begins there; q >= D exactly from `first` to `second`, which meet where it never is.
  const Enclosure& start() const { return start_; }
  const Enclosure& first() const { return first_; }
  const Enclosure& second() const { return second_; }

  // ∬κ⁺ and ∬κ⁻ down to the depth, mJ.
  Enclosure positive() const;
  Enclosure negative() const;

 private:
  bool is_flat() const { return lower(slope_) == 0 && upper(slope_) == 0; }
  Enclosure down_to_depth(const Enclosure& x) const;
  Enclosure down_to_sign_change(const Enclosure& x) const;

  const BumpGeometry<Enclosure>& g_;
  const Strip& strip_;
  Enclosure slope_, depth_;  // g, D
  Enclosure start_, first_, second_;
};

}  // namespace forceshade::reference
