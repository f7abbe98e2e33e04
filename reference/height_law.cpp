// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/height_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "forceshade/reference/height_domain.h"
#include "forceshade/reference/height_sum.h"
#include "forceshade/reference/slow_geometry.h"
#include "forceshade/reference/tie.h"

namespace forceshade::reference {
namespace {

using height::Rendering;

template <class N>
struct HeightForce {
  N gap;      // mm: the penetration
  N Ux, Uy;   // mm/mm
  N x, y, z;  // N, where the gap is positive
};

template <class N>
HeightForce<N> force(const HeightLaw& law, const Point2& at, double z) {
  const Jet<N> map = sum_jet<N>(law.map().parts, at);
  const bool is_shaded = law.rendering() == Rendering::force_shaded;
  const N gap = is_shaded ? N(sum_jet<N>(law.map().surface, at).U - N(z)) : N(map.U - N(z));
  N magnitude = N(static_cast<double>(law.stiffness())) * gap;
  if (law.rendering() != Rendering::conservative) magnitude = magnitude / sqrt(N(map.Ux * map.Ux + map.Uy * map.Uy + N(1.0)));
  return {gap, map.Ux, map.Uy, -magnitude * map.Ux, -magnitude * map.Uy, magnitude};
}

// By exact comparison with the middle between two neighbours.
float nearest_binary32(const Exact& value) {
  if (value.sign() == 0) return 0;
  const auto near = static_cast<float>(CGAL::to_double(value));
  const bool is_below = (value - Exact(static_cast<double>(near))).sign() < 0;
  const float below = is_below ? std::nextafter(near, -HUGE_VALF) : near, above = std::nextafter(below, HUGE_VALF);
  const double tie = 0.5 * (static_cast<double>(below) + static_cast<double>(above));
  return rounded_between(below, above, (value - Exact(tie)).sign());
}

float nearest_tie(const std::array<Filter, 3>& force, const Eigen::Vector3f& rounded) {
  float ulps = 1;
  for (int i = 0; i < 3; ++i) ulps = std::min(ulps, ulps_from_tie(force[static_cast<std::size_t>(i)], rounded[i]));
  return ulps;
}

Rounded round_exactly(const HeightLaw& law, const Point2& at, double z) {
  const HeightForce<Exact> exact = force<Exact>(law, at, z);
  if (exact.gap.sign() <= 0) return {{0, 0, 0}, Status::free, Method::exact};
  return {{nearest_binary32(exact.x), nearest_binary32(exact.y), nearest_binary32(exact.z)}, Status::contact, Method::exact, 0};
}

// The binary32 both ends round to, or nothing.
std::optional<float> agreed_binary32(const Enclosure& value) {
  const float low = mpfr_get_flt(lower(value).backend().data(), MPFR_RNDN);
  const float high = mpfr_get_flt(upper(value).backend().data(), MPFR_RNDN);
  if (low != high) return std::nullopt;
  return low + 0.0F;
}

// What is rational added up before it is rounded: so a surface that z lies on, and whatever is 0 beside it, cancel.
Enclosure gap_of_few_roundings(const HeightLaw& law, const Point2& at, double z) {
  Rational rational(-z);
  Enclosure rest(0);
  for (const height::Part& part : law.rendering() == Rendering::force_shaded ? law.map().surface : law.map().parts) {
    const bool is_rational = std::visit([]<class T>(const T&) { return kIsRational<T>; }, part.shape);
    if (is_rational)
      rational = rational + part_jet<Rational>(part, at).U;
    else
      rest += part_jet<Enclosure>(part, at).U;
  }
  Enclosure gap;
  mpfi_set_q(gap.backend().data(), rational.get_mp());
  return gap + rest;
}

Rounded round_by_enclosures(const HeightLaw& law, const Point2& at, double z) {
  mpfr_set_emin(mpfr_get_emin_min());  // the tail of a Gaussian goes down to exp(-2·10^14)
  for (const unsigned bits : {128U, 768U, 3072U}) {
    set_precision(bits);
    const HeightForce<Enclosure> enclosed = force<Enclosure>(law, at, z);
    if (upper(enclosed.gap) <= 0) return {{0, 0, 0}, Status::free, Method::enclosure};
    if (lower(enclosed.gap) <= 0) continue;
    const auto x = agreed_binary32(enclosed.x), y = agreed_binary32(enclosed.y), fz = agreed_binary32(enclosed.z);
    if (x && y && fz)
      return {{*x, *y, *fz},
              Status::contact,
              Method::enclosure,
              nearest_tie({filter_of(enclosed.x), filter_of(enclosed.y), filter_of(enclosed.z)}, {*x, *y, *fz})};
  }
  if (upper(gap_of_few_roundings(law, at, z)) <= 0) return {{0, 0, 0}, Status::free, Method::exact};
  throw std::domain_error("height map: 3072 bits do not decide the force at (" + std::to_string(at.x) + ", " +
                          std::to_string(at.y) + ", " + std::to_string(z) + ") mm");
}

bool is_transcendental(const HeightMap& map) {
  const auto is = [](const height::Part& part) {
    return std::visit([]<class T>(const T&) { return kIsTranscendental<T>; }, part.shape);
  };
  return std::ranges::any_of(map.parts, is) || std::ranges::any_of(map.surface, is);
}

double quantised(float coordinate) {
  return std::fabs(coordinate) < std::ldexp(1.0F, -30) ? 0.0 : static_cast<double>(coordinate);
}

}  // namespace

std::variant<HeightLaw, ParameterError> HeightLaw::build(HeightMap map, Rendering rendering, float stiffness) {
  if (const auto error = first_error(map, rendering, stiffness)) return *error;
  return HeightLaw(std::move(map), rendering, stiffness);
}

Rounded HeightLaw::round_to_binary32(const Eigen::Vector3f& position) const {
  if (!((position.array() >= -1e4F).all() && (position.array() <= 1e4F).all())) return {{0, 0, 0}, Status::invalid};
  const Point2 at{quantised(position.x()), quantised(position.y())};
  const double z = quantised(position.z());
  // Even where the force is a Filter's, CORE's rationals decide which cell it comes from.
  const std::lock_guard lock(slow_numbers);
  if (is_transcendental(map_)) return round_by_enclosures(*this, at, z);
  try {
    const HeightForce<Filter> quick = force<Filter>(*this, at, z);
    if (!(quick.gap > Filter(0.0))) return {};
    const Eigen::Vector3f rounded(quick.x.round(), quick.y.round(), quick.z.round());
    return {rounded, Status::contact, Method::filter, nearest_tie({quick.x, quick.y, quick.z}, rounded)};
  } catch (const Undecided&) {
    return round_exactly(*this, at, z);
  }
}

HeightLaw::Estimate HeightLaw::estimate(const Eigen::Vector3f& position) const {
  const Point2 at{quantised(position.x()), quantised(position.y())};
  const double z = quantised(position.z());
  const std::lock_guard lock(slow_numbers);
  if (!is_transcendental(map_)) try {
      const HeightForce<Filter> quick = force<Filter>(*this, at, z);
      if (quick.gap.rad() <= 0x1p-30L * std::fabs(quick.gap.mid()))
        return {quick.gap, quick.Ux, quick.Uy, quick.x, quick.y, quick.z};
    } catch (const Undecided&) {
    }
  mpfr_set_emin(mpfr_get_emin_min());
  set_precision(768);  // parts may cancel
  const HeightForce<Enclosure> slow = force<Enclosure>(*this, at, z);
  return {filter_of(slow.gap), filter_of(slow.Ux), filter_of(slow.Uy), filter_of(slow.x), filter_of(slow.y), filter_of(slow.z)};
}

}  // namespace forceshade::reference
