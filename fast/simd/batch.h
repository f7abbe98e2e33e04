// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vector side of the batch call: per instruction set one table of functions, exported by fast/batch_<set>.cpp.

#include <cstddef>
#include <cstdint>

#include "fast/domain.h"
#include "fast/laws/all.h"
#include "fast/numbers/arithmetic.h"
#include "fast/numbers/first_stage.h"
#include "fast/simd/built.h"

namespace forceshade::fast {

// Positions that are answered together at most, and a step of them: a block with a position that is invalid or in doubt is
// answered again in steps, and such a step by the scalar call.
inline constexpr std::size_t kBlock = 512, kStep = 16;

// Answers `count` positions, some steps and a block at most; false when at least one of them is invalid or in doubt.
template <class Definition>
using BlockFunction = bool (*)(const Definition& law, std::size_t count, const float* x, const float* z, float* fx, float* fz);

template <class Definition>
struct BlockOf {
  BlockFunction<Definition> answer;
};

template <class... Definition>
struct BlocksOf : BlockOf<Definition>... {
  // Writes x and z of `count` rows (x, y, z), some steps of them; false when at least one y is outside the domain.
  bool (*take_rows_apart)(const float* rows, std::size_t count, float* x, float* z);
  // Writes as many rows (fx, 0, fz).
  void (*put_rows_together)(const float* fx, const float* fz, std::size_t count, float* rows);
  const char* (*arithmetic_fault_here)();
};

template <class... Definition>
BlocksOf<Definition...> block_table_of(LawList<Definition...>);
using BlockTable = decltype(block_table_of(Laws()));

extern const BlockTable kAvx2Blocks;
extern const BlockTable kAvx512Blocks;

}  // namespace forceshade::fast
