// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rational numbers in words, before the exact numbers are made of them: these end the process where a denominator is 0.

#include <optional>
#include <string>
#include <string_view>

namespace forceshade::exact {

// "p/q" with a denominator that is not 0 and no zeros in front, of "3/4", "-0.75" or "7.5e-1". Nothing for another text, for
// one of more than 10 000 characters, for an exponent above 10 000, and for more than 20 000 digits behind the point.
std::optional<std::string> rational_of(std::string_view text);

}  // namespace forceshade::exact
