// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact integers of any length up to a proved one, on the stack.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace forceshade::fast::soups {

// |value| < 2^(64 kLimbs). No operation rounds. That none of docs/soups.md needs more limbs is proved by soup_bits_test, which
// runs the polynomials on numbers that count bits. A result that may need more is cut, and counted.
class Whole {
 public:
  static constexpr std::size_t kLimbs = 138;
  // In this thread: 0, unless the proof is wrong. A tick in which it grows is unfinished, and tests expect 0.
  static inline thread_local std::uint64_t cuts = 0;

  Whole() noexcept = default;
  explicit Whole(std::int64_t value) noexcept { set(value, 0); }
  Whole(const Whole& other) noexcept : size_(other.size_), negative_(other.negative_) {
    std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
  }
  Whole& operator=(const Whole& other) noexcept {
    size_ = other.size_;
    negative_ = other.negative_;
    if (this != &other) std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
    return *this;
  }
  ~Whole() = default;

  // significand * 2^shift, 0 <= shift.
  static Whole scaled(std::int64_t significand, int shift) noexcept {
    Whole result;
    result.set(significand, shift);
    return result;
  }
  static Whole of(std::int64_t value) noexcept { return Whole(value); }

  int sign() const noexcept { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
  bool is_zero() const noexcept { return size_ == 0; }

  Whole operator-() const noexcept {
    Whole result = *this;
    result.negative_ = !negative_ && size_ > 0;
    return result;
  }
  friend Whole operator+(const Whole& a, const Whole& b) noexcept { return sum(a, b, b.negative_); }
  friend Whole operator-(const Whole& a, const Whole& b) noexcept { return sum(a, b, !b.negative_); }
  friend Whole operator*(const Whole& a, const Whole& b) noexcept {
    Whole result;
    if (a.size_ == 0 || b.size_ == 0) return result;
    const std::size_t size = held(a.size_ + b.size_);
    std::fill_n(result.limbs_.begin(), size, std::uint64_t{0});
    for (std::size_t i = 0; i < a.size_; ++i) {
      const std::uint64_t factor = a.limbs_[i];
      std::uint64_t carry = 0;
      std::size_t j = 0;
      for (; j < b.size_ && i + j < size; ++j) {
        const Double t = Double{factor} * b.limbs_[j] + result.limbs_[i + j] + carry;
        result.limbs_[i + j] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
      if (i + j < size) result.limbs_[i + j] = carry;
    }
    result.size_ = size;
    result.trim();
    result.negative_ = a.negative_ != b.negative_ && result.size_ > 0;
    return result;
  }

  // Times 2^count, count >= 0.
  Whole shifted(int count) const noexcept {
    Whole result;
    if (size_ == 0) return result;
    const auto whole = static_cast<std::size_t>(count) / 64;
    const int part = count % 64;
    const std::size_t size = held(size_ + whole + 1);
    for (std::size_t i = size; i-- > 0;) {
      const std::uint64_t upper = i >= whole && i - whole < size_ ? limbs_[i - whole] : 0;
      const std::uint64_t lower = i > whole && i - whole - 1 < size_ ? limbs_[i - whole - 1] : 0;
      result.limbs_[i] = part == 0 ? upper : upper << part | lower >> (64 - part);
    }
    result.size_ = size;
    result.trim();
    result.negative_ = negative_;
    return result;
  }

  int bits() const noexcept { return size_ == 0 ? 0 : 64 * static_cast<int>(size_) - __builtin_clzll(limbs_[size_ - 1]); }

  // a/b within kRatioError, relative, but where that is below 2^-1000; b is not 0.
  static constexpr double kRatioError = 0x1p-49;
  friend double ratio(const Whole& a, const Whole& b) noexcept {
    return std::ldexp(a.leading() / b.leading(), 64 * (static_cast<int>(a.size_) - static_cast<int>(b.size_)));
  }
  // As a binary64 number of the same size times 2^(64 (limbs() - 1)).
  double leading() const noexcept {
    if (size_ == 0) return 0;
    double value = static_cast<double>(limbs_[size_ - 1]);
    if (size_ > 1) value += static_cast<double>(limbs_[size_ - 2]) * 0x1p-64;
    return negative_ ? -value : value;
  }

 private:
  __extension__ using Double = unsigned __int128;

  // The limbs that are kept of so many.
  static std::size_t held(std::size_t size) noexcept {
    if (size <= kLimbs) [[likely]]
      return size;
    ++cuts;
    return kLimbs;
  }
  void set(std::int64_t significand, int shift) noexcept {
    const auto size = static_cast<std::uint64_t>(significand < 0 ? -significand : significand);
    const auto whole = static_cast<std::size_t>(shift) / 64;
    const int part = shift % 64;
    std::fill_n(limbs_.begin(), whole, std::uint64_t{0});
    limbs_[whole] = size << part;
    limbs_[whole + 1] = part == 0 ? 0 : size >> (64 - part);
    size_ = whole + 2;
    trim();
    negative_ = significand < 0;
  }
  void trim() noexcept {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }
  static int compare_sizes(const Whole& a, const Whole& b) noexcept {
    if (a.size_ != b.size_) return a.size_ > b.size_ ? 1 : -1;
    for (std::size_t i = a.size_; i-- > 0;)
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] > b.limbs_[i] ? 1 : -1;
    return 0;
  }
  // a plus the size of b with this sign.
  static Whole sum(const Whole& a, const Whole& b, bool negative) noexcept {
    Whole result;
    const bool a_is_larger = compare_sizes(a, b) >= 0;
    const Whole &large = a_is_larger ? a : b, &small = a_is_larger ? b : a;
    std::uint64_t carry = 0;
    if (a.negative_ == negative || a.size_ == 0) {
      for (std::size_t i = 0; i < large.size_; ++i) {
        const Double t = Double{large.limbs_[i]} + (i < small.size_ ? small.limbs_[i] : 0) + carry;
        result.limbs_[i] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
      result.size_ = large.size_;
      if (carry != 0 && held(result.size_ + 1) > result.size_) result.limbs_[result.size_++] = carry;
    } else {
      for (std::size_t i = 0; i < large.size_; ++i) {
        const Double t = Double{large.limbs_[i]} - (i < small.size_ ? small.limbs_[i] : 0) - carry;
        result.limbs_[i] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64) & 1;
      }
      result.size_ = large.size_;
      result.trim();
    }
    result.negative_ = result.size_ > 0 && (a_is_larger ? a.size_ > 0 && a.negative_ : negative);
    return result;
  }

  std::size_t size_ = 0;
  bool negative_ = false;
  std::array<std::uint64_t, kLimbs> limbs_;  // least significant first; those from size_ on are not set
};

}  // namespace forceshade::fast::soups
