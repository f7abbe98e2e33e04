// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vector side of the batch call: per instruction set one table of functions, exported by fast/batch_<set>.cpp.

#include <cstddef>
#include <cstdint>

#include "forceshade/fast/domain.h"
#include "forceshade/fast/laws/bump_1p.h"
#include "forceshade/fast/laws/bump_1p_shaded.h"
#include "forceshade/fast/laws/bump_2p.h"
#include "forceshade/fast/laws/bump_2p_shaded.h"
#include "forceshade/fast/laws/bump_3p.h"
#include "forceshade/fast/laws/bump_3p_shaded.h"
#include "forceshade/fast/laws/bump_cylinder.h"
#include "forceshade/fast/laws/cylinder.h"
#include "forceshade/fast/laws/wall.h"
#include "forceshade/fast/numbers/arithmetic.h"
#include "forceshade/fast/numbers/first_stage.h"

namespace forceshade::fast {

// Positions per step. A step with any position that needs more than the first stage is done again by the scalar call.
inline constexpr std::size_t kBlock = 128;

// Answers kBlock positions by the first stage; false when at least one of them is invalid or in doubt.
template <class Definition>
using BlockFunction = bool (*)(const Definition& law, const float* x, const float* z, float* fx, float* fz);

struct BlockTable {
  BlockFunction<Wall> wall;
  BlockFunction<Cylinder> cylinder;
  BlockFunction<BumpCylinder> bump_cylinder;
  BlockFunction<Bump1p> bump_1p;
  BlockFunction<Bump2p> bump_2p;
  BlockFunction<Bump3p> bump_3p;
  BlockFunction<Bump1pShaded> bump_1p_shaded;
  BlockFunction<Bump2pShaded> bump_2p_shaded;
  BlockFunction<Bump3pShaded> bump_3p_shaded;
  const char* (*arithmetic_fault_here)();
};

extern const BlockTable kAvx2Blocks;
extern const BlockTable kAvx512Blocks;

}  // namespace forceshade::fast
