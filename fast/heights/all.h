// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every kind of height map, as the real-time side has it: jet(), error_of(), add_terms() and denominator_bits() of each. A kind
// of include/forceshade/height_map.h that lacks one of them does not compile.

#include "fast/heights/grid_kind.h"

// clang-format off
#define FORCESHADE_HEIGHT_KIND(kind) <fast/heights/kind.h>
// clang-format on
#include "rendering/height_kinds.inc"
#undef FORCESHADE_HEIGHT_KIND
