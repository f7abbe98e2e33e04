// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/mesh_workloads.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"

namespace forceshade::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kApproachTicks = 1000;
constexpr double kApproachFrom = 5;  // mm above the surface

std::array<float, 3> to_float(const std::array<double, 3>& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

// at(t, height): the path's place, `height` mm above where it is in contact at t.
template <class InContact, class Above>
void add_paths(MeshWorkload& workload, std::size_t contact_ticks, std::size_t free_ticks, const InContact& in_contact,
               const Above& above) {
  const auto start = in_contact(0.0), high = above(0.0);
  for (std::size_t i = 0; i < kApproachTicks; ++i) {
    const double part = static_cast<double>(i) / kApproachTicks;
    std::array<double, 3> p{};
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = high[axis] + part * (start[axis] - high[axis]);
    workload.approach.push_back(to_float(p));
  }
  for (std::size_t i = 0; i < contact_ticks; ++i)
    workload.contact.push_back(to_float(in_contact(kTick * static_cast<double>(i))));
  for (std::size_t i = 0; i < free_ticks; ++i) workload.free.push_back(to_float(above(kTick * static_cast<double>(i))));
}

}  // namespace

MeshWorkload sphere_workload(int f, std::size_t contact_ticks, std::size_t free_ticks) {
  constexpr double kRadius = 50;  // mm
  MeshWorkload workload;
  workload.name = "sphere, f = " + std::to_string(f);
  workload.mesh = mesh::icosphere(static_cast<std::uint32_t>(f), kRadius);
  const auto place = [](double t, double radius) -> std::array<double, 3> {
    const double theta = kPi / 2 + 1.30 * std::sin(2 * kPi * 0.110 * t), phi = 2 * kPi * 0.170 * t;
    return {radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi), radius * std::cos(theta)};
  };
  using Place = std::array<double, 3> (*)(double);
  static constexpr auto kPlace = place;
  const Place in_contact = [](double t) { return kPlace(t, kRadius - (1.25 + 0.75 * std::sin(2 * kPi * 1.30 * t))); };
  const Place above = [](double t) { return kPlace(t, kRadius + kApproachFrom); };
  add_paths(workload, contact_ticks, free_ticks, in_contact, above);
  return workload;
}

MeshWorkload bump_workload(int n, std::size_t contact_ticks, std::size_t free_ticks) {
  static constexpr double kRadius = 15.24, kWidth = 25.4;  // mm
  static constexpr auto kHeight = [](double x) {
    return std::fabs(x) < kWidth / 2 ? std::sqrt(kRadius * kRadius - x * x) - std::sqrt(kRadius * kRadius - kWidth * kWidth / 4)
                                     : 0.0;
  };
  MeshWorkload workload;
  workload.name = "bump, n = " + std::to_string(n);
  workload.mesh = mesh::cylinder_bump(kRadius, kWidth, 100, static_cast<std::uint32_t>(n));
  static constexpr auto kPlace = [](double t, double above) -> std::array<double, 3> {
    const double x = 40 * std::sin(2 * kPi * 0.30 * t), y = 40 * std::sin(2 * kPi * 0.0131 * t);
    return {x, y, kHeight(x) + above};
  };
  using Place = std::array<double, 3> (*)(double);
  const Place in_contact = [](double t) { return kPlace(t, -(1.5 + 0.5 * std::sin(2 * kPi * 1.30 * t))); };
  const Place above = [](double t) { return kPlace(t, kApproachFrom); };
  add_paths(workload, contact_ticks, free_ticks, in_contact, above);
  return workload;
}

MeshRendering unshaded_rendering(const MeshWorkload& workload) {
  auto checked = mesh::check(workload.mesh);
  if (const auto* findings = std::get_if<mesh::Findings>(&checked)) {
    std::printf("%s: %s\n", workload.name.c_str(), findings->words().c_str());
    std::exit(1);
  }
  return {std::get<mesh::CheckedMesh>(std::move(checked)),
          {},
          mesh::Sides::front,
          mesh::Shading::none,
          static_cast<float>(kMeshStiffness)};
}

}  // namespace forceshade::bench
