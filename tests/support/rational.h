// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rational numbers beside the binary ones that they round to.

#include <gmpxx.h>
#include <mpfr.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <type_traits>

namespace forceshade::tests {

// The binary number nearest to a rational one, ties to even.
template <class Real>
Real nearest(const mpq_class& number) {
  // 300 bits rounded to odd, then to 24 or 53, are as one rounding: what is left out is a bit that is set.
  mpfr_t wide;
  mpfr_init2(wide, 300);
  const int inexact = mpfr_set_q(wide, number.get_mpq_t(), MPFR_RNDZ);
  if (inexact != 0 && mpfr_min_prec(wide) < 300) {
    if (mpfr_sgn(wide) > 0)
      mpfr_nextabove(wide);
    else
      mpfr_nextbelow(wide);
  }
  const auto result = [&] {
    if constexpr (std::is_same_v<Real, float>)
      return mpfr_get_flt(wide, MPFR_RNDN);
    else
      return mpfr_get_d(wide, MPFR_RNDN);
  }();
  mpfr_clear(wide);
  return result;
}

// digits * 10^exponent
inline mpq_class decimal(const std::string& digits, int exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
  const mpz_class number(digits, 10);
  mpq_class result = exponent >= 0 ? mpq_class(number * power) : mpq_class(number, power);
  result.canonicalize();
  return result;
}

// Text of 12 to 19 digits, and what it is.
struct NearTie {
  std::string text;
  mpq_class number;
};

// A number of a unit that is just beside a middle between two binary32 numbers of the base unit, or on it: between 1/64 and 64
// of it. Rounding it to binary64 first, or a product of it, often goes to the wrong side.
inline NearTie near_tie(std::mt19937_64& random, const mpq_class& unit) {
  const mpq_class odd(static_cast<unsigned long>((random() % (1U << 23U) + (1U << 23U)) * 2 + 1));
  const auto power = static_cast<unsigned>(random() % 12);
  mpq_class tie = odd / mpq_class(mpz_class(1) << 30U) * mpq_class(mpz_class(1) << power) / unit;
  tie.canonicalize();
  int behind_point = static_cast<int>(12 + random() % 8);
  for (mpq_class rest = tie; rest >= 1; rest /= 10) --behind_point;
  behind_point = std::max(behind_point, 1);
  const mpq_class scaled = tie * decimal("1", behind_point);
  mpz_class digits = scaled.get_num() / scaled.get_den();
  digits += static_cast<unsigned long>(random() % 2);
  std::string text = digits.get_str();
  const mpq_class number = decimal(text, -behind_point);
  const auto behind = static_cast<std::size_t>(behind_point);
  if (text.size() <= behind) text.insert(0, behind + 1 - text.size(), '0');
  text.insert(text.size() - behind, ".");
  return {text, number};
}

}  // namespace forceshade::tests
