// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact numbers with a few square roots in them: Σ c_S·√(Π_{i in S} D_i) over the subsets S of up to three roots, c_S rational.

#include <array>
#include <cstddef>
#include <optional>

#include "fast/numbers/fraction.h"

namespace forceshade::fast {

// The radicands that the numbers of one calculation share: no product of some of them is a square, so the roots of these
// products are linearly independent over the rationals, and a number is 0 only if all its c_S are.
class RootField {
 public:
  static constexpr std::size_t kMostRoots = 3, kProducts = 1U << kMostRoots;  // a subset is a number, bit i for D_i

  // √radicand as a factor and a subset. Adds the radicand if none of the products is its relative; empty where there is no
  // room for it, or where the radicand has more than 256 bits. The radicand: positive.
  struct Root {
    Fraction factor;
    std::size_t subset;
  };
  std::optional<Root> root(const Fraction& radicand) noexcept;

  // The fault of root_field.cpp, as arithmetic_fault_here() of fast/numbers/arithmetic.h.
  static const char* arithmetic_fault() noexcept;

  // Π_{i in S} D_i.
  const Fraction& product(std::size_t subset) const noexcept { return products_[subset]; }

 private:
  std::array<Fraction, kProducts> products_{Fraction::exactly(1)};
  std::size_t count_ = 0;
};

// An element of the field that it points to.
class RootNumber {
 public:
  explicit RootNumber(const RootField& field) noexcept : field_(&field) {}
  RootNumber(const RootField& field, const Fraction& value) noexcept : RootNumber(field) { factors_[0] = value; }

  void add(const RootField::Root& root, const Fraction& factor) noexcept {
    factors_[root.subset] = factors_[root.subset] + root.factor * factor;
  }
  RootNumber operator-() const noexcept {
    RootNumber result = *this;
    for (Fraction& factor : result.factors_) factor = -factor;
    return result;
  }
  friend RootNumber operator+(const RootNumber& a, const RootNumber& b) noexcept {
    RootNumber sum(*a.field_);
    for (std::size_t s = 0; s < a.factors_.size(); ++s) sum.factors_[s] = a.factors_[s] + b.factors_[s];
    return sum;
  }
  friend RootNumber operator*(const RootNumber& a, const RootNumber& b) noexcept {
    RootNumber product(*a.field_);
    for (std::size_t s = 0; s < a.factors_.size(); ++s)
      for (std::size_t t = 0; t < a.factors_.size(); ++t)
        if (!a.factors_[s].is_zero() && !b.factors_[t].is_zero())
          product.factors_[s ^ t] = product.factors_[s ^ t] + a.factors_[s] * b.factors_[t] * a.field_->product(s & t);
    return product;
  }
  friend RootNumber operator*(const Fraction& a, const RootNumber& b) noexcept { return RootNumber(*b.field_, a) * b; }

  bool is_exact() const noexcept {
    for (const Fraction& factor : factors_)
      if (!factor.is_exact()) return false;
    return true;
  }
  bool is_zero() const noexcept {
    for (const Fraction& factor : factors_)
      if (!factor.is_zero()) return false;
    return true;
  }

  // An enclosure of it.
  template <class N>
  N enclosed() const noexcept {
    N sum = N::exactly(0);
    for (std::size_t s = 0; s < factors_.size(); ++s)
      if (!factors_[s].is_zero())
        sum = sum + fast::enclosed<N>(factors_[s]) * square_root(fast::enclosed<N>(field_->product(s)));
    return sum;
  }

 private:
  const RootField* field_;
  std::array<Fraction, RootField::kProducts> factors_;
};

}  // namespace forceshade::fast
