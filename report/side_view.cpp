// SPDX-License-Identifier: BSD-3-Clause
#include "report/side_view.h"

#include <algorithm>
#include <cmath>

#include "properties/height_map_claims.h"
#include "reference/energy.h"
#include "reference/estimates.h"
#include "report/pictures.h"

namespace forceshade::properties {
namespace {

using Exact = reference::HeightMapField::Estimate;

// One section of a map, by the reference.
struct Section {
  reference::HeightMapField law;
  float y;

  Exact at(double x, double z) const { return law.estimate({static_cast<float>(x), y, static_cast<float>(z)}); }
  double surface(double x) const { return static_cast<double>(at(x, 0).gap.mid()); }
  Eigen::Vector3d direction(double x) const {
    const Exact exact = at(x, 0);
    const Eigen::Vector3d normal(-static_cast<double>(exact.Ux.mid()), -static_cast<double>(exact.Uy.mid()), 1);
    return law.mode() == height::Mode::conservative ? normal : normal.normalized();
  }

  // ∂F_z/∂x - ∂F_x/∂z of the exact force, by central differences over the steps that binary32 has.
  double density(double x, double z) const {
    constexpr double kStep = 1e-3;  // mm
    const auto x0 = static_cast<float>(x - kStep), x1 = static_cast<float>(x + kStep);
    const auto z0 = static_cast<float>(z - kStep), z1 = static_cast<float>(z + kStep);
    const auto difference = [](const reference::Ball64& a, const reference::Ball64& b, float from, float to) {
      return static_cast<double>(b.mid() - a.mid()) / (static_cast<double>(to) - static_cast<double>(from));
    };
    const auto at_f = [&](float px, float pz) { return law.estimate({px, y, pz}); };
    const auto mx = static_cast<float>(x), mz = static_cast<float>(z);
    return difference(at_f(x0, mz).z, at_f(x1, mz).z, x0, x1) - difference(at_f(mx, z0).x, at_f(mx, z1).x, z0, z1);
  }
};

// The place of a jump of the direction between a and b, if there is one: halved until nothing lies between.
std::optional<double> jump_between(const Section& section, double a, double b) {
  constexpr double kVisible = 1e-3;
  const auto turn = [&](double p, double q) { return (section.direction(p) - section.direction(q)).norm(); };
  while (b - a > 1e-6) {
    const double middle = 0.5 * (a + b);
    (turn(a, middle) > turn(middle, b) ? b : a) = middle;
  }
  return turn(a, b) > kVisible ? std::optional(b) : std::nullopt;
}

}  // namespace

SideView side_view(const Drawn& law) {
  const bool is_bump = law.shape.w > 0;
  const auto w = static_cast<double>(law.shape.w), h = static_cast<double>(law.shape.h);
  SideView view{law.name(),
                -law.reach(),
                law.reach(),
                heights(law),
                is_bump ? Heights{-0.12 * w, h + 0.06 * w} : Heights{-3, 1},
                profile_depths({law}),
                across(law),
                {},
                {},
                {},
                {},
                {}};
  for (const reference::LineTerm& line : reference::line_terms(law.reference))
    for (const double sign : {-1.0, 1.0}) view.jumps.push_back(sign * reference::binary64(line.x)[0]);
  view.surface = [shape = law.shape](double x) { return static_cast<double>(shape.surface(static_cast<long double>(x))); };
  view.stands_for = [shape = law.shape, is_bump](double x) {
    if (!is_bump || shape.id == LawId::bump_cylinder || 2 * std::fabs(x) > static_cast<double>(shape.w)) return std::nan("");
    LawClaims cylinder = shape;
    cylinder.id = LawId::bump_cylinder;
    return static_cast<double>(cylinder.surface(static_cast<long double>(x)));
  };
  view.force = [renderer = law.law](float x, float z) { return renderer.force({x, 0, z}); };
  view.density = [reference = law.reference](double x, double z) {
    const auto [low, high] =
        reference::binary64(reference::circulation_density(reference, {static_cast<float>(x), static_cast<float>(z)}));
    return low + (high - low) / 2;
  };
  return view;
}

SideView side_view(const RenderedHeightMap& rendered, const std::string& name, const Range& range) {
  constexpr int kSteps = 480;
  constexpr double kBeside = 1e-5;  // mm: how far from a jump it is looked at
  const Section section{rendered.law, range.y};
  const HeightMapClaims shape(rendered.law);
  const auto left = static_cast<double>(range.from), right = static_cast<double>(range.to), width = right - left;
  const double step = width / kSteps, deepest = width / 12;
  const bool is_shaded = rendered.law.mode() == height::Mode::force_shaded;
  // The same numbers with their own height as the surface.
  const Section map{std::get<reference::HeightMapField>(reference::HeightMapField::build(
                        {rendered.law.map().parts}, height::Mode::true_height, rendered.law.stiffness())),
                    range.y};
  SideView view{name, left, right, {}, {}, {deepest / 4, deepest / 2, deepest}, {}, {}, {}, {}, {}, {}};
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = left + step * i;
    view.across.push_back({static_cast<float>(x), false});
    for (const Section* one : {&section, &map}) {
      low = std::min(low, one->surface(x));
      high = std::max(high, one->surface(x));
    }
    // A line between two steps belongs to one of them, whichever rounding says: it is looked for in both.
    if (i == kSteps || !shape.gradient_change(x + step / 2, static_cast<double>(range.y), step).kink) continue;
    const auto jump = jump_between(section, x, x + step);
    if (jump && (view.jumps.empty() || *jump - view.jumps.back() > 2 * kBeside)) view.jumps.push_back(*jump);
  }
  for (const double jump : view.jumps) {
    std::erase_if(view.across, [&](const Sample& s) { return std::fabs(static_cast<double>(s.x) - jump) < kBeside; });
    view.across.push_back({static_cast<float>(jump - kBeside), false});
    view.across.push_back({static_cast<float>(jump + kBeside), true});
  }
  std::sort(view.across.begin(), view.across.end(), [](const Sample& a, const Sample& b) { return a.x < b.x; });
  // No taller than wide: of a mountain, the top.
  const double top = high + 0.05 * width;
  view.shown = {std::max(low - 1.2 * deepest, top - width), top};
  view.nominal = {std::max(low - 0.08 * width, top - width), top};
  view.surface = [section](double x) { return section.surface(x); };
  view.stands_for = [map, is_shaded](double x) { return is_shaded ? map.surface(x) : std::nan(""); };
  view.force = [renderer = rendered.force_at, y = range.y](float x, float z) { return renderer({x, y, z}).force; };
  view.density = [section, is_conservative = shape.is_conservative](double x, double z) {
    return is_conservative ? 0 : section.density(x, z);
  };
  return view;
}

}  // namespace forceshade::properties
