// SPDX-License-Identifier: BSD-3-Clause
#include "reference/numbers/decimal.h"

#include <mpfr.h>

#include <stdexcept>

namespace forceshade::reference {
namespace {

// 0.DIGITS · 10^exponent with a sign; zero has no digits.
struct Decimal {
  bool negative = false;
  std::string digits;
  long exponent = 0;

  friend bool operator==(const Decimal&, const Decimal&) = default;
};

Decimal rounded(const Multiprecision& value, unsigned digits, mpfr_rnd_t direction) {
  if (value == 0) return {};
  mpfr_exp_t exponent = 0;
  char* text = mpfr_get_str(nullptr, &exponent, 10, digits, value.backend().data(), direction);
  Decimal result{value < 0, value < 0 ? text + 1 : text, exponent};
  mpfr_free_str(text);
  return result;
}

constexpr long kMostZeros = -5000;
constexpr unsigned kMostBits = 1U << 22U;

std::string positional(const Decimal& value) {
  if (value.digits.empty()) return "0";
  // The tail of a Gaussian has more zeros than there is memory.
  if (value.exponent < kMostZeros)
    return (value.negative ? "-" : "") + value.digits.substr(0, 1) + "." + value.digits.substr(1) + "e" +
           std::to_string(value.exponent - 1);
  const auto count = static_cast<long>(value.digits.size());
  std::string text = value.digits;
  if (value.exponent <= 0) {
    text = "0." + std::string(static_cast<std::size_t>(-value.exponent), '0') + text;
  } else if (value.exponent >= count) {
    text += std::string(static_cast<std::size_t>(value.exponent - count), '0');
  } else {
    text.insert(static_cast<std::size_t>(value.exponent), ".");
  }
  return (value.negative ? "-" : "") + text;
}

CORE::BigRat power_of_ten(long exponent) {
  CORE::BigInt power = 1;
  for (long i = 0; i < (exponent < 0 ? -exponent : exponent); ++i) power *= CORE::BigInt(10);
  return exponent < 0 ? CORE::BigRat(CORE::BigInt(1), power) : CORE::BigRat(power);
}

}  // namespace

std::string correctly_rounded(unsigned digits, const std::function<Enclosure()>& enclose,
                              const std::function<int(const CORE::BigRat&)>& compare) {
  const unsigned first = digits * 10 / 3 + 64;
  for (unsigned bits = first;; bits *= 2) {
    if (bits > kMostBits) throw std::domain_error("the digits cannot be told: more than a million of them cancel");
    set_precision(bits);
    const Enclosure value = enclose();
    const Decimal low = rounded(lower(value), digits, MPFR_RNDN);
    const Decimal high = rounded(upper(value), digits, MPFR_RNDN);
    if (low == high) return positional(low);
    if (bits < 8 * first) continue;
    if (compare(0) == 0) return "0";
    // Cancellation may need more bits: only a tie of two neighbours is left where both ends are between them.
    if (rounded(lower(value), digits, MPFR_RNDZ) == rounded(upper(value), digits, MPFR_RNDZ)) break;
  }
  // Between two neighbouring decimals, the smaller in size by truncation: which is nearer?
  const Enclosure value = enclose();
  const Multiprecision middle = (lower(value) + upper(value)) / 2;
  const Decimal toward_zero = rounded(middle, digits, MPFR_RNDZ);
  const Decimal away = rounded(middle, digits, MPFR_RNDA);
  const CORE::BigRat unit = power_of_ten(toward_zero.exponent - static_cast<long>(digits));
  CORE::BigRat tie =
      (CORE::BigRat(CORE::BigInt(toward_zero.digits.c_str())) + CORE::BigRat(CORE::BigInt(1), CORE::BigInt(2))) * unit;
  const int beyond = toward_zero.negative ? -compare(-tie) : compare(tie);
  const bool is_even = (toward_zero.digits.back() - '0') % 2 == 0;
  return positional(beyond > 0 || (beyond == 0 && !is_even) ? away : toward_zero);
}

}  // namespace forceshade::reference
