// SPDX-License-Identifier: BSD-3-Clause
#include "files/decimal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>

namespace forceshade::files {
namespace {

// Beyond every exponent that a number with this many digits can have and be neither 0 nor infinite in binary64.
constexpr std::int64_t kFar = std::int64_t{1} << 60;

std::int64_t exponent_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::int64_t exponent = 0;
  if (std::from_chars(word.data(), word.data() + word.size(), exponent).ec != std::errc{} || std::abs(exponent) > kFar)
    return word.starts_with('-') ? -kFar : kFar;
  return exponent;
}

// factor: below 2^59.
std::string product(std::string_view digits, std::uint64_t factor) {
  std::string reversed;
  std::uint64_t carry = 0;
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
    carry += factor * static_cast<std::uint64_t>(*digit - '0');
    reversed += static_cast<char>('0' + carry % 10);
    carry /= 10;
  }
  for (; carry != 0; carry /= 10) reversed += static_cast<char>('0' + carry % 10);
  return {reversed.rbegin(), reversed.rend()};
}

std::string product(std::string_view a, std::string_view b) {
  std::string sum(a.size() + b.size(), 0);  // digits without '0', the last one first
  for (std::size_t i = 0; i < a.size(); ++i) {
    int carry = 0;
    for (std::size_t k = 0; k < b.size() || carry != 0; ++k) {
      carry += sum[i + k] + (k < b.size() ? (a[a.size() - 1 - i] - '0') * (b[b.size() - 1 - k] - '0') : 0);
      sum[i + k] = static_cast<char>(carry % 10);
      carry /= 10;
    }
  }
  while (!sum.empty() && sum.back() == 0) sum.pop_back();
  std::string digits;
  for (auto digit = sum.rbegin(); digit != sum.rend(); ++digit) digits += static_cast<char>('0' + *digit);
  return digits;
}

}  // namespace

Decimal::Decimal(double finite) : is_negative_(std::signbit(finite)) {
  if (finite == 0) return;
  int power = 0;
  const double part = std::frexp(std::fabs(finite), &power);
  digits_ = std::to_string(static_cast<std::uint64_t>(std::ldexp(part, 53)));
  power -= 53;
  // 2^-1 is 5 * 10^-1.
  constexpr int kTwos = 58, kFives = 24;
  exponent_ = std::min(power, 0);
  for (; power > 0; power -= std::min(power, kTwos)) digits_ = product(digits_, std::uint64_t{1} << std::min(power, kTwos));
  while (power < 0) {
    std::uint64_t fives = 1;
    for (int i = 0; i < kFives && power < 0; ++i, ++power) fives *= 5;
    digits_ = product(digits_, fives);
  }
  *this = shortened();
}

std::optional<Decimal> Decimal::take(std::string_view& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::invalid_argument || (error == std::errc{} && !std::isfinite(number))) return std::nullopt;
  std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.data()));
  text.remove_prefix(word.size());
  Decimal decimal;
  decimal.is_negative_ = word.starts_with('-');
  if (decimal.is_negative_) word.remove_prefix(1);
  const std::size_t digits_end = std::min(word.find_first_of("eE"), word.size());
  bool is_behind_point = false;
  for (const char c : word.substr(0, digits_end)) {
    if (c == '.') {
      is_behind_point = true;
      continue;
    }
    if (c != '0' || !decimal.digits_.empty()) decimal.digits_ += c;
    if (is_behind_point) --decimal.exponent_;
  }
  if (digits_end < word.size()) decimal.exponent_ += exponent_of(word.substr(digits_end + 1));
  if (decimal.is_zero()) decimal.exponent_ = 0;
  return decimal;
}

std::optional<Decimal> Decimal::of(std::string_view word) {
  const auto decimal = take(word);
  return word.empty() ? decimal : std::nullopt;
}

Decimal operator*(const Decimal& a, const Decimal& b) {
  Decimal result;
  result.is_negative_ = a.is_negative_ != b.is_negative_;
  if (a.is_zero() || b.is_zero()) return result;
  result.digits_ = product(a.digits_, b.digits_);
  result.exponent_ = a.exponent_ + b.exponent_;
  return result;
}

// digits without zeros at the end, which the exponent has instead.
Decimal Decimal::shortened() const {
  Decimal result = *this;
  while (result.digits_.ends_with('0')) {
    result.digits_.pop_back();
    ++result.exponent_;
  }
  return result;
}

bool Decimal::is_whole() const {
  return digits_.empty() || shortened().exponent_ >= 0;
}

bool Decimal::operator==(const Decimal& other) const {
  const Decimal a = shortened(), b = other.shortened();
  return a.digits_ == b.digits_ && (a.digits_.empty() || (a.exponent_ == b.exponent_ && a.is_negative_ == b.is_negative_));
}

template <class Real>
Real Decimal::nearest() const {
  const Real sign = is_negative_ ? Real(-1) : Real(1);
  if (digits_.empty()) return sign * Real(0);
  // The number is within 10^(place - 1) and 10^place.
  const std::int64_t place = static_cast<std::int64_t>(digits_.size()) + exponent_;
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
  if (place > 1000) return sign * kInfinity;
  if (place < -1000) return sign * Real(0);
  const std::string word = digits_ + 'e' + std::to_string(exponent_);
  Real number = 0;
  if (std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc{}) return sign * number;
  return place > 0 ? sign * kInfinity : sign * Real(0);
}

template float Decimal::nearest<float>() const;
template double Decimal::nearest<double>() const;

std::string Decimal::text() const {
  const Decimal shortest = shortened();
  const std::string_view digits = shortest.digits_;
  const std::int64_t exponent = shortest.exponent_;
  const std::string sign = is_negative_ ? "-" : "";
  if (digits.empty()) return sign + '0';
  constexpr std::int64_t kMostZeros = 6;
  const std::int64_t place = static_cast<std::int64_t>(digits.size()) + exponent;  // digits in front of the point
  if (exponent > kMostZeros || place < -kMostZeros) return sign + std::string(digits) + 'e' + std::to_string(exponent);
  if (exponent >= 0) return sign + std::string(digits) + std::string(static_cast<std::size_t>(exponent), '0');
  if (place <= 0) return sign + "0." + std::string(static_cast<std::size_t>(-place), '0') + std::string(digits);
  const auto whole = static_cast<std::size_t>(place);
  return sign + std::string(digits.substr(0, whole)) + '.' + std::string(digits.substr(whole));
}

std::string Decimal::fraction() const {
  const std::string digits = digits_.empty() ? "0" : digits_, zeros(static_cast<std::size_t>(std::abs(exponent_)), '0');
  const std::string signed_digits = std::string(is_negative_ ? "-" : "") + digits;
  return exponent_ < 0 ? signed_digits + "/1" + zeros : signed_digits + zeros + "/1";
}

}  // namespace forceshade::files
