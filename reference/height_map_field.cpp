// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>

#include "forceshade/reference.h"
#include "reference/estimates.h"
#include "reference/heights/domain.h"
#include "reference/heights/sum.h"
#include "reference/numbers/decimal.h"
#include "reference/numbers/interval_ends.h"
#include "reference/numbers/tie.h"
#include "reference/position.h"
#include "rendering/control_words.h"

namespace forceshade::reference {
namespace {

using height::Mode;

// The gap and the slopes that the force at a position is made of.
template <class N>
struct LocalHeight {
  N gap;     // mm: the penetration
  N Ux, Uy;  // mm/mm
};

template <class N>
LocalHeight<N> local(const HeightMapField& law, const Point2& at, double z) {
  const Jet<N> map = sum_jet<N>(law.map().parts, at);
  const bool is_shaded = law.mode() == Mode::force_shaded;
  return {is_shaded ? N(sum_jet<N>(law.map().surface, at).U - N(z)) : N(map.U - N(z)), map.Ux, map.Uy};
}

// N, where the gap is positive.
template <class N>
using Components = std::array<N, 3>;

template <class N>
Components<N> force(const HeightMapField& law, const LocalHeight<N>& at) {
  N magnitude = N(static_cast<double>(law.stiffness())) * at.gap;
  if (law.mode() != Mode::conservative) magnitude = magnitude / sqrt(N(at.Ux * at.Ux + at.Uy * at.Uy + N(1.0)));
  return {-magnitude * at.Ux, -magnitude * at.Uy, magnitude};
}

// The sign of a component of the force less `tie`, exactly. With F = K·gap·s/n and n = √(1 + U_x² + U_y²), F and tie are
// compared by their signs first, then by their squares.
int sign_of_excess(const HeightMapField& law, const LocalHeight<ExponentialSum>& at, std::size_t axis,
                   const ExponentialSum& tie) {
  const ExponentialSum slopes[] = {-at.Ux, -at.Uy, 1.0};
  const ExponentialSum push = ExponentialSum(static_cast<double>(law.stiffness())) * at.gap * slopes[axis];
  if (law.mode() == Mode::conservative) return (push - tie).sign();
  const int sign = push.sign(), sign_of_tie = tie.sign();
  if (sign != sign_of_tie || sign == 0) return sign - sign_of_tie;
  return sign * (push * push - tie * tie * (at.Ux * at.Ux + at.Uy * at.Uy + 1.0)).sign();
}

float nearest_tie(const Components<Ball64>& force, const Eigen::Vector3f& rounded) {
  float ulps = 1;
  for (int i = 0; i < 3; ++i) ulps = std::min(ulps, ulps_from_tie(force[static_cast<std::size_t>(i)], rounded[i]));
  return ulps;
}

// Enclosures narrow the force down to two neighbours at most; exact numbers then compare it with the middle of the two.
Rounded round_exactly(const HeightMapField& law, const Point2& at, double z) {
  const LocalHeight<ExponentialSum> exact = local<ExponentialSum>(law, at, z);
  if (exact.gap.sign() <= 0) return {{0, 0, 0}, Status::free, Method::exact, 1};
  for (unsigned bits = 768;; bits *= 2) {
    set_precision(bits);
    const Components<Enclosure> enclosed = force(law, local<Enclosure>(law, at, z));
    const std::array<RoundedEnds, 3> ends{RoundedEnds(enclosed[0]), RoundedEnds(enclosed[1]), RoundedEnds(enclosed[2])};
    if (!std::ranges::all_of(ends, &RoundedEnds::are_neighbours)) continue;
    Eigen::Vector3f answer;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      answer[static_cast<int>(axis)] = ends[axis].decided([&](double tie) { return sign_of_excess(law, exact, axis, tie); });
    }
    return {answer, Status::contact, Method::exact, 0};
  }
}

Rounded round_by_enclosures(const HeightMapField& law, const Point2& at, double z) {
  mpfr_set_emin(mpfr_get_emin_min());  // the tail of a Gaussian goes down to exp(-4·10^14)
  for (const unsigned bits : {128U, 768U}) {
    set_precision(bits);
    const LocalHeight<Enclosure> enclosed = local<Enclosure>(law, at, z);
    if (upper(enclosed.gap) <= 0) return {{0, 0, 0}, Status::free, Method::enclosure};
    if (lower(enclosed.gap) <= 0) continue;
    const Components<Enclosure> components = force(law, enclosed);
    const std::array<RoundedEnds, 3> ends{RoundedEnds(components[0]), RoundedEnds(components[1]), RoundedEnds(components[2])};
    if (!std::ranges::all_of(ends, &RoundedEnds::agree)) continue;
    const Eigen::Vector3f answer(ends[0].low, ends[1].low, ends[2].low);
    return {answer, Status::contact, Method::enclosure,
            nearest_tie({to_64_bits(components[0]), to_64_bits(components[1]), to_64_bits(components[2])}, answer)};
  }
  return round_exactly(law, at, z);
}

// True if the hand is inside the surface.
bool is_inside(const HeightMapField& law, const Point2& at, double z) {
  for (const unsigned bits : {128U, 768U}) {
    set_precision(bits);
    const Enclosure gap = local<Enclosure>(law, at, z).gap;
    if (lower(gap) > 0 || upper(gap) <= 0) return lower(gap) > 0;
  }
  return local<ExponentialSum>(law, at, z).gap.sign() > 0;
}

constexpr double kLeastSlope = 0x1p-30;

// The slope of the middle of two neighbours, or of both ends, where they agree.
float without_tiny(float slope) {
  return std::fabs(static_cast<double>(slope)) < kLeastSlope ? 0.0F : slope;
}

float rounded_slope(const HeightMapField& law, const Point2& at, std::size_t axis) {
  const auto slope_of = [&]<class N>(const Jet<N>& jet) -> const N& { return axis == 0 ? jet.Ux : jet.Uy; };
  mpfr_set_emin(mpfr_get_emin_min());
  for (unsigned bits = 128;; bits *= 2) {
    set_precision(bits);
    const Jet<Enclosure> jet = sum_jet<Enclosure>(law.map().parts, at);
    const Enclosure& slope = slope_of(jet);
    if (lower(slope) > -kLeastSlope / 2 && upper(slope) < kLeastSlope / 2) return 0;
    const RoundedEnds ends(slope);
    if (ends.agree()) return without_tiny(ends.low);
    // From here on only a tie is left.
    if (bits < 768 || !ends.are_neighbours()) continue;
    return without_tiny(
        ends.decided([&](double tie) { return (slope_of(sum_jet<ExponentialSum>(law.map().parts, at)) - tie).sign(); }));
  }
}

bool is_transcendental(const HeightMap& map) {
  const auto is = [](const height::Part& part) {
    return std::visit([]<class T>(const T&) { return kFormula<T> == Formula::transcendental; }, part.shape);
  };
  return std::ranges::any_of(map.parts, is) || std::ranges::any_of(map.surface, is);
}

}  // namespace

std::variant<HeightMapField, ParameterError> HeightMapField::build(HeightMap map, Mode mode, float stiffness) {
  const ExactArithmetic with_all_bits;
  if (const auto error = first_error(map, mode, stiffness)) return *error;
  return HeightMapField(std::move(map), mode, stiffness);
}

Rounded HeightMapField::round_to_binary32(const Eigen::Vector3f& position) const {
  const ExactArithmetic with_all_bits;
  if (!in_domain(position)) return {{0, 0, 0}, Status::invalid};
  const Point2 at{quantised(position.x()), quantised(position.y())};
  const double z = quantised(position.z());
  // Even where the force is a Ball64's, CORE's rationals decide which cell it comes from.
  const std::lock_guard lock(exact_arithmetic);
  if (is_transcendental(map_)) return round_by_enclosures(*this, at, z);
  try {
    const LocalHeight<Ball64> quick = local<Ball64>(*this, at, z);
    if (!(quick.gap > Ball64(0.0))) return {};
    const Components<Ball64> components = force(*this, quick);
    const Eigen::Vector3f rounded(components[0].round(), components[1].round(), components[2].round());
    return {rounded, Status::contact, Method::filter, nearest_tie(components, rounded)};
  } catch (const Undecided&) {
    return round_by_enclosures(*this, at, z);
  }
}

DecimalMapForce HeightMapField::decimal(const Eigen::Vector3f& position, unsigned digits) const {
  const ExactArithmetic with_all_bits;
  if (!in_domain(position)) return {"0", "0", "0", Status::invalid};
  const Point2 at{quantised(position.x()), quantised(position.y())};
  const double z = quantised(position.z());
  const std::lock_guard lock(exact_arithmetic);
  mpfr_set_emin(mpfr_get_emin_min());
  if (!is_inside(*this, at, z)) return {"0", "0", "0", Status::free};
  std::optional<LocalHeight<ExponentialSum>> exact;  // made where it is needed: sums of exponentials are slow
  const auto component = [&](std::size_t axis) {
    return correctly_rounded(
        digits, [&] { return force(*this, local<Enclosure>(*this, at, z))[axis]; },
        [&](const CORE::BigRat& q) {
          if (!exact) exact = local<ExponentialSum>(*this, at, z);
          return sign_of_excess(*this, *exact, axis, ExponentialSum(ExponentialSum::Rational(q.get_mp())));
        });
  };
  return {component(0), component(1), component(2), Status::contact};
}

int HeightMapField::compare(const Eigen::Vector3f& position, std::size_t axis, const std::string& rational) const {
  const ExactArithmetic with_all_bits;
  const ExponentialSum other{ExponentialSum::Rational(rational)};
  if (!in_domain(position)) return -other.sign();
  const std::lock_guard lock(exact_arithmetic);
  mpfr_set_emin(mpfr_get_emin_min());
  const auto exact = local<ExponentialSum>(*this, {quantised(position.x()), quantised(position.y())}, quantised(position.z()));
  return exact.gap.sign() > 0 ? sign_of_excess(*this, exact, axis, other) : -other.sign();
}

std::array<float, 2> HeightMapField::slopes(float x, float y) const {
  const ExactArithmetic with_all_bits;
  const Point2 at{quantised(x), quantised(y)};
  const std::lock_guard lock(exact_arithmetic);
  if (!is_transcendental(map_)) try {
      const Jet<Ball64> quick = sum_jet<Ball64>(map_.parts, at);
      const auto rounded = [](const Ball64& slope) {
        if (slope.low() > -kLeastSlope / 2 && slope.high() < kLeastSlope / 2) return 0.0F;
        return without_tiny(slope.round());
      };
      return {rounded(quick.Ux), rounded(quick.Uy)};
    } catch (const Undecided&) {
    }
  return {rounded_slope(*this, at, 0), rounded_slope(*this, at, 1)};
}

HeightMapField::Estimate HeightMapField::estimate(const Eigen::Vector3f& position) const {
  const ExactArithmetic with_all_bits;
  const Point2 at{quantised(position.x()), quantised(position.y())};
  const double z = quantised(position.z());
  const std::lock_guard lock(exact_arithmetic);
  if (!is_transcendental(map_)) try {
      const LocalHeight<Ball64> quick = local<Ball64>(*this, at, z);
      if (quick.gap.rad() <= 0x1p-30L * std::fabs(quick.gap.mid())) {
        const Components<Ball64> F = force(*this, quick);
        return {quick.gap, quick.Ux, quick.Uy, F[0], F[1], F[2]};
      }
    } catch (const Undecided&) {
    }
  mpfr_set_emin(mpfr_get_emin_min());
  set_precision(768);  // parts may cancel
  const LocalHeight<Enclosure> slow = local<Enclosure>(*this, at, z);
  const Components<Enclosure> F = force(*this, slow);
  return {to_64_bits(slow.gap), to_64_bits(slow.Ux), to_64_bits(slow.Uy), to_64_bits(F[0]), to_64_bits(F[1]), to_64_bits(F[2])};
}

}  // namespace forceshade::reference
