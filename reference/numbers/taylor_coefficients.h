// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Taylor coefficients of a function of one variable, in balls: those at a point, or a ball around those at every point of a
// stretch. A map's own formulas, evaluated on this number, give its derivatives and, with the remainder's coefficient taken
// over the stretch, integrals with proof.

#include <array>

#include "reference/numbers/ball64.h"

namespace forceshade::reference {

inline bool is_finite(const Ball64& x) {
  return std::isfinite(x.mid()) && std::isfinite(x.rad());
}

// The ball around [low, high]. Throws Undecided unless both are finite and in order.
Ball64 ball(long double low, long double high);

// Rounded once, by MPFR, at the middle; around that, a bound of what the radius adds. A sine is beyond 1 by no more than 2^-8,
// however wide the ball. exp throws Undecided for what is not finite.
Ball64 exp(const Ball64& x);
std::array<Ball64, 2> sine_and_cosine(const Ball64& x);

// [k] is the k-th derivative over k!, up to kOrder.
template <std::size_t kOrder>
class Series {
 public:
  static constexpr std::size_t kLength = kOrder + 1;

  Series(double constant = 0) : Series(Ball64(constant)) {}
  explicit Series(const Ball64& constant) { c_[0] = constant; }

  // at + rate·(t - t0).
  static Series variable(const Ball64& at, const Ball64& rate) {
    Series s(at);
    s.c_[1] = rate;
    return s;
  }

  const Ball64& operator[](std::size_t k) const { return c_[k]; }

  // The index from which on all coefficients are zero.
  std::size_t length() const {
    std::size_t length = kLength;
    while (length > 0 && is_zero(c_[length - 1])) --length;
    return length;
  }

  Series<kOrder - 1> derivative() const {
    Series<kOrder - 1> d;
    for (std::size_t k = 0; k < kOrder; ++k) d.c_[k] = number(k + 1) * c_[k + 1];
    return d;
  }
  Series<kOrder - 1> shorter() const {
    Series<kOrder - 1> s;
    for (std::size_t k = 0; k < kOrder; ++k) s.c_[k] = c_[k];
    return s;
  }

  friend Series operator-(const Series& a) {
    Series s;
    for (std::size_t k = 0; k <= kOrder; ++k) s.c_[k] = -a.c_[k];
    return s;
  }
  friend Series operator+(const Series& a, const Series& b) {
    Series s;
    for (std::size_t k = 0; k <= kOrder; ++k) s.c_[k] = is_zero(b.c_[k]) ? a.c_[k] : a.c_[k] + b.c_[k];
    return s;
  }
  friend Series operator-(const Series& a, const Series& b) { return a + (-b); }
  friend Series operator*(const Series& a, const Series& b) {
    Series s;
    for (std::size_t i = 0; i <= kOrder; ++i) {
      if (is_zero(a.c_[i])) continue;
      for (std::size_t k = 0; i + k <= kOrder; ++k)
        if (!is_zero(b.c_[k])) s.c_[i + k] = s.c_[i + k] + a.c_[i] * b.c_[k];
    }
    return s;
  }

  friend Series square(const Series& a) {
    Series s;
    for (std::size_t k = 0; k <= kOrder; ++k) {
      for (std::size_t i = 0; 2 * i < k; ++i)
        if (!is_zero(a.c_[i]) && !is_zero(a.c_[k - i])) s.c_[k] = s.c_[k] + a.c_[i] * a.c_[k - i];
      if (!is_zero(s.c_[k])) s.c_[k] = Ball64(2.0) * s.c_[k];
      if (k % 2 == 0 && !is_zero(a.c_[k / 2])) s.c_[k] = s.c_[k] + square(a.c_[k / 2]);
    }
    return s;
  }

  friend Series operator*(const Ball64& a, const Series& b) {
    Series s;
    for (std::size_t k = 0; k <= kOrder; ++k)
      if (!is_zero(b.c_[k])) s.c_[k] = a * b.c_[k];
    return s;
  }

  // The recurrence follows from q·b = a.
  friend Series operator/(const Series& a, const Series& b) {
    Series q;
    const Ball64 inverse = Ball64(1.0) / b.c_[0];
    for (std::size_t k = 0; k <= kOrder; ++k) {
      Ball64 left = a.c_[k];
      for (std::size_t i = 1; i <= k; ++i)
        if (!is_zero(b.c_[i])) left = left - b.c_[i] * q.c_[k - i];
      if (!is_zero(left)) q.c_[k] = inverse * left;
    }
    return q;
  }

  // The recurrence follows from r·r = a.
  friend Series sqrt(const Series& a) {
    Series r(sqrt(a.c_[0]));
    const Ball64 inverse = Ball64(0.5) / r.c_[0];
    for (std::size_t k = 1; k <= kOrder; ++k) {
      Ball64 left = a.c_[k];
      for (std::size_t i = 1; i < k; ++i) left = left - r.c_[i] * r.c_[k - i];
      if (!is_zero(left)) r.c_[k] = inverse * left;
    }
    return r;
  }

  // The recurrence follows from e' = a'·e.
  friend Series exp(const Series& a) {
    Series e(exp(a.c_[0]));
    for (std::size_t k = 1; k <= kOrder; ++k) e.c_[k] = a.chained(e, k);
    return e;
  }

  // The recurrences follow from s' = a'·c and c' = -a'·s.
  friend std::array<Series, 2> sine_and_cosine(const Series& a) {
    const auto [sine, cosine] = sine_and_cosine(a.c_[0]);
    Series s(sine), c(cosine);
    for (std::size_t k = 1; k <= kOrder; ++k) {
      s.c_[k] = a.chained(c, k);
      c.c_[k] = -a.chained(s, k);
    }
    return {s, c};
  }

 private:
  template <std::size_t>
  friend class Series;

  static Ball64 number(std::size_t k) { return Ball64(static_cast<double>(k)); }
  static bool is_zero(const Ball64& a) { return a.mid() == 0 && a.rad() == 0; }

  // Coefficient k of the integral of this one's derivative times f.
  Ball64 chained(const Series& f, std::size_t k) const {
    Ball64 sum;
    for (std::size_t i = 1; i <= k; ++i)
      if (!is_zero(c_[i])) sum = sum + number(i) * c_[i] * f.c_[k - i];
    return sum / number(k);
  }

  std::array<Ball64, kOrder + 1> c_{};
};

}  // namespace forceshade::reference
