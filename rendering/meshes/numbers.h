// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers of a file as binary32 numbers of mm: each is rounded once, from the exact product of number and unit.

#include <optional>
#include <string_view>

#include "files/decimal.h"
#include "forceshade/meshes.h"

namespace forceshade::mesh {

inline constexpr float kLargest = 1e4F, kSmallest = 0x1p-30F;  // mm, of a coordinate; below the smallest it is 0

// The coordinate in mm that a decimal such as -1.5e3 stands for, whatever the locale; a + may stand in front. Infinite where
// binary32 cannot hold it, NaN of "nan". Nothing if the word is not a number from its first character to its last.
std::optional<float> from_decimal(std::string_view word, Unit unit);
// The same in a unit of so many mm.
std::optional<float> from_decimal(std::string_view word, const files::Decimal& unit);

// The coordinate in mm that a binary number stands for.
float from_binary(double number, Unit unit);
float from_binary(double number, const files::Decimal& unit);

}  // namespace forceshade::mesh
