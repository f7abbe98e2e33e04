// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact integers whose type holds a bound of their size: no operation rounds or overflows, and none allocates.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fast/numbers/inline.h"

namespace forceshade::fast {

// |value| < 2^kBits. The result of an operation is of the type that holds it for any operands, so a predicate that compiles
// proves how many bits it takes.
template <int kBits>
class FixedInteger {
  static_assert(kBits >= 1);
  template <int kOther>
  friend class FixedInteger;
  template <int kA, int kB>
  friend constexpr int compare_sizes(const FixedInteger<kA>& a, int shift, const FixedInteger<kB>& b) noexcept;
  __extension__ using Double = unsigned __int128;

 public:
  static constexpr int kMostBits = kBits;
  static constexpr std::size_t kWords = static_cast<std::size_t>(kBits) / 64 + 1;

  constexpr FixedInteger() noexcept = default;
  // |value| < 2^kBits.
  constexpr explicit FixedInteger(std::int64_t value) noexcept {
    words_.fill(value < 0 ? ~std::uint64_t{0} : 0);
    words_[0] = static_cast<std::uint64_t>(value);
  }
  // Two's complement, least significant word first.
  using Words = std::array<std::uint64_t, kWords>;
  constexpr explicit FixedInteger(const Words& words) noexcept : words_(words) {}
  constexpr const Words& words() const noexcept { return words_; }
  // The same number; fewer bits widen by themselves.
  template <int kOther>
  requires(kOther < kBits) constexpr FixedInteger(const FixedInteger<kOther>& other) noexcept {
    words_.fill(other.is_negative() ? ~std::uint64_t{0} : 0);
    for (std::size_t i = 0; i < other.kWords; ++i) words_[i] = other.words_[i];
  }

  // significand * 2^shift: |significand| < 2^63, 0 <= shift, and the result fits.
  static constexpr FixedInteger scaled(std::int64_t significand, int shift) noexcept {
    FixedInteger result;
    const auto size = static_cast<std::uint64_t>(significand < 0 ? -significand : significand);
    const auto whole = static_cast<std::size_t>(shift) / 64;
    const int part = shift % 64;
    result.words_[whole] = size << part;
    if (part != 0 && whole + 1 < kWords) result.words_[whole + 1] = size >> (64 - part);
    return significand < 0 ? -result : result;
  }

  constexpr bool is_negative() const noexcept { return (words_[kWords - 1] >> 63) != 0; }
  constexpr bool is_zero() const noexcept {
    std::uint64_t any = 0;
    for (const std::uint64_t word : words_) any |= word;
    return any == 0;
  }
  // -1, 0 or 1.
  constexpr int sign() const noexcept { return is_negative() ? -1 : is_zero() ? 0 : 1; }

  constexpr FixedInteger operator-() const noexcept {
    FixedInteger result;
    std::uint64_t carry = 1;
    for (std::size_t i = 0; i < kWords; ++i) {
      result.words_[i] = ~words_[i] + carry;
      carry = carry != 0 && result.words_[i] == 0 ? 1 : 0;
    }
    return result;
  }

  template <int kOther>
  constexpr auto operator+(const FixedInteger<kOther>& other) const noexcept {
    using Sum = FixedInteger<std::max(kBits, kOther) + 1>;
    return Sum::sum(*this, other, 0);
  }
  template <int kOther>
  constexpr auto operator-(const FixedInteger<kOther>& other) const noexcept {
    using Sum = FixedInteger<std::max(kBits, kOther) + 1>;
    return Sum::sum(*this, other, ~std::uint64_t{0});
  }
  template <int kOther>
  constexpr auto operator*(const FixedInteger<kOther>& other) const noexcept {
    return FixedInteger<kBits + kOther>::product(size(), other.size(), is_negative() != other.is_negative());
  }

  // Times 2^kShift.
  template <int kShift>
  constexpr auto shifted() const noexcept {
    return *this * FixedInteger<kShift + 1>::scaled(1, kShift);
  }

  // The sign of the difference.
  template <int kOther>
  constexpr int compare(const FixedInteger<kOther>& other) const noexcept {
    return (*this - other).sign();
  }

  // The bits of its size: 0 for 0, else one more than the exponent of its leading bit.
  constexpr int bit_length() const noexcept {
    const Words words = size();
    for (std::size_t i = kWords; i-- > 0;)
      if (words[i] != 0) return 64 * static_cast<int>(i) + 64 - __builtin_clzll(words[i]);
    return 0;
  }

  // Within 2^-52 of it, relative; kBits is at most 1000.
  double approximately() const noexcept {
    static_assert(kBits <= 1000);
    const auto size_words = size();
    std::size_t top = kWords - 1;
    while (top > 0 && size_words[top] == 0) --top;
    double value = static_cast<double>(size_words[top]);
    if (top > 0) value = value * 0x1p64 + static_cast<double>(size_words[top - 1]);
    if (top > 1) value = std::ldexp(value, 64 * (static_cast<int>(top) - 1));
    return is_negative() ? -value : value;
  }

 private:
  // a + b, or a - b where `flip` is all ones: then b's complement is added, and 1.
  static constexpr FixedInteger sum(const FixedInteger& a, const FixedInteger& b, std::uint64_t flip) noexcept {
    FixedInteger result;
    std::uint64_t carry = flip & 1;
    for (std::size_t i = 0; i < kWords; ++i) {
      const Double t = Double{a.words_[i]} + (b.words_[i] ^ flip) + carry;
      result.words_[i] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    return result;
  }

  // The size times 2^shift, for a result that fits.
  constexpr FixedInteger size_shifted(int shift) const noexcept {
    const Words words = size();
    FixedInteger result;
    const auto whole = static_cast<std::size_t>(shift) / 64;
    const int part = shift % 64;
    for (std::size_t i = whole; i < kWords; ++i) {
      result.words_[i] = words[i - whole] << part;
      if (part != 0 && i > whole) result.words_[i] |= words[i - whole - 1] >> (64 - part);
    }
    return result;
  }

  // The product of two sizes. The words above kBits + kOther are zero, so those of `a` times those of `b` that lie there are
  // too.
  template <std::size_t kA, std::size_t kB>
  static constexpr FixedInteger product(const std::array<std::uint64_t, kA>& a, const std::array<std::uint64_t, kB>& b,
                                        bool is_negative) noexcept {
    FixedInteger result;
    for (std::size_t i = 0; i < kA; ++i) {
      if (a[i] == 0) continue;
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < kB && i + j < kWords; ++j) {
        const Double t = Double{a[i]} * b[j] + result.words_[i + j] + carry;
        result.words_[i + j] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
      if (i + kB < kWords) result.words_[i + kB] = carry;
    }
    return is_negative ? -result : result;
  }

  constexpr Words size() const noexcept { return is_negative() ? (-*this).words_ : words_; }

  Words words_{};
};

// The sign of |a|·2^shift - |b|.
template <int kA, int kB>
constexpr int compare_sizes(const FixedInteger<kA>& a, int shift, const FixedInteger<kB>& b) noexcept {
  const int a_length = a.bit_length(), b_length = b.bit_length();
  if (a_length == 0 || b_length == 0) return (a_length != 0 ? 1 : 0) - (b_length != 0 ? 1 : 0);
  if (a_length + shift != b_length) return a_length + shift > b_length ? 1 : -1;
  // Both are equally long when shifted, so both fit the longer type.
  using Longer = FixedInteger<std::max(kA, kB)>;
  return Longer(a).size_shifted(shift > 0 ? shift : 0).compare(Longer(b).size_shifted(shift < 0 ? -shift : 0));
}

// A coordinate in units of 2^-53 mm. It is 0, or between 2^-30 and 10^4 mm in size: the last bit of a binary32 of 2^-30 is
// 2^-53, and 10^4·2^53 < 2^67.
using Coordinate = FixedInteger<67>;
inline Coordinate in_units(float coordinate) noexcept {
  const auto bits = __builtin_bit_cast(std::uint32_t, coordinate);
  const auto exponent = static_cast<int>(bits >> 23 & 0xFFU);
  if (exponent == 0) return {};
  const auto significand = static_cast<std::int64_t>((bits & 0x7FFFFFU) | 0x800000U);
  constexpr int kLeastExponent = 127 - 30;
  return Coordinate::scaled((bits >> 31) != 0 ? -significand : significand, exponent - kLeastExponent);
}

}  // namespace forceshade::fast
