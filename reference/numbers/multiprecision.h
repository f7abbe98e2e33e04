// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Enclosure, an interval of any precision. It is apart from numbers.h, since CGAL's headers there take longer to compile
// than these.

#include <boost/multiprecision/mpfi.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <mutex>

namespace forceshade::reference {

using Enclosure = boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<0>, boost::multiprecision::et_off>;
using Multiprecision =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>, boost::multiprecision::et_off>;

// Sets the precision of every Enclosure made from here on, in bits. Boost keeps it in one global, and CORE shares nodes
// without atomics: code that uses either type, CORE's rationals included, must hold exact_arithmetic.
void set_precision(unsigned bits);
inline std::mutex exact_arithmetic;

}  // namespace forceshade::reference
