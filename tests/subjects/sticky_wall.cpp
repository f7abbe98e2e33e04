// SPDX-License-Identifier: BSD-3-Clause
#include "tests/subjects/sticky_wall.h"

#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "properties/binary32.h"
#include "properties/positions.h"
#include "properties/spread.h"

namespace forceshade::tests {
namespace {

using boost::multiprecision::cpp_bin_float_50;
using properties::Aim;
using properties::integers;
using properties::show;

class FastSession final : public fast::Session {
 public:
  explicit FastSession(const StickyWallParameters& p) : p_(p) {}

  fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
    const float z = position.z();
    if (!properties::is_valid(position)) {
      is_held_ = false;
      return {{0, 0, 0}, Status::invalid};
    }
    if (z < 0) is_held_ = true;
    if (z > p_.release) is_held_ = false;
    if (!is_held_) return {};
    return {{0, 0, -(p_.stiffness * z) + 0.0F}, Status::contact};  // + 0: no zero is negative
  }

 private:
  StickyWallParameters p_;
  bool is_held_ = false;
};

// The definition once more, in numbers of 50 digits, which hold every product of two binary32 numbers; their conversion rounds
// to nearest.
class ExactSession final : public properties::ReferenceSession {
 public:
  explicit ExactSession(const StickyWallParameters& p) : p_(p) {}

  reference::Rounded step(const Eigen::Vector3f& position) override {
    reference::Rounded answer;
    for (const float coordinate : position)
      if (!(std::fabs(coordinate) <= 1e4F)) {
        side_ = Side::free;
        answer.status = Status::invalid;
        return answer;
      }
    const cpp_bin_float_50 z = position.z();
    if (z < 0)
      side_ = Side::held;
    else if (z > cpp_bin_float_50(p_.release))
      side_ = Side::free;
    if (side_ == Side::free) return answer;
    answer.status = Status::contact;
    answer.force.z() = rounded(-(cpp_bin_float_50(p_.stiffness) * z));
    if (answer.force.z() == 0) answer.force.z() = 0;
    return answer;
  }

 private:
  enum class Side { free, held };

  // The nearer one of the two binary32 numbers around it; the even one where both are equally near. Below the normal range
  // Boost's own conversion rounds twice.
  static float rounded(const cpp_bin_float_50& exact) {
    float near = exact.convert_to<float>();
    for (const float other : {std::nextafter(near, -INFINITY), std::nextafter(near, INFINITY)}) {
      const cpp_bin_float_50 mine = abs(exact - near), its = abs(exact - other);
      if (its < mine || (its == mine && (std::bit_cast<std::uint32_t>(other) & 1U) == 0)) near = other;
    }
    return near;
  }

  StickyWallParameters p_;
  Side side_ = Side::free;
};

// Up and down through both heights, near them as often as not, and everything else a few times in a hundred.
class Walk final : public properties::Positions, private properties::Draws {
 public:
  Walk(const StickyWallParameters& p, std::uint64_t seed) : Draws(seed), p_(p) {}

  properties::Aimed next() override {
    const auto aim = static_cast<Aim>(bits() % properties::kAims);
    const float x = static_cast<float>(uniform(-20, 20)), y = static_cast<float>(uniform(-20, 20));
    return {aim == Aim::any_bits ? Eigen::Vector3f{any_float(), any_float(), any_float()} : Eigen::Vector3f{x, y, height(aim)},
            aim};
  }

 private:
  float height(Aim aim) {
    const float r = p_.release;
    switch (aim) {
      case Aim::surface: return static_cast<float>(small_step()) * 0x1p-149F;
      case Aim::facet_line:
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(r) + static_cast<std::uint32_t>(bits() % 5) - 2);
      case Aim::quantum: return tiny();
      case Aim::domain_end: return domain_end();
      case Aim::few_bits: return few_bits(4);
      case Aim::tie: return (bits() % 2 == 0 ? 1.0F : -1.0F) * any_binade();
      case Aim::axis: return 0;
      default: return static_cast<float>(uniform(-2, 2)) * r;
    }
  }

  StickyWallParameters p_;
};

// Free or held, and there.
struct Start {
  bool is_held;
  float z;
};

Start any_start(const StickyWallParameters& p, properties::Chooser& choose) {
  const auto part = static_cast<float>(choose(integers(-1000, 1000)));
  const bool is_held = choose(integers(0, 1)) == 1;
  return {is_held, part / 1000 * p.release * (is_held ? 1.0F : 2.0F)};
}

// At z on the side that was asked for, as far as there are two.
std::unique_ptr<fast::Session> opened_at(const StickyWall& wall, const Start& start) {
  auto session = wall.renderer().open();
  session->step({0, 0, start.is_held ? -1.0F : 9e3F});
  session->step({0, 0, start.z});
  return session;
}

double half_unit(float force) {
  return static_cast<double>(properties::half_spacing(force));
}

}  // namespace

std::unique_ptr<fast::Session> StickyWall::open_fast(const StickyWallParameters& p) {
  return std::make_unique<FastSession>(p);
}

StickyWall::StickyWall(const StickyWallParameters& p, Open open)
    : p_(p),
      open_(std::move(open)),
      rendering_{{"sticky wall", "sticky-wall", {{"release_mm", p.release}, {"stiffness_N_per_mm", p.stiffness}}},
                 {[p, its = open_] { return its(p); }}} {}

std::unique_ptr<properties::ReferenceSession> StickyWall::open_reference() const {
  return std::make_unique<ExactSession>(p_);
}

std::unique_ptr<properties::Positions> StickyWall::positions(std::uint64_t seed) const {
  return std::make_unique<Walk>(p_, seed);
}

std::vector<Eigen::Vector3f> StickyWall::draw_path(properties::Chooser& choose) const {
  using Path = std::vector<Eigen::Vector3f>;
  const auto draw = [this](std::uint64_t seed) {
    Walk walk(p_, seed);
    Path path(1 + seed % 29);
    for (Eigen::Vector3f& position : path) position = walk.next().position;
    return path;
  };
  return choose(properties::Generator<Path>{draw, [](const Path& path) { return properties::shorter(path, 1); }});
}

// From one binary32 to the next the force changes by K times the step, but for the release, where it falls from K·r to 0.
properties::Violation StickyWall::check_continuity(properties::Chooser& choose) const {
  const Start start = any_start(p_, choose);
  const float next = std::nextafter(start.z, choose(integers(0, 1)) == 0 ? INFINITY : -INFINITY);
  const auto session = opened_at(*this, start);
  const fast::Evaluation before = session->step({0, 0, start.z}), after = session->step({0, 0, next});
  const bool lets_go = before.status == Status::contact && after.status == Status::free;
  const double change = static_cast<double>(after.force.z()) - static_cast<double>(before.force.z());
  const double expected = lets_go
                              ? -static_cast<double>(before.force.z())
                              : -static_cast<double>(p_.stiffness) * (static_cast<double>(next) - static_cast<double>(start.z));
  const double allowed = half_unit(before.force.z()) + half_unit(after.force.z());
  const bool may_let_go = next > p_.release;
  // A free tip that comes to be held at z < 0 starts from zero force.
  const double reach =
      allowed + static_cast<double>(p_.stiffness) * std::fabs(static_cast<double>(next) - static_cast<double>(start.z));
  if ((!lets_go || may_let_go) && std::fabs(change - expected) <= reach) return std::nullopt;
  return "between z = " + show(start.z) + " and " + show(next) + " mm the force changes by " +
         show(static_cast<float>(change)) + " N";
}

properties::Violation StickyWall::check_unit_normals(properties::Chooser& choose) const {
  const Start start = any_start(p_, choose);
  const fast::Evaluation answer = opened_at(*this, start)->step({0, 0, start.z});
  const double length = static_cast<double>(p_.stiffness) * std::fabs(static_cast<double>(start.z));
  const double expected = answer.status == Status::contact ? length : 0;
  if (std::fabs(answer.force.cast<double>().norm() - expected) <= half_unit(answer.force.z())) return std::nullopt;
  return "at z = " + show(start.z) + " mm the force is as long as " + show(answer.force.norm()) + " N";
}

// Along any path that begins and ends free and at the same height, the hand gets nothing but rounding, for the trapezoid of a
// linear force is exact, and where the tip is caught or let go the force jumps to or from a side on which it acts against it.
properties::Violation StickyWall::check_passivity(properties::Chooser& choose) const {
  const int count = choose(integers(2, 29));
  const auto session = renderer().open();
  double energy = 0, rounding = 0;
  float before = 2 * p_.release, force = session->step({0, 0, before}).force.z();
  const auto go = [&](float z) {
    const float next = session->step({0, 0, z}).force.z();
    const double step = static_cast<double>(z) - static_cast<double>(before);
    energy += 0.5 * (static_cast<double>(force) + static_cast<double>(next)) * step;
    rounding += (half_unit(force) + half_unit(next) + 0x1p-50) * std::fabs(step);
    before = z;
    force = next;
  };
  // Steps end at the heights at which the force jumps, on both sides of each.
  const auto to = [&](float z) {
    const float r = p_.release, above = std::nextafter(r, INFINITY);
    if (before < 0 && z > 0) go(0);
    if (before <= r && z > r) {
      go(r);
      go(above);
    }
    if (before > r && z <= r) go(above);
    if (before > 0 && z < 0) go(0);
    go(z);
  };
  for (int i = 0; i < count; ++i) to(static_cast<float>(choose(integers(-2000, 2000))) / 1000 * p_.release);
  to(2 * p_.release);
  if (energy <= rounding) return std::nullopt;
  return "a closed path of " + std::to_string(count) + " corners gives " + std::to_string(energy) + " mJ";
}

std::vector<properties::LoopEnergy> StickyWall::energies(const Monitor&) const {
  return {{static_cast<double>(p_.release), {0, 0}, 0, 0}};
}

properties::DrawnSubject StickyWall::with_drawn_parameters(std::uint64_t seed) const {
  properties::ParameterSource source(seed);
  const StickyWallParameters drawn{source.next().stiffness, source.next().width};
  return {std::make_unique<StickyWall>(drawn, open_),
          "K = " + show(drawn.stiffness) + " N/mm, r = " + show(drawn.release) + " mm: "};
}

}  // namespace forceshade::tests
