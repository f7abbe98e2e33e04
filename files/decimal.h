// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decimal numbers as people write them, exactly: digits * 10^exponent. Every unit of length, force, stiffness and share is such
// a number of another one, so a product with it is exact, too, and is rounded once, where a binary number is made of it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace forceshade::files {

class Decimal {
 public:
  Decimal() = default;  // 0
  // Every finite binary64 number is a decimal one.
  Decimal(double finite);  // NOLINT(google-explicit-constructor): it is the same number

  // The number that a word such as -1.5e3 stands for, whatever the locale. Nothing for a word that is not a finite decimal
  // number from its first character to its last; neither + nor a blank may stand in front.
  static std::optional<Decimal> of(std::string_view word);

  // That at the beginning of the text, which loses it.
  static std::optional<Decimal> take(std::string_view& text);

  friend Decimal operator*(const Decimal& a, const Decimal& b);
  bool operator==(const Decimal&) const;  // -0 is 0

  bool is_negative() const { return is_negative_; }  // -0 is
  bool is_one() const { return !is_negative_ && exponent_ == 0 && digits_ == "1"; }
  bool is_whole() const;
  bool is_zero() const { return digits_.empty(); }

  // The nearest number, ties to even: infinite where it is too large.
  template <class Real>
  Real nearest() const;

  // Text that of() reads as this number: "25.4", "1e-20".
  std::string text() const;

  // "-3/10", as integers of any size are read; as long as the exponent is large.
  std::string fraction() const;

  std::int64_t exponent() const { return exponent_; }

 private:
  Decimal shortened() const;

  bool is_negative_ = false;
  std::string digits_;  // without zeros in front; empty of 0
  std::int64_t exponent_ = 0;
};

}  // namespace forceshade::files
