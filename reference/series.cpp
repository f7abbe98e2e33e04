// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/series.h"

#include "forceshade/reference/numbers.h"
#include "forceshade/reference/slow_geometry.h"

namespace forceshade::reference {
namespace {

Enclosure enclosure_of(const Filter& x) {
  if (!std::isfinite(x.mid()) || !std::isfinite(x.rad())) throw Undecided{};
  return Enclosure(Multiprecision(x.low()), Multiprecision(x.high()));
}

// With room for a number too small for a long double.
Filter ball_of(const Enclosure& value) {
  const Filter ball = filter_of(value);
  if (!std::isfinite(ball.mid()) || !std::isfinite(ball.rad())) throw Undecided{};
  return {ball.mid(), ball.rad() + std::numeric_limits<long double>::min()};
}

}  // namespace

Filter exp(const Filter& x) {
  return ball_of(exp(enclosure_of(x)));
}

Filter sin(const Filter& x) {
  return ball_of(sin(enclosure_of(x)));
}

Filter cos(const Filter& x) {
  return ball_of(cos(enclosure_of(x)));
}

}  // namespace forceshade::reference
