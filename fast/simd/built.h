// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// FORCESHADE_HAS_VECTOR_SETS: whether the build has code for AVX2 and AVX-512 (fast/CMakeLists.txt compiles it under the same
// condition). On Windows it has not: g++ keeps the stack aligned to 16 bytes there, and a vector of 32 bytes that it puts on
// the stack ends the process (GCC bug 54412).

#if defined(__x86_64__) && !defined(_WIN32)
#define FORCESHADE_HAS_VECTOR_SETS 1
#else
#define FORCESHADE_HAS_VECTOR_SETS 0
#endif
