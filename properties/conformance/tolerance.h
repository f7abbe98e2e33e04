// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The largest deviation of an answer from the exact force that still counts as right.

#include <optional>
#include <string>
#include <string_view>

#include "files/decimal.h"

namespace forceshade::conformance {

// ulp: how many binary32 numbers an answer may be away from the correctly rounded force, in each component. newton: how long
// the difference of the answer and the exact force may be. percent: how long that is to the exact force; where this is zero,
// the answer has to be zero.
enum class Unit { ulp, newton, percent };

struct Tolerance {
  Unit unit = Unit::ulp;
  files::Decimal value = {};  // as it was typed, exactly; 0 ulp is correctly rounded
};

// "4 ulp", "1e-6 N", "0.1 %", also without the space. A number of ulp is whole. Nothing for another text.
std::optional<Tolerance> tolerance_of(std::string_view text);

// "correctly rounded", "4 ulp", "1e-06 N".
std::string words_of(const Tolerance& tolerance);

}  // namespace forceshade::conformance
