// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The form in which a batch evaluates a law: the same force as the law's first stage (fast/laws/), by fewer operations, because
// fused ones round once and because only what is rounded last decides. For the files that have a Pack alone.
//
// A form is built of the law's definition (fast/simd/form_of.inl has that of each). `answer`, below or one of its own, answers
// a block with it.

#include "fast/simd/pack_pair.h"

namespace forceshade::fast {
namespace {

using Two = Pair<Pack>;

// The components in binary64, N.
struct Components {
  Two x, z;
};
// The forces, N; +0 where there is no contact.
struct Forces {
  Floats x, z;
};

FORCESHADE_INLINE Two widened(Floats a) {
  return {a.first_half(), a.second_half()};
}
FORCESHADE_INLINE Floats rounded(const Two& a) {
  return Floats::rounded(a.first, a.second);
}
template <int kWindow>
FORCESHADE_INLINE Floats rounded(const Two& a, Watch& watch) {
  watch.rounding<kWindow>(a.first, a.second);
  return rounded(a);
}

// Calls first(i) and, one step later, second(i, what first returned), so that the processor always has two short chains of
// dependent operations to work on: it does not look far enough ahead to overlap two steps of one long chain.
template <class First, class Second>
FORCESHADE_INLINE void staggered(std::size_t count, const First& first, const Second& second) {
  auto last = first(0);
  std::size_t i = 0;
  for (; i + Floats::kLanes < count; i += Floats::kLanes) {
    auto next = first(i + Floats::kLanes);
    second(i, last);
    last = next;
  }
  second(i, last);
}

// Answers `count` positions, a multiple of Floats::kLanes; false when at least one of them is invalid or in doubt. The form has
//   kWindow             doubt_window of the relative error of its components
//   least_coordinate()  mm: it answers no coordinate that is smaller in size, but 0
//   least_distance()    the least Watch::distance that it answers
//   components(watch, x, z)
//   forces(rounded x and z components, x, z)
template <class Form>
bool answer(const Form& law, std::size_t count, const float* x, const float* z, float* fx, float* fz) {
  const Form form = law;  // a copy that the stores below cannot alias
  Watch watch;
  staggered(
      count,
      [&](std::size_t i) FORCESHADE_INLINE_BODY {
        watch.coordinates(absolute(Floats::load(x + i)), absolute(Floats::load(z + i)));
        return form.components(watch, x + i, z + i);
      },
      [&](std::size_t i, const Components& force) FORCESHADE_INLINE_BODY {
        const Floats force_x = rounded<Form::kWindow>(force.x, watch), force_z = rounded<Form::kWindow>(force.z, watch);
        const Forces forces = form.forces(force_x, force_z, Floats::load(x + i), Floats::load(z + i));
        forces.x.store(fx + i);
        forces.z.store(fz + i);
      });
  return watch.is_free_of_hazards<Form::kWindow>(form.least_coordinate(), form.least_distance());
}

}  // namespace
}  // namespace forceshade::fast
