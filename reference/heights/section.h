// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The slope, the curvature and the kinks of a part along the line y = 0, over a whole stretch of it at once. Each kind has in
// its own header a slope_and_curvature_of(), for every x of a stretch that holds `inside` and has no kink or grid line in its
// interior, and a kink_of(), the kink strictly between two places, if there is one.

#include <optional>

#include "reference/heights/jet.h"
#include "reference/numbers/numbers.h"

namespace forceshade::reference {

struct SlopeAndCurvature {
  Enclosure slope;      // mm/mm: U_x
  Enclosure curvature;  // 1/mm: U_xx
};

using Kink = std::optional<const char*>;

namespace section {

inline SlopeAndCurvature level() {
  return {Enclosure(0), Enclosure(0)};
}

inline Enclosure exactly(float value) {
  return Enclosure(static_cast<double>(value));
}

inline Enclosure relative(const Enclosure& x, float centre) {
  return x + from_centre<Enclosure>(0, centre);
}

// The square of half the chord that the line y = 0 cuts out of a disk; exact at 192 bits, like all comparisons below.
inline Enclosure half_chord_squared(float radius_times_two, float centre_y) {
  const Enclosure half = exactly(radius_times_two) / 2, Y = relative(Enclosure(0), centre_y);
  return half * half - Y * Y;
}

inline bool is_within(const Enclosure& X, const Enclosure& chord_squared) {
  return lower(Enclosure(X * X)) < lower(chord_squared);
}

// A rim or an edge of a disk strictly between two places.
inline bool has_rim(const Enclosure& A, const Enclosure& B, const Enclosure& chord_squared) {
  if (lower(chord_squared) <= 0) return false;
  const auto beyond = [&](const Enclosure& X) { return lower(Enclosure(X * X - chord_squared)); };
  if (beyond(A) <= 0 && beyond(B) <= 0) return false;
  return beyond(A) < 0 || beyond(B) < 0 || (lower(A) < 0) != (lower(B) < 0);
}

inline Kink rim_of_disk(float centre_x, float centre_y, float diameter, double a, double b) {
  const bool has =
      has_rim(relative(Enclosure(a), centre_x), relative(Enclosure(b), centre_x), half_chord_squared(diameter, centre_y));
  return has ? Kink("the rim of a cap or cone") : std::nullopt;
}

}  // namespace section

}  // namespace forceshade::reference
