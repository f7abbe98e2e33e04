// SPDX-License-Identifier: BSD-3-Clause
#include "reference/profile.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>

#include "reference/enclosed_angle.h"
#include "reference/energy/slope_and_curvature.h"
#include "reference/heights/sum.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

constexpr unsigned kBits = 192;
constexpr std::size_t kMostPieces = 20'000;

Enclosure between(double low, double high) {
  return {Multiprecision(low), Multiprecision(high)};
}

// A stretch of the section, without kinks.
struct Piece {
  double from, to;    // mm
  Enclosure turning;  // radians
  bool is_one_way;    // the normal turns in one direction only, and `turning` is that of its ends
};

Enclosure angle(const std::vector<height::Part>& parts, double x, double inside) {
  return atan(slope_and_curvature(parts, Enclosure(x), inside).slope);
}

Piece piece(const std::vector<height::Part>& parts, double from, double to) {
  const double inside = 0.5 * (from + to);
  const Enclosure change = abs(Enclosure(angle(parts, to, inside) - angle(parts, from, inside)));
  const Enclosure curvature = slope_and_curvature(parts, between(from, to), inside).curvature;
  if (lower(curvature) >= 0 || upper(curvature) <= 0) return {from, to, change, true};
  // The angle changes no faster than the slope.
  const Multiprecision most = upper(Enclosure(abs(curvature) * (Enclosure(to) - Enclosure(from))));
  return {from, to, {lower(change), std::max(Multiprecision(upper(change)), most)}, false};
}

}  // namespace

struct Profile::Pieces {
  std::vector<height::Part> parts;
  std::vector<Piece> all;  // by x
  Enclosure turning;       // degrees

  Pieces(const std::vector<height::Part>& of, float from, float to) : parts(of) {
    set_precision(kBits);
    std::vector<double> ends{static_cast<double>(from), static_cast<double>(to)};
    for (const height::Part& part : parts) {
      if (const auto kink = kink_between(part, ends[0], ends[1]))
        throw std::invalid_argument("the section has a kink between its ends: " + std::string(*kink));
      add_grid_lines(part, ends[0], ends[1], kMostPieces, ends);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) all.push_back(piece(parts, ends[i - 1], ends[i]));
    while (halve()) {
    }
    Enclosure sum(0);
    for (const Piece& one : all) sum += one.turning;
    turning = in_degrees(sum);
  }

  // Halves what turns both ways, as long as that could matter: around an inflexion what is not known shrinks by 4 each time.
  bool halve() {
    const auto matters = [](const Piece& one) {
      const double middle = 0.5 * (one.from + one.to);
      return !one.is_one_way && upper(one.turning) - lower(one.turning) > 0x1p-85 && one.from < middle && middle < one.to;
    };
    if (all.size() + static_cast<std::size_t>(std::ranges::count_if(all, matters)) > kMostPieces)
      throw std::invalid_argument("the section turns to and fro too often");
    std::vector<Piece> halves;
    for (const Piece& one : all) {
      if (matters(one)) {
        const double middle = 0.5 * (one.from + one.to);
        halves.push_back(piece(parts, one.from, middle));
        halves.push_back(piece(parts, middle, one.to));
      } else {
        halves.push_back(one);
      }
    }
    const bool changed = halves.size() > all.size();
    all = std::move(halves);
    return changed;
  }

  // The place in a piece behind `radians` of turning: by bisection where it is one-way; no other is wider than a hair.
  float within(const Piece& one, const Multiprecision& radians) const {
    const double inside = 0.5 * (one.from + one.to);
    const Enclosure start = angle(parts, one.from, inside);
    double low = one.from, high = one.to;
    while (one.is_one_way && static_cast<float>(low) != static_cast<float>(high)) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (median(abs(Enclosure(angle(parts, middle, inside) - start))) < radians ? low : high) = middle;
    }
    return static_cast<float>(high);
  }
};

Profile::Profile(const std::vector<height::Part>& parts, float from, float to) {
  if (!(from < to && in_domain(from) && in_domain(to)))
    throw std::invalid_argument("the section's ends are not one beyond the other, within 10000 mm");
  const std::lock_guard lock(exact_arithmetic);
  pieces_ = std::make_unique<const Pieces>(parts, from, to);
}

Profile::~Profile() = default;

double Profile::least_turning() const {
  const std::lock_guard lock(exact_arithmetic);
  return mpfr_get_d(Multiprecision(lower(pieces_->turning)).backend().data(), MPFR_RNDD);
}

double Profile::most_turning() const {
  const std::lock_guard lock(exact_arithmetic);
  return mpfr_get_d(Multiprecision(upper(pieces_->turning)).backend().data(), MPFR_RNDU);
}

Profile::Needed Profile::polygons_needed(const RationalAngle& theta_critical) const {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kBits);
  const Enclosure shares = pieces_->turning / enclosed_degrees(theta_critical);
  const Multiprecision low = floor(lower(shares)), high = floor(upper(shares));
  if (high >= 1e9) throw std::invalid_argument("the section needs a thousand million polygons or more");
  return {high.convert_to<unsigned>() + 1, low == high};
}

std::vector<height::Knot> Profile::knots(unsigned polygons) const {
  if (polygons > kMostPieces) throw std::invalid_argument("too many polygons to place their knots");
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kBits);
  Multiprecision all(0);
  for (const Piece& one : pieces_->all) all += median(one.turning);
  std::vector<height::Knot> knots;
  const auto add = [&](float at) {
    const Enclosure U = sum_jet<Enclosure>(pieces_->parts, {static_cast<double>(at), 0}).U;
    const auto rounded = median(U).convert_to<float>();
    knots.push_back({at, quantised(rounded)});
  };
  add(static_cast<float>(pieces_->all.front().from));
  Multiprecision behind(0);
  for (const Piece& one : pieces_->all) {
    const Multiprecision here = median(one.turning);
    while (knots.size() < polygons) {
      const Multiprecision share = all * static_cast<unsigned>(knots.size()) / polygons - behind;
      if (share > here) break;
      add(pieces_->within(one, share));
    }
    behind += here;
  }
  const auto end = static_cast<float>(pieces_->all.back().to);
  while (knots.size() < polygons) add(end);  // left over by a rounding of the last sum
  add(end);
  return knots;
}

}  // namespace forceshade::reference
