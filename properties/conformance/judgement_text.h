// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A judgement for people, and as JSON (docs/conformance.md).

#include <string>

#include "forceshade/identity.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {

// Lines for a terminal, each ended: what was right, how large the errors are, the worst of them, and the verdict with a case
// that one can paste into a test.
std::string words_of(const Judgement& found, const Identity& identity, const Tolerance& tolerance);

// A key "held", the counts, and the worst cases with numbers in hexfloat.
std::string to_json(const Judgement& found, const Identity& identity, const Tolerance& tolerance);

}  // namespace forceshade::conformance
