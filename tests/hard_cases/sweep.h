// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All stiffnesses at once. Every force is K times a number c that does not depend on K, and K has 2^23 significands: which of
// them bring K·c within a given distance of a tie, and on a given side of it, is a question about the multiples of c modulo
// one, answered by next_in_range().

#include "candidate.h"
#include "fast/evaluate.h"
#include "next_in_range.h"

namespace forceshade::tests {

// Calls f(K) for at most `most` K with |K·c| in [tie + low, tie + low + width] for some tie; low and width in units in the
// last place of the result. K in [1/2, 1): other binades differ by a power of two only.
template <class F>
void for_stiffnesses_near_ties(const DoubleDouble& c, double low, double width, int most, const F& f) {
  const int exponent = std::ilogb(c.hi);
  const double sign = std::copysign(1.0, c.hi);
  const double hi = sign * std::ldexp(c.hi, -exponent), lo = sign * std::ldexp(c.lo, -exponent);  // hi in [1, 2)
  if (hi == 1 && lo < 0) return;
  const auto fixed = [](double value, int places) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::ldexp(value, places)));
  };
  const auto window = fixed(width, 62);
  const std::uint64_t from = (kOne / 2 + fixed(low, 62)) % kOne;
  // Products below 2^24 have the unit 1; the others 2.
  const auto turn = static_cast<std::uint64_t>(std::ceil(0x1p24 / hi));
  const std::array<std::uint64_t, 3> ends{1U << 23, turn, 1U << 24};
  const std::array<std::uint64_t, 2> steps{fixed(hi - 1, 62) + fixed(lo, 62), fixed(hi, 61) + fixed(lo, 61)};
  for (std::size_t part = 0; part < 2; ++part) {
    std::uint64_t m = ends[part];
    for (int i = 0; i < most; ++i, ++m) {
      m = next_in_range(m, steps[part] % kOne, from, window);
      if (m >= ends[part + 1]) break;
      f(std::ldexp(static_cast<float>(m), -24));
    }
  }
}

// One position of one bump, all stiffnesses: offers to `hardest` what comes of it.
template <class Definition>
class Sweep {
  using Geometry = typename Definition::template Geometry<DoubleDouble>;

 public:
  Sweep(Hardest& hardest, const Parameters& p, const Geometry& geometry)
      : hardest_(hardest), p_{p.radius, p.width, 1}, geometry_(geometry), law_(p_, geometry) {}

  // Returns the larger relative error of binary64's two components at K = 1; 0 where it doubts itself.
  double at(float x, float z, bool may_tie) {
    x = fast::quantised(x);
    z = fast::quantised(z);
    if (!fast::in_domain(x) || !fast::in_domain(z)) return 0;
    const auto outcome = law_.template exact<DoubleDouble>(
        p_, [this]() -> const Geometry& { return geometry_; }, x, z);
    if (outcome.contact != fast::Sign::positive) return 0;
    const auto first = law_.first_stage(static_cast<double>(x), static_cast<double>(z));
    const double size = std::hypot(outcome.x.hi, outcome.z.hi);
    const std::string facet = facet_of(x, z);
    component("Fx " + facet, x, z, outcome.x, first.x, first.doubt, size, may_tie);
    component("Fz " + facet, x, z, outcome.z, first.z, first.doubt, size, may_tie);
    return first.doubt ? 0 : std::max(error_of(first.x, outcome.x), error_of(first.z, outcome.z));
  }

 private:
  static double error_of(double first, const DoubleDouble& c) {
    return c.hi == 0 ? 0 : std::fabs(((first - c.hi) - c.lo) / c.hi);
  }

  Parameters with(float K) const { return {p_.radius, p_.width, K}; }

  std::string facet_of(float x, float z) const {
    const float ax = std::fabs(x);
    if constexpr (requires { law_.axis; }) {
      return static_cast<double>(z) > law_.axis ? "above the axis" : "at or below the axis";
    } else if constexpr (requires { law_.half_width; }) {
      if (static_cast<double>(ax) > law_.half_width) return "beside the bump";
      if constexpr (requires { law_.half_top; })
        if (ax <= law_.half_top) return "on the top";
      return "on the bump";
    }
    return "on the plane";
  }

  // One component, of size c where K = 1; `first` is binary64's.
  void component(const std::string& where, float x, float z, const DoubleDouble& c, double first, bool doubt, double size,
                 bool may_tie) {
    if (c.hi == 0 || !(c.error < 0x1p-60 * std::fabs(c.hi))) return;
    if (c.error < 0x1p-80 * std::fabs(c.hi)) nearest_to_tie(where, x, z, c, doubt, may_tie);

    // Tries stiffnesses just on the side of a tie from which binary64's error leads across.
    const double error = ((first - c.hi) - c.lo) / c.hi;
    if (error == 0) return;
    if (!doubt && std::fabs(error) * 0x1p53 < 0.6 * hardest_.bar(where + kAcross)) return;
    const std::string blind = where + ": binary64 rightly doubts itself";
    const double share = doubt ? share_of_doubt(law_, x, z, size) : 0;
    if (doubt && share <= hardest_.bar(blind)) return;
    const double width = std::min(0x1p-8, std::fabs(error) * 0x1.4p24);
    for_stiffnesses_near_ties(c, error > 0 ? -width : 0, width, doubt ? 2 : 8, [&](float K) {
      const double window = measure(where, with(K), x, z, doubt);
      if (doubt && window > fast::doubt_window(Definition::kErrorBound)) hardest_.offer(blind, {with(K), x, z, share});
    });
  }

  // As near as no candidate before, and ties. 2^-37 is what the fixed point of next_in_range() can distinguish.
  void nearest_to_tie(const std::string& where, float x, float z, const DoubleDouble& c, bool doubt, bool may_tie) {
    const double bar = hardest_.bar(where + kNearest);
    const double reach = bar > 0 ? std::max(0x1p-36, std::ldexp(1.0, static_cast<int>(std::ceil(24 - bar)))) : 0x1p-20;
    for_stiffnesses_near_ties(c, -reach, 2 * reach, may_tie ? 8 : 2, [&](float K) {
      const DoubleDouble value = DoubleDouble::exactly(static_cast<double>(K)) * c;
      if (holds_its_tie(value))
        measure(where, with(K), x, z, doubt);
      else
        hardest_.offer(where + kNearest, {with(K), x, z, -std::log2(presumed(value).from_tie)});
    });
  }

  // Offers what the first two stages make of a candidate; the doubt window that binary64 needs.
  double measure(const std::string& where, const Parameters& p, float x, float z, bool doubt) {
    const fast::Built<Definition> law(p);
    const bool is_x = where[1] == 'x';
    const auto pick = [&](const auto& outcome) { return is_x ? outcome.x : outcome.z; };
    const double first = pick(law.definition.first_stage(static_cast<double>(x), static_cast<double>(z)));
    const DoubleDouble second = pick(law.definition.template exact<DoubleDouble>(p, law.kept_geometry(), x, z));
    Truth known = presumed(second);
    const std::string across = where.substr(0, 2) + ": double-double lands across ";
    const auto score = [&] { return doubt ? 0.5 : std::max(0.5, needed_window(first, known.right)); };
    const auto share = [&] { return needed_error(second, known.right); };
    if (holds_its_tie(second) && (score() > hardest_.bar(where + kTie) || share() > hardest_.bar(across + "the tie"))) {
      using BigFloatBall = fast::BigFloatBall<Definition::kWideLimbs>;
      known = truth(pick(law.definition.template exact<BigFloatBall>(p, fast::wide_geometry<Definition>(p), x, z)));
      if (known.from_tie > 0) hardest_.offer(where + kNearest, {p, x, z, -std::log2(known.from_tie)});
      if (share() > 0) hardest_.offer(across + (known.from_tie > 0 ? "a tie it is not on" : "the tie"), {p, x, z, share()});
    }
    const double window = needed_window(first, known.right);
    if (known.from_tie == 0)
      hardest_.offer(where + kTie, {p, x, z, score()});
    else if (!doubt && window > 0)
      hardest_.offer(where + kAcross, {p, x, z, window});
    return window;
  }

  static constexpr const char* kNearest = ": nearest to a tie";
  static constexpr const char* kTie = ": a tie";
  static constexpr const char* kAcross = ": binary64 lands across the tie";

  Hardest& hardest_;
  Parameters p_;
  Geometry geometry_;
  Definition law_;
};

}  // namespace forceshade::tests
