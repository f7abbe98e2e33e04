// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The cheap enclosure: a 64-bit (or longer) midpoint with a radius, enough to round all but a few points in a million.
// A comparison it cannot decide throws Undecided; the exact kernel then decides.

#include <algorithm>
#include <cmath>
#include <limits>

namespace forceshade::reference {

struct Undecided {};

// |true value - mid| <= rad.
class Ball64 {
 public:
  Ball64(double exact = 0) : mid_(exact) {}
  Ball64(long double mid, long double rad) : mid_(mid), rad_(rad) {}

  long double mid() const { return mid_; }
  long double rad() const { return rad_; }
  // Nothing it may stand for lies beyond.
  long double low() const { return mid_ - reach(); }
  long double high() const { return mid_ + reach(); }

  friend Ball64 operator-(const Ball64& a) { return {-a.mid_, a.rad_}; }
  friend Ball64 operator+(const Ball64& a, const Ball64& b) { return rounded(a.mid_ + b.mid_, a.rad_ + b.rad_); }
  friend Ball64 operator-(const Ball64& a, const Ball64& b) { return rounded(a.mid_ - b.mid_, a.rad_ + b.rad_); }
  friend Ball64 operator*(const Ball64& a, const Ball64& b) {
    // The positions and parameters themselves: 24 bits each, so their product is exact. Edges such as 2|x| = w need that.
    if (a.is_binary32() && b.is_binary32()) return {a.mid_ * b.mid_, 0};
    return rounded(a.mid_ * b.mid_, std::fabs(a.mid_) * b.rad_ + a.rad_ * (std::fabs(b.mid_) + b.rad_));
  }
  // Negative by no more than a rounding, where the product of a wide ball with itself would be.
  friend Ball64 square(const Ball64& a) {
    if (a.rad_ <= 0x1p-8L * std::fabs(a.mid_)) return a * a;
    const long double most = std::fabs(a.mid_) + a.rad_, least = std::max(0.0L, std::fabs(a.mid_) - a.rad_);
    const long double low = least * least * (1 - 4 * kUnit), high = most * most * (1 + 4 * kUnit), mid = low + (high - low) / 2;
    return {mid, std::max(high - mid, mid - low) * (1 + 4 * kUnit)};
  }
  friend Ball64 operator/(const Ball64& a, const Ball64& b) {
    if (a.mid_ == b.mid_ && a.rad_ == 0 && b.rad_ == 0 && a.mid_ != 0) return 1.0;
    const long double smallest = std::fabs(b.mid_) * (1 - kUnit) - b.rad_;
    if (!(smallest > 0)) throw Undecided{};
    const long double q = a.mid_ / b.mid_;
    return rounded(q, (a.rad_ + std::fabs(q) * b.rad_) / smallest);
  }
  friend Ball64 sqrt(const Ball64& a) {
    if (a.mid_ == 0 && a.rad_ == 0) return a;
    if (!(a.mid_ * (1 - kUnit) > a.rad_)) throw Undecided{};
    const long double root = std::sqrt(a.mid_);
    return rounded(root, a.rad_ / root);
  }

  friend bool operator<(const Ball64& a, const Ball64& b) {
    if (a.mid_ + a.rad_ + slack(a, b) < b.mid_ - b.rad_) return true;
    if (a.mid_ - a.rad_ - slack(a, b) >= b.mid_ + b.rad_) return false;
    throw Undecided{};
  }
  friend bool operator>(const Ball64& a, const Ball64& b) { return b < a; }
  friend bool operator<=(const Ball64& a, const Ball64& b) { return !(b < a); }

  // The binary32 both ends round to; throws Undecided when they differ.
  float round() const {
    const auto least = static_cast<float>(low()), most = static_cast<float>(high());
    if (least != most) throw Undecided{};
    return least + 0.0F;
  }

 private:
  long double reach() const { return rad_ * (1 + kUnit) + std::fabs(mid_) * (rad_ == 0 ? 0 : kUnit); }
  bool is_binary32() const { return rad_ == 0 && static_cast<long double>(static_cast<float>(mid_)) == mid_; }

  // Twice the unit roundoff: covers the operation and the arithmetic of its radius.
  static constexpr long double kUnit = std::numeric_limits<long double>::epsilon();

  static Ball64 rounded(long double mid, long double propagated) {
    return {mid, propagated * (1 + 4 * kUnit) + std::fabs(mid) * kUnit};
  }
  static long double slack(const Ball64& a, const Ball64& b) {
    return a.rad_ + b.rad_ == 0 ? 0 : kUnit * (std::fabs(a.mid_) + std::fabs(b.mid_));
  }

  long double mid_;
  long double rad_ = 0;
};

}  // namespace forceshade::reference
