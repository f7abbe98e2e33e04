// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pictures of a conformance run: how large the errors are, and where.

#include <string>

#include "forceshade/description.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {

// One <figure> after another; empty where nothing was judged. Throws PlotError.
std::string figures(const Judgement& found, const Description& subject);

}  // namespace forceshade::conformance
