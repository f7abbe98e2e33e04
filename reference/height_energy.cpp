// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/height_energy.h"

#include <cmath>

#include "forceshade/reference/height_circulation.h"
#include "forceshade/reference/strips.h"

namespace forceshade::reference {
namespace {

Interval paid(const HeightLaw& law, const Filter& over_stiffness) {
  const Filter energy = Filter(static_cast<double>(law.stiffness())) * over_stiffness;
  if (!is_finite(energy)) throw NotEnclosed("an energy that is not finite");
  return interval(Multiprecision(std::max(0.0L, energy.low())), Multiprecision(energy.high()));
}

}  // namespace

Interval SliceBound::most() const {
  return {std::max(counter_clockwise.low, clockwise.low), std::max(counter_clockwise.high, clockwise.high)};
}

SliceBound loop_bound(const HeightLaw& law, const Slice& slice, float depth, const Watch& watch) {
  if (potential(law)) return {{0, 0}, {0, 0}};
  const std::lock_guard lock(slow_numbers);
  set_precision(kEnergyBits);
  return decided([&] {
    const Circulation circulation(law, slice, depth);
    const Paid sum = circulation.paid(circulation.stretches(1e-8L, watch));
    return SliceBound{paid(law, sum.counter_clockwise), paid(law, sum.clockwise)};
  });
}

}  // namespace forceshade::reference
