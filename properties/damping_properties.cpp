// SPDX-License-Identifier: BSD-3-Clause
#include "properties/damping_properties.h"

#include <array>
#include <cmath>
#include <memory>

#include "forceshade/fast.h"
#include "properties/binary32.h"
#include "properties/split_mix.h"

namespace forceshade::properties {
namespace {

using Rational3 = std::array<mpq_class, 3>;

mpq_class rational(float a) {
  return static_cast<double>(a);
}
Rational3 rational(const Eigen::Vector3f& a) {
  return {rational(a.x()), rational(a.y()), rational(a.z())};
}
mpq_class product(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Rational3 difference(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
mpq_class rounding(const Rational3& force, const Rational3& a) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (abs(force[i]) * mpq_class(0x1p-24) + mpq_class(0x1p-150)) * abs(a[i]);
  return sum;
}

DampedPath drawn_path(std::uint64_t seed) {
  std::uint64_t count = 0;
  const auto random = [&] { return split_mix(seed, count++); };
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  const auto vector = [&](double size) {
    const auto one = [&] { return static_cast<float>(between(-size, size)); };
    const float x = one(), y = one(), z = one();
    return Eigen::Vector3f(x, y, z);
  };
  DampedPath path;
  damping::Parameters& p = path.parameters;
  p.rate = random() % 2 == 0 ? 1000 : 200;
  p.share = random() % 2 == 0 ? 1 : static_cast<float>(std::exp2(between(-4, 0)));
  p.damping = random() % 4 == 0 ? 0 : static_cast<float>(std::exp2(between(-12, -4)));
  p.drag = random() % 2 == 0 ? 0 : static_cast<float>(std::exp2(between(-12, -4)));
  if (p.is_off()) p.damping = 0x1p-9F;
  p.most = random() % 3 == 0 ? HUGE_VALF : static_cast<float>(between(1, 4));
  Eigen::Vector3f at(0, 0, 0), direction(0, 0, 1);
  const bool has_counts = random() % 2 == 0, has_limits = random() % 2 == 0;
  const auto limit = [&] { return random() % 3 == 0 ? 0 : static_cast<float>(std::exp2(between(-14, -2))); };
  for (int tick = 0; tick < 40; ++tick) {
    if (random() % 8 != 0) at += vector(random() % 2 == 0 ? 0.2 : 0.01);
    if (random() % 6 == 0) direction = vector(1);
    const Eigen::Vector3f read = has_counts ? Eigen::Vector3f(0.03F * (at / 0.03F).array().round()) : at;
    const auto size = static_cast<float>(random() % 4 == 0 ? 0 : std::exp2(between(-12, 3)));
    path.steps.push_back({read, size * direction});
    if (has_limits && random() % 4 != 0) path.steps.back().limits = {limit(), limit()};
  }
  return path;
}

}  // namespace

const Generator<DampedPath>& damped_paths() {
  static const Generator<DampedPath> paths{drawn_path, [](const DampedPath& path) {
                                             std::vector<DampedPath> simpler;
                                             for (const auto& steps : shorter(path.steps, 2))
                                               simpler.push_back({path.parameters, steps});
                                             return simpler;
                                           }};
  return paths;
}

Damper own_damper(const damping::Parameters& parameters) {
  const auto its = std::make_shared<fast::Damping>(std::get<fast::Damping>(fast::Damping::build(parameters)));
  return [its](const DampedStep& step) -> DampedAnswer {
    const Eigen::Vector3f force = its->tick(step.position, 1, {step.spring, Status::contact, {}, step.limits}).force;
    return {force, Eigen::Vector3f(its->state().velocity.data())};
  };
}

mpq_class rounding_along(const Eigen::Vector3f& force, const Eigen::Vector3f& a) {
  return rounding(rational(force), rational(a));
}

Violation dissipates_at_its_own_velocity(const DampedPath& path, const OpenDamper& open) {
  const Damper damper = open(path.parameters);
  const mpq_class most = rational(path.parameters.larger());
  for (const DampedStep& step : path.steps) {
    const DampedAnswer answer = damper(step);
    const Rational3 F = rational(answer.force), v = rational(answer.velocity), d = difference(F, rational(step.spring));
    // d is that of the rounded force: it changes both sides, the second by at most 2 |d·rounding|.
    if (product(d, v) + product(d, d) / most > rounding(F, v) + 3 * rounding(F, d) / most)
      return "at " + show(answer.velocity) + " mm/s damping makes " + show(step.spring) + " N to " + show(answer.force) +
             " N, and gives energy";
  }
  return std::nullopt;
}

Sampled sampled(const DampedPath& path, const OpenDamper& open) {
  const damping::Parameters& p = path.parameters;
  const Damper damper = open(p);
  const double gamma = damping::sampling_factor(static_cast<double>(p.share));
  const mpq_class factor = mpq_class(gamma) * rational(p.larger()) * rational(p.rate);
  Sampled sum;
  for (std::size_t k = 0; k + 1 < path.steps.size(); ++k) {
    const DampedStep& step = path.steps[k];
    const Rational3 F = rational(damper(step).force);
    const Rational3 way = difference(rational(path.steps[k + 1].position), rational(step.position));
    sum.given += product(difference(F, rational(step.spring)), way);
    sum.bound += factor * product(way, way);
    sum.rounding += rounding(F, way);
  }
  // The filter's rounding makes γ larger by a share that is computed, not proved (docs/damping.md), and γ has its own in
  // binary64.
  sum.rounding += sum.bound * mpq_class(0x1p-20) / rational(p.share);
  return sum;
}

Violation sampling_gives_at_most_the_bound(const DampedPath& path, const OpenDamper& open) {
  const Sampled sum = sampled(path, open);
  if (sum.given <= sum.bound + sum.rounding) return std::nullopt;
  return "damping gives " + std::to_string(sum.given.get_d()) + " mJ, more than " + std::to_string(sum.bound.get_d()) + " mJ";
}

// With w = 0 it is (1 + q)/q times νs, with w = 1 it is -(1 + q)/q times (-(1 + q)/α from α = 1/2 on).
DampedPath nearest_to_the_bound(float share, int ticks) {
  DampedPath path{{.rate = 1000, .share = share, .damping = 0x1p-9F, .most = HUGE_VALF}, {}};
  const double alpha = static_cast<double>(share), q = 1 - alpha;
  double place = 0, velocity = 0;
  const auto go = [&](bool has_spring, double way) {
    path.steps.push_back({{0, 0, static_cast<float>(place)}, {0, 0, has_spring ? 64.0F : 0.0F}});
    place += way;
    velocity = q * velocity + alpha * way;
  };
  go(false, 0.01);
  for (int tick = 0; tick < ticks; ++tick) {
    if (alpha >= 0.5)
      go(true, -(1 + q) / alpha * velocity);
    else if (velocity > 0.002)
      go(true, -(1 + q) / q * velocity);
    else
      go(false, (1 + q) / q * velocity);
  }
  go(false, 0);
  return path;
}

}  // namespace forceshade::properties
