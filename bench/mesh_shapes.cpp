// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/bench/mesh_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace forceshade::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kApproachTicks = 1000;
constexpr double kApproachFrom = 5;  // mm above the surface

std::array<float, 3> to_float(const std::array<double, 3>& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

// at(t, height): the path's place, `height` mm above where it is in contact at t.
template <class Place>
void add_paths(MeshWorkload& workload, std::size_t contact_ticks, std::size_t free_ticks, const Place& in_contact,
               const Place& above) {
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
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<std::array<double, 3>, 12> corner{{{-1, g, 0},
                                                      {1, g, 0},
                                                      {-1, -g, 0},
                                                      {1, -g, 0},
                                                      {0, -1, g},
                                                      {0, 1, g},
                                                      {0, -1, -g},
                                                      {0, 1, -g},
                                                      {g, 0, -1},
                                                      {g, 0, 1},
                                                      {-g, 0, -1},
                                                      {-g, 0, 1}}};
  constexpr std::array<std::array<std::uint32_t, 3>, 20> kFaces{
      {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
       {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  // A point by how many f-ths of which corners it has: the same on both sides of an edge.
  using Key = std::array<std::array<std::uint32_t, 2>, 3>;
  std::map<Key, std::uint32_t> numbers;  // of the vertices on edges; those inside a face are its own
  const auto vertex = [&](const std::array<std::uint32_t, 3>& face, std::array<int, 3> part) {
    std::array<double, 3> p{};
    Key key{};
    std::size_t used = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (part[c] == 0) continue;
      key[used++] = {face[c] + 1, static_cast<std::uint32_t>(part[c])};
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += part[c] * corner[face[c]][axis];
    }
    const auto add = [&] {
      const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      for (double& one : p) one *= kRadius / length;
      workload.mesh.vertices.push_back(to_float(p));
      return static_cast<std::uint32_t>(workload.mesh.vertices.size() - 1);
    };
    if (used == 3) return add();
    std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(used));
    const auto found = numbers.find(key);
    return found != numbers.end() ? found->second : numbers[key] = add();
  };
  const auto at = [&](std::size_t row, std::size_t i) { return row * (row + 1) / 2 + i; };
  for (const auto& face : kFaces) {
    std::vector<std::uint32_t> number;
    for (int row = 0; row <= f; ++row)
      for (int i = 0; i <= row; ++i) number.push_back(vertex(face, {f - row, row - i, i}));
    for (std::size_t row = 0; row < static_cast<std::size_t>(f); ++row)
      for (std::size_t i = 0; i <= row; ++i) {
        workload.mesh.triangles.push_back({number[at(row, i)], number[at(row + 1, i)], number[at(row + 1, i + 1)]});
        if (i < row)
          workload.mesh.triangles.push_back({number[at(row, i)], number[at(row + 1, i + 1)], number[at(row, i + 1)]});
      }
  }
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
  const auto row = static_cast<std::uint32_t>(n) + 1;
  for (std::uint32_t j = 0; j < row; ++j)
    for (std::uint32_t i = 0; i < row; ++i) {
      const double x = -50 + 100.0 * i / n, y = -50 + 100.0 * j / n;
      workload.mesh.vertices.push_back(to_float({x, y, kHeight(x)}));
    }
  for (std::uint32_t j = 0; j + 1 < row; ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      workload.mesh.triangles.push_back({a, b, d});
      workload.mesh.triangles.push_back({a, d, c});
    }
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

}  // namespace forceshade::bench
