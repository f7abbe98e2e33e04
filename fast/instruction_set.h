// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which vector instructions the batch call uses: all give the same bits, they differ in speed alone.

#include <array>
#include <optional>
#include <string_view>

namespace forceshade::fast {

enum class InstructionSet { scalar, avx2, avx512 };

inline constexpr std::array kInstructionSets{InstructionSet::scalar, InstructionSet::avx2, InstructionSet::avx512};

std::string_view name_of(InstructionSet set) noexcept;
std::optional<InstructionSet> instruction_set_named(std::string_view name) noexcept;

// Whether this processor and operating system run it.
bool is_available(InstructionSet set) noexcept;

// The widest available one, found once at the first call.
InstructionSet best_instruction_set() noexcept;

}  // namespace forceshade::fast
