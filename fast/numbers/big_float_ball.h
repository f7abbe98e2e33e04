// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The last stage's number: a floating-point number of 64·kLimbs bits on the stack, with a proven bound of its own error.
//
// It decides what double-double cannot: exact rounding ties and contact at exactly zero. A force component, less a binary32
// rounding boundary, is an algebraic number whose conjugates are bounded; docs/proofs.md derives how small it can be
// without being zero. kLimbs is chosen past that, so a value whose enclosure still holds zero *is* zero, and sign() says so.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fast/numbers/ball.h"

namespace forceshade::fast {

template <std::size_t kLimbs>
class BigFloatBall {
  template <std::size_t kOther>
  friend class BigFloatBall;

 public:
  static constexpr int kNewtonSteps = 7;  // from 2^-50 past 2^-6000

  static BigFloatBall exactly(double value) noexcept {
    BigFloatBall result;
    if (value == 0) return result;
    int exponent = 0;
    const double fraction = std::frexp(std::fabs(value), &exponent);  // in [1/2, 1)
    result.negative_ = value < 0;
    result.exponent_ = exponent;
    result.limbs_[kLimbs - 1] = static_cast<std::uint64_t>(std::ldexp(fraction, 64));
    return result;
  }

  BigFloatBall operator-() const noexcept {
    BigFloatBall result = *this;
    result.negative_ = !negative_;
    return result;
  }

  friend BigFloatBall operator+(const BigFloatBall& a, const BigFloatBall& b) noexcept {
    if (a.is_zero()) return b.with_error(larger(a.error_, b.error_) + 1);
    if (b.is_zero()) return a.with_error(larger(a.error_, b.error_) + 1);
    const bool a_is_larger = compare_magnitudes(a, b) >= 0;
    const BigFloatBall& large = a_is_larger ? a : b;
    BigFloatBall small = a_is_larger ? b : a;
    const bool lost = small.shift_right(large.exponent_ - small.exponent_);
    BigFloatBall result = large;
    if (a.negative_ == b.negative_) {
      result.add_limbs(small);
    } else {
      result.subtract_limbs(small);
    }
    const std::int64_t rounding = lost ? large.exponent_ - kBits + 1 : kExact;
    return result.with_error(larger(larger(result.error_, small.error_), rounding) + 2);
  }

  friend BigFloatBall operator-(const BigFloatBall& a, const BigFloatBall& b) noexcept { return a + (-b); }

  friend BigFloatBall operator*(const BigFloatBall& a, const BigFloatBall& b) noexcept {
    BigFloatBall result;
    const std::int64_t propagated = larger(larger(a.exponent_ + b.error_, b.exponent_ + a.error_), a.error_ + b.error_);
    if (a.is_zero() || b.is_zero()) return result.with_error(a.is_exact_zero() || b.is_exact_zero() ? kExact : propagated + 2);
    std::array<std::uint64_t, 2 * kLimbs> product{};
    const std::size_t first_of_b = b.lowest_limb();
    for (std::size_t i = a.lowest_limb(); i < kLimbs; ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = first_of_b; j < kLimbs; ++j) {
        const Product t = Product{a.limbs_[i]} * b.limbs_[j] + product[i + j] + carry;
        product[i + j] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
      product[i + kLimbs] = carry;
    }
    result.negative_ = a.negative_ != b.negative_;
    result.exponent_ = a.exponent_ + b.exponent_;
    for (std::size_t i = 0; i < kLimbs; ++i) result.limbs_[i] = product[i + kLimbs];
    const std::uint64_t below = product[kLimbs - 1];
    result.normalise(below);
    const std::int64_t taken = a.exponent_ + b.exponent_ - result.exponent_;  // bits of `below` that found room: 0 or 1
    bool lost = (below << taken) != 0;
    for (std::size_t i = 0; i + 1 < kLimbs; ++i) lost |= product[i] != 0;
    return result.with_error(larger(propagated, lost ? result.exponent_ - kBits + 2 : kExact) + 2);
  }

  // Newton for 1/b, then one correction; the bound comes from the remainder a - q b, so it does not lean on Newton's.
  // A divisor that may be zero gives an infinite error, not a trap.
  friend BigFloatBall operator/(const BigFloatBall& a, const BigFloatBall& b) noexcept {
    if (b.may_be_zero()) return BigFloatBall{}.with_error(kInfinite);
    if (a.is_zero()) return BigFloatBall{}.with_error(a.is_exact_zero() ? kExact : a.error_ - b.exponent_ + 3);
    const BigFloatBall divisor = midpoint(b);
    const BigFloatBall one = exactly(1);
    BigFloatBall inverse = exactly((b.negative_ ? -1 : 1) / b.fraction()).scaled(-b.exponent_);
    for (std::int64_t bits = 50; bits < kBits; bits *= 2)
      inverse = truncated(inverse + inverse * (one - divisor * inverse), 2 * bits);
    const BigFloatBall dividend = midpoint(a);
    BigFloatBall quotient = midpoint(dividend * inverse);
    quotient = midpoint(quotient + (dividend - quotient * divisor) * inverse);
    const std::int64_t remainder = (dividend - quotient * divisor).magnitude() - b.exponent_ + 2;
    const std::int64_t propagated = larger(a.error_ - b.exponent_, a.exponent_ + b.error_ - 2 * b.exponent_) + 4;
    return quotient.with_error(larger(remainder, propagated) + 1);
  }

  friend BigFloatBall square_root(const BigFloatBall& a) noexcept {
    if (a.is_exact_zero()) return a;
    if (a.may_be_zero() || a.negative_) return BigFloatBall{}.with_error((larger(a.exponent_, a.error_) + 4) / 2 + 1);
    const BigFloatBall square = midpoint(a);
    const std::int64_t half = a.exponent_ >= 0 ? a.exponent_ / 2 : -((1 - a.exponent_) / 2);
    const double reduced = std::ldexp(a.fraction(), static_cast<int>(a.exponent_ - 2 * half));
    BigFloatBall inverse = exactly(1 / std::sqrt(reduced)).scaled(-half);
    const BigFloatBall one = exactly(1);
    for (std::int64_t bits = 49; bits < kBits; bits *= 2)
      inverse = truncated(inverse + (inverse * (one - square * (inverse * inverse))).scaled(-1), 2 * bits);
    BigFloatBall root = midpoint(square * inverse);
    root = midpoint(root + ((square - root * root) * inverse).scaled(-1));
    const std::int64_t remainder = (square - root * root).magnitude() - root.exponent_ + 1;
    return root.with_error(larger(remainder, a.error_ - root.exponent_ + 2) + 1);
  }

  // Never unknown: see the head of this file.
  friend Sign sign(const BigFloatBall& a) noexcept {
    if (a.may_be_zero()) return Sign::zero;
    return a.negative_ ? Sign::negative : Sign::positive;
  }
  // The sign of a number that no bound separates from zero: zero only if the ball is exactly zero, unknown if it may be.
  friend Sign proved_sign(const BigFloatBall& a) noexcept {
    return a.may_be_zero() && !a.is_exact_zero() ? Sign::unknown : sign(a);
  }

  friend BigFloatBall midpoint(const BigFloatBall& a) noexcept {
    BigFloatBall result = a;
    result.error_ = kExact;
    return result;
  }
  // midpoint(), cut down to the limbs that hold `bits` bits: what Newton's method has gained so far, so that its early
  // steps multiply short numbers.
  friend BigFloatBall truncated(const BigFloatBall& a, std::int64_t bits) noexcept {
    BigFloatBall result = midpoint(a);
    const std::int64_t dropped = static_cast<std::int64_t>(kLimbs) - (bits / 64 + 2);
    for (std::int64_t i = 0; i < dropped; ++i) result.limbs_[static_cast<std::size_t>(i)] = 0;
    return result;
  }
  friend BigFloatBall widened(const BigFloatBall& a, int k) noexcept { return a.with_error(a.exponent_ + k); }
  friend double approximately(const BigFloatBall& a) noexcept {
    if (a.is_zero()) return 0;
    const double value = std::ldexp(a.fraction(), static_cast<int>(larger(a.exponent_, -1070)));
    return a.negative_ ? -value : value;
  }

  // |true value - this value| <= 2^error_exponent().
  std::int64_t error_exponent() const noexcept { return error_; }
  // Nothing was rounded on the way here.
  bool is_exact() const noexcept { return error_ < kExact / 2; }
  // The exponent of a number that is not 0: 2^(exponent() - 1) <= |value| < 2^exponent().
  std::int64_t exponent() const noexcept { return exponent_; }
  // Times 2^k.
  BigFloatBall scaled(std::int64_t k) const noexcept {
    BigFloatBall result = *this;
    result.exponent_ += k;
    return result.with_error(error_ + k);
  }
  // The same value, whatever the errors.
  friend bool operator==(const BigFloatBall& a, const BigFloatBall& b) noexcept {
    return a.negative_ == b.negative_ && a.exponent_ == b.exponent_ && a.limbs_ == b.limbs_;
  }

  // The same number in more or fewer bits.
  template <std::size_t kOther>
  explicit BigFloatBall(const BigFloatBall<kOther>& other) noexcept
      : exponent_(other.exponent_), error_(other.error_), negative_(other.negative_) {
    constexpr std::size_t kKept = kLimbs < kOther ? kLimbs : kOther;
    for (std::size_t i = 1; i <= kKept; ++i) limbs_[kLimbs - i] = other.limbs_[kOther - i];
    bool lost = false;
    for (std::size_t i = 0; i + kLimbs < kOther; ++i) lost |= other.limbs_[i] != 0;
    if (lost) error_ = larger(error_, exponent_ - kBits + 1) + 1;
  }
  BigFloatBall() noexcept = default;

 private:
  __extension__ using Product = unsigned __int128;
  // The whole numbers that the operations add to exponents of errors are up to four larger than any operands are known to need.
  static constexpr std::int64_t kBits = 64 * static_cast<std::int64_t>(kLimbs);
  static constexpr std::int64_t kExact = -(std::int64_t{1} << 60);
  static constexpr std::int64_t kInfinite = std::int64_t{1} << 58;  // stays far above 0 beside any exponent

  static std::int64_t larger(std::int64_t a, std::int64_t b) noexcept { return a > b ? a : b; }

  std::size_t lowest_limb() const noexcept {
    std::size_t i = 0;
    while (i + 1 < kLimbs && limbs_[i] == 0) ++i;
    return i;
  }
  bool is_zero() const noexcept { return limbs_[kLimbs - 1] == 0; }
  bool is_exact_zero() const noexcept { return is_zero() && is_exact(); }
  // |value| >= 2^(exponent - 1), so an error below 2^(exponent - 2) keeps it away from zero by half of that at least.
  bool may_be_zero() const noexcept { return is_zero() || error_ > exponent_ - 2; }
  // The smallest e known with |true value| < 2^e.
  std::int64_t magnitude() const noexcept { return larger(is_zero() ? kExact : exponent_, error_) + 1; }
  double fraction() const noexcept { return std::ldexp(static_cast<double>(limbs_[kLimbs - 1]), -64); }
  BigFloatBall with_error(std::int64_t error) const noexcept {
    BigFloatBall result = *this;
    result.error_ = error < kExact / 2 ? kExact : error > kInfinite ? kInfinite : error;
    return result;
  }

  static int compare_magnitudes(const BigFloatBall& a, const BigFloatBall& b) noexcept {
    if (a.exponent_ != b.exponent_) return a.exponent_ > b.exponent_ ? 1 : -1;
    for (std::size_t i = kLimbs; i-- > 0;)
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] > b.limbs_[i] ? 1 : -1;
    return 0;
  }

  // True if a nonzero bit was shifted out.
  bool shift_right(std::int64_t count) noexcept {
    if (count >= kBits) {
      limbs_ = {};
      return true;
    }
    const auto whole = static_cast<std::size_t>(count / 64);
    const auto part = static_cast<unsigned>(count % 64);
    bool lost = false;
    for (std::size_t i = 0; i < whole; ++i) lost |= limbs_[i] != 0;
    if (part != 0) lost |= (limbs_[whole] << (64 - part)) != 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const std::uint64_t low = i + whole < kLimbs ? limbs_[i + whole] : 0;
      const std::uint64_t high = i + whole + 1 < kLimbs ? limbs_[i + whole + 1] : 0;
      limbs_[i] = part == 0 ? low : (low >> part) | (high << (64 - part));
    }
    return lost;
  }

  void add_limbs(const BigFloatBall& other) noexcept {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const Product t = Product{limbs_[i]} + other.limbs_[i] + carry;
      limbs_[i] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    if (carry == 0) return;
    // The bit this shift drops is within the one unit that operator+ charges: 2^(exponent - kBits) <= 2^rounding.
    const bool dropped = shift_right(1);
    limbs_[kLimbs - 1] |= std::uint64_t{1} << 63;
    exponent_ += 1;
    if (dropped) error_ = larger(error_, exponent_ - kBits);
  }

  void subtract_limbs(const BigFloatBall& other) noexcept {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const Product t = Product{limbs_[i]} - other.limbs_[i] - borrow;
      limbs_[i] = static_cast<std::uint64_t>(t);
      borrow = static_cast<std::uint64_t>(t >> 64) & 1;
    }
    normalise(0);
  }

  // Moves the leading one to the top bit; `below` supplies the bits that follow the last limb.
  void normalise(std::uint64_t below) noexcept {
    std::size_t top = kLimbs;
    while (top > 0 && limbs_[top - 1] == 0) --top;
    if (top == 0) {
      negative_ = false;
      exponent_ = 0;
      return;
    }
    const std::size_t whole = kLimbs - top;
    const auto part = static_cast<unsigned>(__builtin_clzll(limbs_[top - 1]));
    const auto source = [&](std::size_t i) -> std::uint64_t {  // limb i of the number moved up by `whole`, below included
      return i >= whole ? limbs_[i - whole] : (i + 1 == whole ? below : 0);
    };
    std::array<std::uint64_t, kLimbs> moved{};
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const std::uint64_t lower = i > 0 ? source(i - 1) : (whole == 0 ? below : 0);
      moved[i] = part == 0 ? source(i) : (source(i) << part) | (lower >> (64 - part));
    }
    limbs_ = moved;
    exponent_ -= static_cast<std::int64_t>(64 * whole + part);
  }

  std::array<std::uint64_t, kLimbs> limbs_{};  // least significant first; the value is ±0.limbs · 2^exponent
  std::int64_t exponent_ = 0;
  std::int64_t error_ = kExact;
  bool negative_ = false;
};

}  // namespace forceshade::fast
