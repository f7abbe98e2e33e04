// SPDX-License-Identifier: BSD-3-Clause
#include "fast/simd/built.h"
#include "forceshade/fast.h"

namespace forceshade::fast {

std::string_view name_of(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::scalar: return "scalar";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
  }
  return "unknown";
}

std::optional<InstructionSet> instruction_set_named(std::string_view name) noexcept {
  for (const InstructionSet set : kInstructionSets)
    if (name_of(set) == name) return set;
  return std::nullopt;
}

bool is_available(InstructionSet set) noexcept {
#if FORCESHADE_HAS_VECTOR_SETS
  switch (set) {
    case InstructionSet::scalar: return true;
    case InstructionSet::avx2: return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512bw");
  }
  return false;
#else
  return set == InstructionSet::scalar;
#endif
}

InstructionSet best_instruction_set() noexcept {
  static const InstructionSet best = is_available(InstructionSet::avx512) ? InstructionSet::avx512
                                     : is_available(InstructionSet::avx2) ? InstructionSet::avx2
                                                                          : InstructionSet::scalar;
  return best;
}

}  // namespace forceshade::fast
