// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tests that arithmetic rounds as the proofs assume. No macro shows contraction or clang's reordering, and the mode belongs
// to the thread: so the processor is tested. Each file that evaluates a law does it, because each file has flags of its own.

#include <cmath>

#include "fast/numbers/inline.h"
#include "rendering/control_words.h"

namespace forceshade::fast {

// The optimiser does not see through it, and so cannot fold what the processor is to compute.
FORCESHADE_INLINE double hidden(double value) {
  const volatile double copy = value;
  return copy;
}

// The first deviation of this file's code, on this thread, from IEEE 754 rounding to nearest; null if none was found. The
// tests raise exceptions, which must not trap.
FORCESHADE_INLINE const char* arithmetic_fault_without_traps() {
  const double one = hidden(1), small = hidden(0x1p-54), larger = hidden(0x1.8p-53);
  if (one + small != 1 || -one - small != -1 || one + larger != 1 + 0x1p-52) return "rounding other than to nearest";
  const double least_normal = hidden(0x1p-1022), subnormal = hidden(0x1p-1074);
  if (least_normal * hidden(0.5) == 0 || subnormal * hidden(0x1p1000) != 0x1p-74) return "flushed subnormals";
  const double a = hidden(1 + 0x1p-30);  // its square is 1 + 2^-29 + 2^-60, which rounds
  if (a * a - hidden(1 + 0x1p-29) != 0) return "fused a*b - c (compile with -ffp-contract=off)";
  if ((one + small) - one != 0) return "reordered sum (compile without -fassociative-math)";
  if (hidden(5) / 3 != 0x1.aaaaaaaaaaaabp+0) return "reciprocal for a quotient (compile without -freciprocal-math)";
  if (1 / (hidden(-0.0) + 0.0) < 0) return "lost sign of zero (compile without -fno-signed-zeros)";
  // The product is 4 - 2^-26 - 2^-51 + 2^-79: more bits than a double or the x87 format has. The parts into which the C library
  // of mingw-w64 splits the factors lose some of them.
  if (std::fma(hidden(2 - 0x1p-27), hidden(2 - 0x1p-52), hidden(-4 + 0x1p-26 + 0x1p-51)) != 0x1p-79)
    return "fma that rounds twice (compile with -mfma)";
  return nullptr;
}

// The same, whether exceptions trap or not.
FORCESHADE_INLINE const char* arithmetic_fault_here() {
#if FORCESHADE_HAS_CONTROL_WORDS
  const unsigned before = _mm_getcsr();
  if ((before & kNoTraps) == kNoTraps) [[likely]]
    return arithmetic_fault_without_traps();
  _mm_setcsr(before | kNoTraps);
  const char* fault = arithmetic_fault_without_traps();
  asm volatile("" : "+r"(fault));  // known before exceptions trap again
  _mm_setcsr(before);
  return fault;
#else
  return arithmetic_fault_without_traps();
#endif
}

}  // namespace forceshade::fast
