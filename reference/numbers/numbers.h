// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two slow number types: Enclosure, an interval of any precision for values; Exact, an algebraic number for decisions.
// A law's formulas are templates over the number, so values and decisions come from the same text.

#include <CGAL/CORE_Expr.h>

#include "reference/numbers/multiprecision.h"

namespace forceshade::reference {

using Exact = CORE::Expr;

}  // namespace forceshade::reference
