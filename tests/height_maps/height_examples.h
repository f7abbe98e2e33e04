// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map of every kind, and its height written down a second time, in binary64.

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "forceshade/vocabulary/height_map.h"

namespace forceshade {

struct HeightExample {
  const char* name;
  HeightMap map;
  std::function<double(double x, double y)> U;  // mm
};

inline std::shared_ptr<const height::Grid> rough_grid(height::Interpolant interpolant, height::Edge edge) {
  height::Grid grid{16, 12, 0.75F, edge, interpolant, {}};
  std::mt19937 random(7);
  for (int i = 0; i < 16 * 12; ++i) grid.values.push_back(static_cast<float>(static_cast<int>(random() % 200) + 1) / 400);
  return std::make_shared<height::Grid>(grid);
}

// Sum of hat functions or of cubic B-splines, each centred on its sample.
inline double grid_height(const height::Grid& grid, double x, double y) {
  const bool is_cubic = grid.interpolant == height::Interpolant::cubic_spline;
  const auto bump = [&](double t) {
    t = std::fabs(t);
    if (!is_cubic) return std::max(0.0, 1 - t);
    return t < 1 ? 2.0 / 3 - t * t + t * t * t / 2 : t < 2 ? std::pow(2 - t, 3) / 6 : 0.0;
  };
  const auto kept = [&](long i, long n) {
    return grid.edge == height::Edge::tile ? ((i % n) + n) % n : std::min(std::max(i, 0L), n - 1);
  };
  const double u = x / static_cast<double>(grid.pitch) + (grid.columns - 1.0) / 2,
               v = y / static_cast<double>(grid.pitch) + (grid.rows - 1.0) / 2;
  double sum = 0;
  for (long i = std::lround(u) - 3; i <= std::lround(u) + 3; ++i)
    for (long j = std::lround(v) - 3; j <= std::lround(v) + 3; ++j)
      sum +=
          bump(u - static_cast<double>(i)) * bump(v - static_cast<double>(j)) *
          static_cast<double>(grid.values[static_cast<std::size_t>(kept(j, grid.rows) * grid.columns + kept(i, grid.columns))]);
  return sum;
}

inline std::vector<HeightExample> height_examples() {
  using height::Edge;
  using height::Interpolant;
  const auto cap = [](double R, double w, double rho) {
    return 2 * rho < w ? std::sqrt(R * R - rho * rho) - std::sqrt(R * R - w * w / 4) : 0.0;
  };
  const auto ridge = [cap](double x, double) { return cap(15.24, 25.4, std::fabs(x)); };
  const auto ball = [cap](double x, double y) { return cap(5, 8, std::hypot(x - 1, y + 0.5)); };
  const auto cone = [](double x, double y) { return std::max(0.0, 3 * (1 - std::hypot(x - 1, y - 2) / 4)); };
  const auto hill = [](double x, double y) { return 2 * std::exp(-(x * x + (y - 1) * (y - 1)) / 12.5); };
  const auto waves = [](double x, double y) { return 0.25 * std::cos(2 * x + 0.5 * y + 0.3); };
  std::vector<HeightExample> all{
      {"slope", {{{height::Plane{0.25F, -0.5F, 1}}}}, [](double x, double y) { return 1 + 0.25 * x - 0.5 * y; }},
      {"cone", {{{height::Cone{1, 2, 3, 4}}}}, cone},
      {"ridge", {{{height::CylinderCap{0, 15.24F, 25.4F}}}}, ridge},
      {"ball", {{{height::SphereCap{1, -0.5F, 5, 8}}}}, ball},
      {"hill", {{{height::Gaussian{0, 1, 2, 2.5F}}}}, hill},
      {"waves", {{{height::Grating{0.25F, 2, 0.5F, 0.3F}}}}, waves},
      {"tent",
       {{{height::Polygons{{{-5, 0}, {-1, 2}, {3, 1}, {5, 0}}}}}},
       [](double x, double) {
         return x < -5 || x > 5 ? 0 : x < -1 ? (x + 5) / 2 : x < 3 ? 2 - (x + 1) / 4 : (5 - x) / 2;
       }},
      {"dent in waves",
       {{{height::SphereCap{1, -0.5F, 5, 8}, true}, {height::Grating{0.25F, 2, 0.5F, 0.3F}}}},
       [=](double x, double y) { return waves(x, y) - ball(x, y); }},
  };
  for (const Interpolant interpolant : {Interpolant::bilinear, Interpolant::cubic_spline})
    for (const Edge edge : {Edge::clamp, Edge::tile}) {
      const auto grid = rough_grid(interpolant, edge);
      all.push_back({interpolant == Interpolant::bilinear ? "facets" : "spline", {{{grid}}}, [grid](double x, double y) {
                       return grid_height(*grid, x, y);
                     }});
    }
  return all;
}

}  // namespace forceshade
