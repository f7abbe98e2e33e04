// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Correct rounding to decimal digits of a number known by enclosures of any precision and an exact comparison.

#include <functional>
#include <string>

#include "reference/numbers/numbers.h"

namespace forceshade::reference {

// `enclose` evaluates at the precision in force; `compare(q)` is the sign of the value minus the rational q, and is called
// only when no reasonable precision decides, which means zero or a tie. Ties go to the even digit. Throws std::domain_error
// where more than four million bits cancel.
std::string correctly_rounded(unsigned digits, const std::function<Enclosure()>& enclose,
                              const std::function<int(const CORE::BigRat&)>& compare);

}  // namespace forceshade::reference
