// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy/height_stretch.h"
#include "reference/energy/strips.h"
#include "reference/height_energy.h"
#include "reference/heights/sum.h"
#include "reference/numbers/intervals.h"

namespace forceshade::reference {
namespace {

using height::Mode;

Point2 plan(const Eigen::Vector3f& point) {
  return {static_cast<double>(point.x()), static_cast<double>(point.y())};
}

// ½K·depth² there.
Enclosure spring(const HeightMapField& law, const Eigen::Vector3f& point) {
  const bool is_shaded = law.mode() == Mode::force_shaded;
  const Enclosure surface = sum_jet<Enclosure>(is_shaded ? law.map().surface : law.map().parts, plan(point)).U;
  const Enclosure depth = larger(0, surface - Enclosure(point.z()));
  return Enclosure(law.stiffness()) * depth * depth / 2;
}

// From a straight up or down to b, and anywhere in a field that is minus the gradient of the spring.
Enclosure work_of_spring(const HeightMapField& law, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Enclosure released = spring(law, a) - spring(law, b);
  if (law.mode() == Mode::conservative) return released;
  const Jet<Enclosure> map = sum_jet<Enclosure>(law.map().parts, plan(a));
  return released / sqrt(Enclosure(map.Ux * map.Ux + map.Uy * map.Uy + 1));
}

Ball64 work_across(const HeightMapField& law, const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Monitor& monitor) {
  const HeightLine line(law, {a.x(), a.y(), b.x(), b.y()});
  const Ball64 z0(static_cast<double>(a.z())), dz = Ball64(static_cast<double>(b.z())) - z0;
  const auto judge = [&](Stretch& stretch) {
    using SectionSample = SectionSample<SectionSeries>;
    const Local local(line, stretch);
    const auto depth = [&](const SectionSample& g, const SectionSeries& t) {
      return (g.surface - SectionSeries(z0) - SectionSeries(dz) * t).shorter();
    };
    const auto share = [&](const SectionSample& g, const auto&) {
      return ((SectionSeries(dz) - g.climb) * g.upright).shorter();
    };
    const auto force = [&](const SectionSample& g, const auto& t) { return depth(g, t) * share(g, t); };
    const Range below = local.range(local.function(depth));
    if (below.high <= 0) return;
    const Ball64 total = below.low < -below.high ? Ball64() : local.integral(local.function(force));
    stretch.generated = total;
    if (below.low >= 0) return;
    // Within what the part on the other side of the surface would add.
    stretch.change = local.change(local.function(depth));
    const Range along = local.range(local.function(share));
    const long double most = std::min(-below.low, below.high) * stretch.width() * (1 + 0x1p-60L);
    stretch.generated = total + ball(std::min(0.0L, along.low) * most, std::max(0.0L, along.high) * most);
  };
  // The error below which 64 bits cannot go.
  const long double floor = static_cast<long double>((b - a).norm() * (1 + a.cwiseAbs().maxCoeff())) * 0x1p-50L;
  Ball64 sum;
  for (const Stretch& stretch : refine(line, judge, 1e-10L, floor, monitor)) sum = sum + stretch.generated;
  return Ball64(static_cast<double>(law.stiffness())) * sum;
}

}  // namespace

Interval work(const HeightMapField& law, const std::vector<Eigen::Vector3f>& path, const Monitor& monitor) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  Enclosure sum = 0;
  const auto share = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(path.size()); };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3f &a = path[i - 1], &b = path[i];
    const Monitor segment = monitor.part(share(i - 1), share(i));
    segment.at(0);
    if (law.mode() == Mode::conservative || (a.x() == b.x() && a.y() == b.y())) {
      sum += work_of_spring(law, a, b);
    } else {
      const Ball64 across = decided([&] { return work_across(law, a, b, segment); });
      sum += Enclosure(Multiprecision(across.low()), Multiprecision(across.high()));
    }
  }
  return interval(sum);
}

}  // namespace forceshade::reference
