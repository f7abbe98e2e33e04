// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two slow number types: Enclosure, an interval of any precision for values; Exact, an algebraic number for decisions.
// A law's formulas are templates over the number, so values and decisions come from the same text.

#include <CGAL/CORE_Expr.h>

#include <boost/multiprecision/mpfi.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <mutex>

namespace forceshade::reference {

using Exact = CORE::Expr;

using Enclosure = boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<0>, boost::multiprecision::et_off>;
using Multiprecision =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>, boost::multiprecision::et_off>;

// Sets the precision of every Enclosure made from here on, in bits. Boost keeps it in one global, and CORE shares nodes
// without atomics: code that uses either type, CORE's rationals included, must hold exact_arithmetic.
void set_precision(unsigned bits);
inline std::mutex exact_arithmetic;

}  // namespace forceshade::reference
