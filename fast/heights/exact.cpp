// SPDX-License-Identifier: BSD-3-Clause
#include "fast/heights/exact.h"

#include <algorithm>
#include <span>

#include "fast/heights/all.h"
#include "fast/numbers/arithmetic.h"
#include "fast/numbers/exp_cos_sin.h"

namespace forceshade::fast {
namespace {

using N = BigFloatBall<32>;

// c₀ + c₁t + c₂t² of a polynomial along a line, without what follows.
struct Expansion {
  RootNumber c0, c1, c2;

  Expansion(const RootField& field, const Fraction& value) noexcept : c0(field, value), c1(field), c2(field) {}

  friend Expansion operator+(Expansion a, const Expansion& b) noexcept {
    a.c0 = a.c0 + b.c0;
    a.c1 = a.c1 + b.c1;
    a.c2 = a.c2 + b.c2;
    return a;
  }
  friend Expansion operator*(const Expansion& a, const Expansion& b) noexcept {
    Expansion product = a;
    product.c0 = a.c0 * b.c0;
    product.c1 = a.c0 * b.c1 + a.c1 * b.c0;
    product.c2 = a.c0 * b.c2 + a.c1 * b.c1 + a.c2 * b.c0;
    return product;
  }
  friend Expansion operator*(const Fraction& a, Expansion b) noexcept {
    b.c0 = a * b.c0;
    b.c1 = a * b.c1;
    b.c2 = a * b.c2;
    return b;
  }
};

// Gap, U_x and U_y, and what a polynomial of them is made with.
struct Variables {
  const RootField& field;
  std::array<Expansion, 3> all;

  const Expansion& gap() const noexcept { return all[0]; }
  const Expansion& slope(std::size_t axis) const noexcept { return all[1 + axis]; }
  Expansion constant(const Fraction& value) const noexcept { return {field, value}; }
};

// The sum of exact numbers, each of its own size: e^(-q) times a RootNumber. What is exactly 0 is not added.
class ScaledSum {
 public:
  void add(const RootNumber& factor, const N& scale) noexcept {
    is_exact_ = is_exact_ && factor.is_exact();
    if (factor.is_zero()) return;
    is_empty_ = false;
    sum_ = sum_ + factor.enclosed<N>() * scale;
  }
  // The sign of the sum and of all numbers within `rest` of it, which is not negative.
  Sign sign(const N& rest) const noexcept {
    if (!is_exact_) return Sign::unknown;
    const Sign above = proved_sign(sum_ + rest), below = proved_sign(sum_ - rest);
    return above == below ? above : Sign::unknown;
  }
  bool is_empty() const noexcept { return is_exact_ && is_empty_; }

 private:
  N sum_;
  bool is_exact_ = true, is_empty_ = true;
};

// e^(-q).
N decayed(const Fraction& q) noexcept {
  const N enclosure = enclosed<N>(q);
  return exp_of_minus(enclosure, 2 * approximately(enclosure));
}

N size_of(const Fraction& a) noexcept {
  const N value = enclosed<N>(a);
  return sign(value) == Sign::negative ? -value : value;
}

// Bounds of P₂(δ, δ) + ... by δ², and of P₃(δ, δ, δ) + ... by δ³, where no number of δ is larger than δ: in the domain gap and
// slopes are below 2³⁰, the stiffness below 2¹⁰, a tie below 2⁷⁰.
constexpr double kFromSecondOrderOn = 0x1p144, kFromThirdOrderOn = 0x1p60;

// A numerator of gap or slope has at most this many bits more than its denominator: a spline's, of (x/p)³(y/p)³ and a value.
constexpr std::size_t kNumeratorBits = 450;
constexpr std::size_t kTieBits = 174, kStiffnessBits = 24;
// Three radicands, squares of coordinates, which are multiples of 2⁻⁵³ below 2¹⁵·⁵.
constexpr std::size_t kRadicandBits = 3 * 138;

DenominatorBits sum_of(const std::vector<height::Part>& parts) noexcept {
  DenominatorBits sum;
  for (const height::Part& part : parts) {
    const DenominatorBits one = std::visit([](const auto& shape) { return denominator_bits(shape); }, part.shape);
    sum = {sum.height + one.height, sum.slopes + one.slopes, sum.has_roots || one.has_roots};
  }
  return sum;
}

}  // namespace

// P = K²·gap²·s² - m²(1 + U_x² + U_y²): gap², s², U_x² and U_y² bring their denominators, each of the roots' radicands stands
// in those of the slopes, and once more in each factor of a numerator.
std::size_t bits_of_exact_numbers(const HeightMap& map) noexcept {
  const DenominatorBits direction = sum_of(map.parts), depth = map.surface.empty() ? direction : sum_of(map.surface);
  const bool has_roots = direction.has_roots || depth.has_roots;
  const std::size_t roots = has_roots ? kRadicandBits : 0;
  return 2 * depth.height + 6 * (direction.slopes + roots) + 4 * roots + 4 * kNumeratorBits + 2 * (kTieBits + kStiffnessBits);
}

ExactPlace::ExactPlace(const Place& at, double z, height::Mode mode, double stiffness) noexcept
    : at_(at), mode_(mode), stiffness_(Fraction::exactly(stiffness)) {
  terms_[0].factors[0] = Fraction::exactly(-z);
}

void ExactPlace::add_term(Kind kind, const Fraction& key, const Jet<Fraction>& factors, const Use& use) noexcept {
  const auto end = terms_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto like = kind == Kind::rational ? terms_.begin() : std::find_if(terms_.begin() + 1, end, [&](const Term& term) {
    return term.kind == kind && (term.key - key).is_zero();
  });
  if (like == end) {
    ++count_;
    like->kind = kind;
    like->key = key;
    like->factors = {};
  }
  const Fraction factor = Fraction::exactly(use.factor);
  if (use.gap) like->factors[0] = like->factors[0] + factor * factors.U;
  if (use.slopes) like->factors[1] = like->factors[1] + factor * factors.Ux;
  if (use.slopes) like->factors[2] = like->factors[2] + factor * factors.Uy;
}

void ExactTerms::add_rational(const Jet<Fraction>& jet) noexcept {
  place_.add_term(ExactPlace::Kind::rational, {}, jet, use_);
}
void ExactTerms::add_root(const Fraction& radicand, const Jet<Fraction>& factors) noexcept {
  place_.add_term(ExactPlace::Kind::root, radicand, factors, use_);
}
void ExactTerms::add_decay(const Fraction& q, const Jet<Fraction>& factors) noexcept {
  place_.add_term(ExactPlace::Kind::decay, q, factors, use_);
}
void ExactTerms::add_wave(const Fraction& angle, const Jet<Fraction>& factors) noexcept {
  place_.add_term(ExactPlace::Kind::wave, angle, factors, use_);
}

void ExactPlace::add(const EvaluatedShape& shape, const Use& use) noexcept {
  ExactTerms terms(*this, use);
  std::visit([&](const auto& one) { add_terms(one, at_, terms); }, shape);
}

// reads: which of gap, U_x and U_y the polynomial reads; is_quadratic: its degree is 2 at most.
template <class Polynomial>
Sign ExactPlace::sign_of(const Polynomial& polynomial, const std::array<bool, 3>& reads, bool is_quadratic) const noexcept {
  RootField field;
  std::array<RootNumber, 3> base{RootNumber(field), RootNumber(field), RootNumber(field)};
  std::array<const Term*, kMostParts> decays;
  std::size_t decay_count = 0;
  for (const Term& term : std::span(terms_.data(), count_)) {
    const auto is_used = [&](std::size_t i) { return reads[i] && !term.factors[i].is_zero(); };
    if (!is_used(0) && !is_used(1) && !is_used(2)) continue;
    if (term.kind == Kind::wave) return Sign::unknown;
    if (term.kind == Kind::decay) {
      decays[decay_count++] = &term;
      continue;
    }
    const auto root = term.kind == Kind::root ? field.root(term.key) : RootField::Root{Fraction::exactly(1), 0};
    if (!root) return Sign::unknown;
    for (std::size_t i = 0; i < base.size(); ++i)
      base[i].add(*root, i > 0 && term.kind == Kind::root ? term.factors[i] / term.key : term.factors[i]);
  }
  // Along base + t·(sign·factors of one decay + factors of another).
  const auto expanded = [&](const Term& one, const Term* other, double sign) {
    Variables variables{field, {Expansion(field, {}), Expansion(field, {}), Expansion(field, {})}};
    for (std::size_t i = 0; i < base.size(); ++i) {
      variables.all[i].c0 = base[i];
      const Fraction along = other == nullptr ? one.factors[i] : one.factors[i] + Fraction::exactly(sign) * other->factors[i];
      variables.all[i].c1 = RootNumber(field, along);
    }
    return polynomial(variables);
  };

  ScaledSum sum;
  const Term level;
  sum.add(expanded(level, nullptr, 1).c0, N::exactly(1));
  if (decay_count == 0) return sum.sign(N::exactly(0));

  std::array<N, kMostParts> scales;
  N size = N::exactly(0);  // δ
  for (std::size_t g = 0; g < decay_count; ++g) {
    scales[g] = decayed(decays[g]->key);
    for (const Fraction& factor : decays[g]->factors) size = size + size_of(factor) * scales[g];
    sum.add(expanded(*decays[g], nullptr, 1).c1, scales[g]);
  }
  const Sign by_first_order = sum.is_empty() ? Sign::unknown : sum.sign(N::exactly(kFromSecondOrderOn) * size * size);
  if (by_first_order != Sign::unknown) return by_first_order;

  // Half of P₂(a + b) - P₂(a - b) is what the two products of e^(-q) and e^(-q') have as their factor.
  const Fraction half = Fraction::exactly(0.5);
  for (std::size_t g = 0; g < decay_count; ++g) {
    sum.add(expanded(*decays[g], nullptr, 1).c2, scales[g] * scales[g]);
    for (std::size_t h = 0; h < g; ++h)
      sum.add(half * (expanded(*decays[g], decays[h], 1).c2 + -expanded(*decays[g], decays[h], -1).c2), scales[g] * scales[h]);
  }
  return sum.sign(is_quadratic ? N::exactly(0) : N::exactly(kFromThirdOrderOn) * size * size * size);
}

Sign ExactPlace::sign_of_gap() const noexcept {
  return sign_of([](const Variables& v) { return v.gap(); }, {true, false, false}, true);
}

// With F = K·gap·s/n and n = √(1 + U_x² + U_y²), s one of -U_x, -U_y and 1, F and the tie are compared by their squares.
Sign ExactPlace::sign_of_excess(std::size_t axis, double tie) const noexcept {
  const Fraction exact_tie = Fraction::exactly(tie), minus_one = Fraction::exactly(-1);
  const auto push = [&](const Variables& v) {
    const Expansion size = stiffness_ * v.gap();
    return axis == 2 ? size : minus_one * (size * v.slope(axis));
  };
  if (mode_ == height::Mode::conservative)
    return sign_of([&](const Variables& v) { return push(v) + v.constant(-exact_tie); }, {true, axis == 0, axis == 1}, true);
  const Sign of_squares = sign_of(
      [&](const Variables& v) {
        const Expansion one = v.constant(Fraction::exactly(1)), F = push(v);
        const Expansion n_squared = one + v.slope(0) * v.slope(0) + v.slope(1) * v.slope(1);
        return F * F + -(exact_tie * exact_tie) * n_squared;
      },
      {true, true, true}, axis == 2);
  if (tie > 0 || of_squares == Sign::zero || of_squares == Sign::unknown) return of_squares;
  return of_squares == Sign::positive ? Sign::negative : Sign::positive;
}

Sign ExactPlace::sign_of_slope_excess(std::size_t axis, double tie) const noexcept {
  return sign_of([&](const Variables& v) { return v.slope(axis) + v.constant(Fraction::exactly(-tie)); },
                 {false, axis == 0, axis == 1}, true);
}

const char* ExactPlace::arithmetic_fault() noexcept {
  return arithmetic_fault_here();
}

}  // namespace forceshade::fast
