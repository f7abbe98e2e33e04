// SPDX-License-Identifier: BSD-3-Clause
#include "reference/height_energy.h"

#include "reference/energy/height_circulation.h"
#include "reference/energy/strips.h"

namespace forceshade::reference {
namespace {

Interval generated(const HeightMapField& law, const Ball64& over_stiffness) {
  const Ball64 energy = Ball64(static_cast<double>(law.stiffness())) * over_stiffness;
  if (!is_finite(energy)) throw NotEnclosed("an energy that is not finite");
  return interval(Multiprecision(std::max(0.0L, energy.low())), Multiprecision(energy.high()));
}

}  // namespace

Interval SliceBound::most() const {
  return {std::max(counter_clockwise.low, clockwise.low), std::max(counter_clockwise.high, clockwise.high)};
}

SliceBound loop_bound(const HeightMapField& law, const Slice& slice, float depth, const Monitor& monitor) {
  if (potential(law)) return {{0, 0}, {0, 0}};
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  return decided([&] {
    const Circulation circulation(law, slice, depth);
    const Generated sum = circulation.generated(circulation.stretches(1e-8L, monitor));
    return SliceBound{generated(law, sum.counter_clockwise), generated(law, sum.clockwise)};
  });
}

}  // namespace forceshade::reference
