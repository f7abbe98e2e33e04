// SPDX-License-Identifier: BSD-3-Clause
#include "reference/numbers/exponential_sum.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace forceshade::reference {
namespace {

using Integer = ExponentialSum::Integer;
using Rational = ExponentialSum::Rational;

std::optional<Integer> integer_root(const Integer& square) {
  if (mpz_perfect_square_p(square.backend().data()) == 0) return std::nullopt;
  return Integer(boost::multiprecision::sqrt(square));
}

Enclosure enclosure_of(const Rational& value) {
  Enclosure result;
  mpfi_set_q(result.backend().data(), value.backend().data());
  return result;
}

Enclosure root_of(const Integer& value) {
  Enclosure result;
  mpfi_set_z(result.backend().data(), value.backend().data());
  return sqrt(result);
}

}  // namespace

void ExponentialSum::add(Term term) {
  if (term.factor == 0) return;
  if (term.radicand != 1)
    if (const auto root = integer_root(term.radicand)) {
      term.factor *= Rational(*root);
      term.radicand = 1;
    }
  for (auto like = terms_.begin(); like != terms_.end(); ++like) {
    if (like->is_sine != term.is_sine || like->decay != term.decay || like->angle != term.angle) continue;
    // √D' = (√(D D')/D)·√D, where the product is a square.
    const auto root = integer_root(like->radicand * term.radicand);
    if (!root) continue;
    like->factor += term.factor * Rational(*root, like->radicand);
    if (like->factor == 0) terms_.erase(like);
    return;
  }
  terms_.push_back(std::move(term));
}

ExponentialSum ExponentialSum::operator-() const {
  ExponentialSum result = *this;
  for (Term& term : result.terms_) term.factor = -term.factor;
  return result;
}

ExponentialSum operator+(const ExponentialSum& a, const ExponentialSum& b) {
  ExponentialSum sum = a;
  for (const ExponentialSum::Term& term : b.terms_) sum.add(term);
  return sum;
}

ExponentialSum operator*(const ExponentialSum& a, const ExponentialSum& b) {
  ExponentialSum product;
  for (const ExponentialSum::Term& s : a.terms_)
    for (const ExponentialSum::Term& t : b.terms_) {
      const Integer shared = gcd(s.radicand, t.radicand);
      ExponentialSum::Term one{s.factor * t.factor * Rational(shared), (s.radicand / shared) * (t.radicand / shared),
                               s.decay + t.decay, 0, false};
      if (s.angle == 0 || t.angle == 0) {
        one.angle = s.angle + t.angle;
        one.is_sine = s.is_sine || t.is_sine;
        product.add(one);
        continue;
      }
      // 2 cos a cos b = cos(a - b) + cos(a + b), 2 sin a sin b = cos(a - b) - cos(a + b), 2 sin a cos b = sin(a + b) + sin(a -
      // b).
      one.factor /= 2;
      one.is_sine = s.is_sine != t.is_sine;
      ExponentialSum::Term other = one;
      one.angle = s.angle + t.angle;
      if (s.is_sine && t.is_sine) one.factor = -one.factor;
      const Rational difference = s.is_sine ? Rational(s.angle - t.angle) : Rational(t.angle - s.angle);
      other.angle = abs(difference);
      if (other.is_sine && difference < 0) other.factor = -other.factor;
      product.add(one);
      if (!(other.is_sine && difference == 0)) product.add(other);
    }
  return product;
}

ExponentialSum operator/(const ExponentialSum& a, const ExponentialSum& b) {
  if (b.terms_.size() != 1 || b.terms_.front().decay != 0 || b.terms_.front().angle != 0)
    throw std::logic_error("exponential sum: expected a divisor of one root");
  const ExponentialSum::Term& divisor = b.terms_.front();
  ExponentialSum inverse;
  inverse.add({1 / (divisor.factor * Rational(divisor.radicand)), divisor.radicand});
  return a * inverse;
}

ExponentialSum::Rational ExponentialSum::as_rational() const {
  if (terms_.empty()) return 0;
  const Term& only = terms_.front();
  if (terms_.size() != 1 || only.radicand != 1 || only.decay != 0 || only.angle != 0)
    throw std::logic_error("exponential sum: expected a rational argument");
  return only.factor;
}

// √(p/q) = √(p q)/q.
ExponentialSum sqrt(const ExponentialSum& a) {
  const Rational value = a.as_rational();
  if (value < 0) throw std::logic_error("exponential sum: the root of a negative number");
  ExponentialSum root;
  if (value == 0) return root;
  const Integer radicand = numerator(value) * denominator(value);
  root.add({Rational(Integer(1), denominator(value)), radicand});
  return root;
}

ExponentialSum exp(const ExponentialSum& a) {
  const Rational decay = -a.as_rational();
  if (decay < 0) throw std::logic_error("exponential sum: expected a decaying exponential");
  ExponentialSum result;
  result.add({1, 1, decay});
  return result;
}

ExponentialSum cos(const ExponentialSum& a) {
  ExponentialSum result;
  result.add({1, 1, 0, abs(a.as_rational())});
  return result;
}

ExponentialSum sin(const ExponentialSum& a) {
  const Rational angle = a.as_rational();
  ExponentialSum result;
  if (angle != 0) result.add({angle < 0 ? -1 : 1, 1, 0, abs(angle), true});
  return result;
}

// Encloses e^least_decay times the sum, at the precision last set.
Enclosure ExponentialSum::enclosure(const Rational& least_decay) const {
  Enclosure sum(0);
  for (const Term& term : terms_) {
    Enclosure value = enclosure_of(term.factor);
    if (term.radicand != 1) value *= root_of(term.radicand);
    if (term.decay != least_decay) value *= exp(enclosure_of(least_decay - term.decay));
    if (term.angle != 0) {
      const Enclosure angle = enclosure_of(term.angle);
      value *= term.is_sine ? sin(angle) : cos(angle);
    }
    sum += value;
  }
  return sum;
}

int ExponentialSum::sign() const {
  if (terms_.empty()) return 0;
  if (terms_.size() == 1 && terms_.front().angle == 0) return terms_.front().factor > 0 ? 1 : -1;
  const Rational least_decay =
      std::min_element(terms_.begin(), terms_.end(), [](const Term& a, const Term& b) { return a.decay < b.decay; })->decay;
  for (unsigned bits = 256;; bits *= 2) {
    set_precision(bits);
    const Enclosure sum = enclosure(least_decay);
    if (lower(sum) > 0) return 1;
    if (upper(sum) < 0) return -1;
  }
}

}  // namespace forceshade::reference
