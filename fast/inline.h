// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// FORCESHADE_INLINE marks every function that the per-instruction-set files use: always inlined, so that no copy compiled
// with AVX-512 can be linked into code that runs on a machine without it. tests/isolation_test.cmake looks for such copies.

#define FORCESHADE_INLINE [[gnu::always_inline]] inline

#ifdef __FAST_MATH__
#error "forceshade proves its results for IEEE arithmetic: compile without -ffast-math"
#endif
