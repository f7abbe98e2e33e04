// SPDX-License-Identifier: BSD-3-Clause
#include "reference/numbers/taylor_coefficients.h"

#include <mpfr.h>

#include <algorithm>

namespace forceshade::reference {
namespace {

constexpr long double kUnit = std::numeric_limits<long double>::epsilon();

// A number of as many bits as a long double.
class Correct {
 public:
  Correct() { mpfr_init2(value_, std::numeric_limits<long double>::digits); }
  explicit Correct(long double value) : Correct() { mpfr_set_ld(value_, value, MPFR_RNDN); }
  Correct(const Correct&) = delete;
  Correct& operator=(const Correct&) = delete;
  ~Correct() { mpfr_clear(value_); }

  operator mpfr_ptr() { return value_; }

  // Around what was rounded to it once, with room for a number too small for a long double.
  Ball64 around() const {
    const long double mid = mpfr_get_ld(value_, MPFR_RNDN);
    return {mid, std::fabs(mid) * kUnit + std::numeric_limits<long double>::min()};
  }

 private:
  mpfr_t value_;
};

Ball64 exp_of(long double x) {
  Correct value(x);
  mpfr_exp(value, value, MPFR_RNDN);
  return value.around();
}

// The part of [-1, 1] within `spread` of the value.
Ball64 of_a_wave(const Ball64& value, long double spread) {
  const Ball64 all = value + Ball64(0, spread);
  if (spread < 0x1p-8L) return all;
  return ball(std::max(-1.0L, all.low()), std::min(1.0L, all.high()));
}

}  // namespace

Ball64 ball(long double low, long double high) {
  if (!std::isfinite(low) || !std::isfinite(high) || !(low <= high)) throw Undecided{};
  const long double mid = low + (high - low) / 2;
  return Ball64(mid, std::max(high - mid, mid - low)) + Ball64(0, std::fabs(high - low) * 0x1p-60L);
}

Ball64 exp(const Ball64& x) {
  if (!is_finite(x)) throw Undecided{};
  // e^r - 1 <= r + r² for r <= 1.
  const long double r = x.rad();
  const Ball64 value = r <= 0x1p-8L ? exp_of(x.mid()) * (Ball64(1.0) + Ball64(0, (r + r * r) * (1 + 4 * kUnit)))
                                    : ball(exp_of(x.low()).low(), exp_of(x.high()).high());
  if (!is_finite(value)) throw Undecided{};
  return value;
}

std::array<Ball64, 2> sine_and_cosine(const Ball64& x) {
  if (!is_finite(x)) return {Ball64(0, 1), Ball64(0, 1)};
  Correct angle(x.mid()), s, c;
  mpfr_sin_cos(s, c, angle, MPFR_RNDN);
  const Ball64 sine = s.around(), cosine = c.around();
  // |sin(x + h) - sin(x)| <= |cos(x)||h| + |sin(x)|h²/2, and so for the cosine.
  const long double r = x.rad(), half = r * r / 2, slack = 1 + 8 * kUnit;
  const auto size = [](const Ball64& v) { return std::max(std::fabs(v.low()), std::fabs(v.high())); };
  return {of_a_wave(sine, std::min(2.0L, (size(cosine) * r + size(sine) * half) * slack)),
          of_a_wave(cosine, std::min(2.0L, (size(sine) * r + size(cosine) * half) * slack))};
}

}  // namespace forceshade::reference
