// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost.Geometry includes one that Boost itself calls deprecated

#include "properties/tick_changes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/geometry/algorithms/expand.hpp>
#include <boost/geometry/algorithms/make.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "properties/rest_regions.h"
#include "properties/tick_search.h"
#include "text/number_text.h"

namespace forceshade::properties {
namespace {

using Eigen::Vector3d;
namespace bg = boost::geometry;

constexpr std::size_t kMostWork = 1U << 29;  // in common points of three borders, some seconds
constexpr double kTicksPerSecond = 1000;
constexpr double kOfForce = 0x1p-23;    // radians, and a share: more than rounding its components changes a force by
constexpr double kRounding = 1e-9;      // of a length or angle, for the rounding of this arithmetic
constexpr std::size_t kRejection = 16;  // the work of finding that two regions are far apart
constexpr std::size_t kKept = 24;       // pairs of the largest changes, for the search

double radians_of_chord(double chord) {
  return chord < 2 ? 2 * std::asin(chord / 2) : std::numbers::pi;
}

double angle(const Vector3d& a, const Vector3d& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

// The pairs with the largest bounds of one kind.
class Suspects {
 public:
  explicit Suspects(double SuspectPair::*measure) : measure_(measure) {}

  void add(const SuspectPair& pair) {
    if (pairs_.size() >= kKept && !(pair.*measure_ > pairs_[kKept - 1].*measure_)) return;
    pairs_.push_back(pair);
    if (pairs_.size() >= 4 * kKept || pairs_.size() == kKept) order();
  }
  void move_to(std::vector<SuspectPair>& all) {
    order();
    std::ranges::move(pairs_, std::back_inserter(all));
  }

 private:
  void order() {
    std::ranges::stable_sort(pairs_, std::ranges::greater(), measure_);
    pairs_.resize(std::min(kKept, pairs_.size()));
  }

  double SuspectPair::*measure_;
  std::vector<SuspectPair> pairs_;
};

// The largest angle between sums of one and of the other: where all angles are below 90°, no sum is farther from a vector than
// the farthest of its terms.
double largest_angle(const std::vector<Vector3d>& some, const std::vector<Vector3d>& others) {
  if (some.empty() || others.empty()) return std::numbers::pi;
  double largest = 0;
  for (const Vector3d& a : some)
    for (const Vector3d& b : others) largest = std::max(largest, angle(a, b));
  const bool is_single = some.size() == 1 && others.size() == 1;
  return is_single || largest < std::numbers::pi / 2 - kRounding ? largest : std::numbers::pi;
}

class Pairs {
 public:
  Pairs(const MeshRendering& rendering, const HandStep& hand)
      : hand_(hand), is_shaded_(rendering.shading != mesh::Shading::none), regions_(rest_regions(rendering, hand.depth)) {
    std::vector<std::pair<Box, std::uint32_t>> boxes;
    for (std::uint32_t f = 0; f < regions_.faces.size(); ++f) boxes.emplace_back(around(regions_.faces[f].corners), f);
    faces_ = Tree(boxes);
    std::vector<Box> rim;
    for (const auto& ends : regions_.rim) rim.push_back(around(ends));
    rim_ = RimTree(rim);
    stamp_.resize(regions_.all.size());
  }

  // False where that takes too long.
  bool run(TickChanges& changes, const Monitor& monitor) {
    for (std::uint32_t i = 0; i < regions_.all.size(); ++i) {
      monitor.at(static_cast<double>(i) / static_cast<double>(regions_.all.size()));
      for (const std::uint32_t f : reached_from(i))
        for (const std::uint32_t j : regions_.faces[f].regions) {
          if (stamp_[j] == i + 1) continue;
          stamp_[j] = i + 1;
          work_ += kRejection;
          compare(regions_.all[i], regions_.all[j], changes);
        }
      if (work_ > kMostWork) return false;
    }
    return true;
  }

  std::vector<SuspectPair> suspects() {
    std::vector<SuspectPair> all;
    by_force_.move_to(all);
    by_turn_.move_to(all);
    return all;
  }

 private:
  using Point = bg::model::point<double, 3, bg::cs::cartesian>;
  using Box = bg::model::box<Point>;
  using Tree = bg::index::rtree<std::pair<Box, std::uint32_t>, bg::index::quadratic<16>>;
  using RimTree = bg::index::rtree<Box, bg::index::quadratic<16>>;

  static Point point(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
  template <std::size_t kCount>
  static Box around(const std::array<Vector3d, kCount>& points) {
    Box box = bg::make_inverse<Box>();
    for (const Vector3d& p : points) bg::expand(box, point(p));
    return box;
  }

  // The faces to which the god-object can go in the next tick: from the region's face, over edges and by flights, among those
  // that are at most depth + step from where the hand then is. A flight that lands on a face comes from in front of it, also
  // one that begins at the rim.
  std::vector<std::uint32_t> reached_from(std::uint32_t region) {
    const RestRegion& from = regions_.all[region];
    const Vector3d reach = Vector3d::Constant(hand_.depth + 2 * hand_.step);
    std::vector<std::pair<Box, std::uint32_t>> met;
    faces_.query(bg::index::intersects(Box(point(from.low - reach), point(from.high + reach))), std::back_inserter(met));
    std::vector<std::uint32_t> left, reached{regions_.face_of[region]};
    for (const auto& [box, f] : met)
      if (f != reached.front()) left.push_back(f);
    std::ranges::sort(left);
    if (regions_.has_two_sides) {
      const std::vector<std::uint32_t> other_sides = cut_off(met, left, reached.front());
      std::erase_if(left, [&](std::uint32_t f) { return std::ranges::binary_search(other_sides, f); });
    }
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const Face& at = regions_.faces[reached[next]];
      std::erase_if(left, [&](std::uint32_t f) {
        const bool is_reached = std::ranges::find(at.beside, f) != at.beside.end() || is_in_front(at, regions_.faces[f]);
        if (is_reached) reached.push_back(f);
        return is_reached;
      });
      work_ += left.size();
      if (work_ > kMostWork) break;
    }
    return reached;
  }

  // The other sides of the surface that is joined to `from` by faces of `near`, which are sorted and those of `met` beside
  // `from`, where no rim is in a box around all of these: a connected surface without a rim divides a box in two.
  std::vector<std::uint32_t> cut_off(const std::vector<std::pair<Box, std::uint32_t>>& met,
                                     const std::vector<std::uint32_t>& near, std::uint32_t from) const {
    Box all = bg::make_inverse<Box>();
    for (const auto& [box, f] : met) bg::expand(all, box);
    if (rim_.qbegin(bg::index::intersects(all)) != rim_.qend()) return {};
    std::vector<std::uint32_t> joined{from}, others;
    for (std::size_t next = 0; next < joined.size(); ++next)
      for (const std::uint32_t f : regions_.faces[joined[next]].beside)
        if (std::ranges::binary_search(near, f) && std::ranges::find(joined, f) == joined.end()) joined.push_back(f);
    for (const std::uint32_t f : joined) others.push_back(f ^ 1U);
    std::ranges::sort(others);
    return others;
  }

  // True if a corner of one is in front of the other's plane.
  static bool is_in_front(const Face& one, const Face& other) {
    return std::ranges::any_of(one.corners, [&](const Vector3d& corner) {
      const Vector3d off = corner - other.corners[0];
      return other.out.dot(off) > kRounding * off.norm();
    });
  }

  // True if all of one is more than a step outside of a border of the other.
  bool is_beyond(const RestRegion& one, const RestRegion& other) const {
    return std::ranges::any_of(other.borders, [&](const HalfSpace& border) {
      return std::ranges::all_of(one.corners, [&](const Vector3d& corner) {
        return border.direction.dot(corner) < border.least - hand_.step * (1 + kRounding);
      });
    });
  }

  // From a rest in a to one in b. If it is another region, the hand crosses an exit of a on its straight way. Let q be there:
  // then |D_a(p) - D_b(p')| is at most |D_a(q) - D_b(q)| and the way, a step; q is at most a step deeper than the depth of
  // the hand, or off b.
  void compare(const RestRegion& a, const RestRegion& b, TickChanges& changes) {
    if (((a.low - b.high).array() > hand_.step).any() || ((b.low - a.high).array() > hand_.step).any()) return;
    if (is_beyond(a, b) || is_beyond(b, a)) return;
    std::vector<HalfSpace> borders;
    for (const HalfSpace& border : a.borders)
      borders.push_back({border.direction, border.least - (border.is_exit ? 0 : hand_.step)});
    for (const HalfSpace& border : b.borders) borders.push_back({border.direction, border.least - hand_.step});
    if (&a == &b) return compare_within(borders, Vector3d::Zero(), a, b, changes);
    for (const HalfSpace& exit : a.borders) {
      if (!exit.is_exit) continue;
      const auto is_inside = [&](const Vector3d& p) { return exit.direction.dot(p) > exit.least + kRounding * hand_.depth; };
      if (std::ranges::all_of(b.corners, is_inside)) continue;
      borders.push_back({-exit.direction, -exit.least});
      compare_within(borders, exit.direction, a, b, changes);
      borders.pop_back();
    }
  }

  // borders: of the hand's positions q.
  void compare_within(const std::vector<HalfSpace>& borders, const Vector3d& inwards, const RestRegion& a, const RestRegion& b,
                      TickChanges& changes) {
    const std::size_t n = borders.size();
    work_ += n * n * n / 6;
    SuspectPair pair{.first = a.D, .second = b.D, .inwards = inwards};
    double change = 0, of_lengths = 0, largest_a = 0, largest_b = 0, of_normals = 0;
    const double size = (a.high - a.low).maxCoeff();
    for_each_corner(borders, (a.low + a.high) / 2, kRounding * size, [&](const Vector3d& p) {
      const Vector3d to_a = a.D(p), to_b = b.D(p);
      change = std::max(change, (to_a - to_b).norm());
      of_lengths = std::max(of_lengths, a.out && b.out ? std::fabs(a.out->dot(to_a) - b.out->dot(to_b)) : change);
      largest_a = std::max(largest_a, to_a.norm());
      largest_b = std::max(largest_b, to_b.norm());
      if (a.normal && b.normal) of_normals = std::max(of_normals, ((*a.normal)(p) - (*b.normal)(p)).norm());
      pair.corners.push_back(p);
    });
    if (pair.corners.empty()) return;
    pair.turn = largest_angle(a.directions, b.directions);
    if (a.normal && b.normal) {
      // |x/|x| - y/|y|| <= 2|x - y|/(|x| + |y|).
      const double apart = of_normals + std::max(a.normal->factor.norm(), b.normal->factor.norm()) * hand_.step;
      pair.turn = std::min(pair.turn, radians_of_chord(2 * apart / (a.least_normal + b.least_normal)));
    }
    pair.force = change + hand_.step;
    if (is_shaded_) {
      // The square of two forces' difference is (f - g)² + fg c², c the chord of the angle between them.
      const double chord = 2 * std::sin(pair.turn / 2);
      const double most = std::min(largest_a + hand_.step, hand_.depth) * std::min(largest_b + hand_.step, hand_.depth);
      pair.force = std::hypot(of_lengths + hand_.step, std::sqrt(most) * chord);
    }
    changes.force.bound = std::max(changes.force.bound, pair.force);
    changes.turn.bound = std::max(changes.turn.bound, pair.turn);
    by_force_.add(pair);
    by_turn_.add(pair);
  }

  HandStep hand_;
  bool is_shaded_;
  RestRegions regions_;
  Tree faces_;
  RimTree rim_;
  std::vector<std::uint32_t> stamp_;
  std::size_t work_ = 0;
  Suspects by_force_{&SuspectPair::force}, by_turn_{&SuspectPair::turn};
};

// No less than the value, in four digits.
std::string four_digits(double value) {
  if (!(value > 0)) return "0";
  const double unit = std::pow(10, std::floor(std::log10(value)) - 3);
  return digits(std::ceil(value / unit) * unit, 4);
}

}  // namespace

TickChanges tick_changes(const MeshRendering& rendering, const HandStep& hand, const Monitor& monitor) {
  TickChanges changes;
  std::vector<SuspectPair> suspects;
  if (rendering.checked.is_regular()) {
    Pairs pairs(rendering, hand);
    changes.is_own = pairs.run(changes, monitor.part(0, 0.8));
    suspects = pairs.suspects();
  }
  // The god-object never moves away from the hand, so that of any mesh.
  const double of_any = 2 * hand.depth + hand.step;
  changes.force.bound = changes.is_own ? std::min(of_any, changes.force.bound) : of_any;
  if (!changes.is_own) changes.turn.bound = std::numbers::pi;
  // Each of both forces may be off by what the grid of the state and the rounding of its components make.
  const double off = 2 * (kGridAngle + kOfForce);
  changes.force.bound = static_cast<double>(rendering.stiffness) * (changes.force.bound + off * hand.depth);
  changes.turn.bound = std::min(180.0, (changes.turn.bound + off) * 180 / std::numbers::pi);
  search_changes(rendering, hand, suspects, changes, monitor.part(0.8, 1));
  return changes;
}

std::string words_of(const TickChanges& changes, const HandStep& hand) {
  std::array<char, 512> text{};
  std::snprintf(
      text.data(), text.size(),
      "between two ticks in contact, no more than %g mm deep, the hand %g mm further (%g mm/s at %g ticks a second): at "
      "most %s N and %s degrees; found: %.4g N, %.4g degrees, and %u moves of one tick",
      hand.depth, hand.step, hand.step * kTicksPerSecond, kTicksPerSecond, four_digits(changes.force.bound).c_str(),
      four_digits(changes.turn.bound).c_str(), changes.force.found, changes.turn.found, changes.moves);
  return text.data();
}

}  // namespace forceshade::properties
