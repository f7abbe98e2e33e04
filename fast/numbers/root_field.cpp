// SPDX-License-Identifier: BSD-3-Clause
#include "fast/numbers/root_field.h"

#include "fast/numbers/arithmetic.h"

namespace forceshade::fast {
namespace {

using Integer = Fraction::Integer;

constexpr std::size_t kRadicandLimbs = 4, kSquareLimbs = (RootField::kMostRoots + 1) * kRadicandLimbs,
                      kRootLimbs = kSquareLimbs / 2;

// The root of a square: Newton's, rounded to the bits that it can have, if its square is the number.
std::optional<Fraction> exact_root(const Fraction& square) noexcept {
  if (!square.is_whole()) return std::nullopt;
  const BigFloatBall<kSquareLimbs> wide(square.numerator());
  if (!wide.is_exact()) return std::nullopt;
  const BigFloatBall<kSquareLimbs> root = square_root(wide);
  const auto half_a_unit =
      BigFloatBall<kSquareLimbs>::exactly(1).scaled(root.exponent() - static_cast<std::int64_t>(64 * kRootLimbs) - 1);
  const Integer rounded(midpoint(BigFloatBall<kRootLimbs>(midpoint(root + half_a_unit))));
  if (!(rounded * rounded == square.numerator())) return std::nullopt;
  return Fraction::whole(rounded);
}

}  // namespace

std::optional<RootField::Root> RootField::root(const Fraction& radicand) noexcept {
  for (std::size_t s = 0; s < (std::size_t{1} << count_); ++s)
    if (const auto whole = exact_root(radicand * products_[s])) return Root{*whole / products_[s], s};  // √D = √(D P)/P·√P
  const bool is_short = radicand.is_whole() && BigFloatBall<kRadicandLimbs>(radicand.numerator()).is_exact();
  if (!is_short || count_ == kMostRoots) return std::nullopt;
  const std::size_t added = std::size_t{1} << count_++;
  for (std::size_t s = 0; s < added; ++s) products_[added | s] = products_[s] * radicand;
  return Root{Fraction::exactly(1), added};
}

const char* RootField::arithmetic_fault() noexcept {
  return arithmetic_fault_here();
}

}  // namespace forceshade::fast
