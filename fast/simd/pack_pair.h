// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two packs as one number: as many lanes as a vector of binary32 has. For the files that have a Pack alone.

#include <cstddef>

#include "fast/numbers/inline.h"

namespace forceshade::fast {
namespace {

template <class Half>
struct Pair {
  static constexpr std::size_t kLanes = 2 * Half::kLanes;

  struct Mask {
    typename Half::Mask first, second;
  };

  Half first, second;

  FORCESHADE_INLINE explicit Pair(double a) : first(a), second(a) {}
  FORCESHADE_INLINE Pair(Half a, Half b) : first(a), second(b) {}
  // Not defaulted: g++ 12 copies a defaulted Pair through memory, sixteen bytes at a time.
  FORCESHADE_INLINE Pair(const Pair& other) : first(other.first), second(other.second) {}
  FORCESHADE_INLINE Pair& operator=(const Pair& other) {
    first = other.first;
    second = other.second;
    return *this;
  }

  FORCESHADE_INLINE void store(double* to) const {
    first.store(to);
    second.store(to + Half::kLanes);
  }
  FORCESHADE_INLINE static Pair load(const double* from) { return {Half::load(from), Half::load(from + Half::kLanes)}; }
  FORCESHADE_INLINE static Pair load(const float* from) { return {Half::load(from), Half::load(from + Half::kLanes)}; }

  FORCESHADE_INLINE friend Pair operator+(Pair a, Pair b) { return {a.first + b.first, a.second + b.second}; }
  FORCESHADE_INLINE friend Pair operator-(Pair a, Pair b) { return {a.first - b.first, a.second - b.second}; }
  FORCESHADE_INLINE friend Pair operator*(Pair a, Pair b) { return {a.first * b.first, a.second * b.second}; }
  FORCESHADE_INLINE friend Pair operator-(Pair a) { return {-a.first, -a.second}; }
  FORCESHADE_INLINE friend Mask operator<=(Pair a, Pair b) { return {a.first <= b.first, a.second <= b.second}; }
  FORCESHADE_INLINE friend Pair fused_add(Pair a, Pair b, Pair c) {
    return {fused_add(a.first, b.first, c.first), fused_add(a.second, b.second, c.second)};
  }
  FORCESHADE_INLINE friend Pair fused_subtract_from(Pair a, Pair b, Pair c) {
    return {fused_subtract_from(a.first, b.first, c.first), fused_subtract_from(a.second, b.second, c.second)};
  }
  FORCESHADE_INLINE friend Pair fused_less(Pair a, Pair b, Pair c) {
    return {fused_less(a.first, b.first, c.first), fused_less(a.second, b.second, c.second)};
  }
  FORCESHADE_INLINE friend Pair square_root(Pair a) { return {square_root(a.first), square_root(a.second)}; }
  FORCESHADE_INLINE friend Pair larger(Pair a, Pair b) { return {larger(a.first, b.first), larger(a.second, b.second)}; }
  FORCESHADE_INLINE friend Pair select(Mask condition, Pair yes, Pair no) {
    return {select(condition.first, yes.first, no.first), select(condition.second, yes.second, no.second)};
  }
};

}  // namespace
}  // namespace forceshade::fast
