// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// FORCESHADE_INLINE marks every function that the per-instruction-set files use: always inlined, so that no copy compiled
// with AVX-512 can be linked into code that runs on a machine without it. tests/isolation_test.cmake looks for such copies.

#define FORCESHADE_INLINE [[gnu::always_inline]] inline
// The same of a lambda, after its parameters: what it refers to need not be in memory then.
#define FORCESHADE_INLINE_BODY __attribute__((always_inline))

// Refuses the flags that the preprocessor can see; fast/numbers/arithmetic.h finds the rest.
#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__ || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    defined(__NO_SIGNED_ZEROS__)
#error "forceshade proves its results for IEEE arithmetic: compile without -ffast-math, -Ofast and their parts"
#endif
