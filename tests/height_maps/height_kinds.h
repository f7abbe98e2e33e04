// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The samples of every kind of height map that tests are made of. A kind without samples does not compile.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "forceshade/height_map.h"

namespace forceshade {

// A map, and its height written down a second time, in binary64.
struct HeightExample {
  const char* name;
  HeightMap map;
  std::function<double(double x, double y)> U;  // mm
};

namespace tests {

// Maps that are the same to the bit on every machine: what hashes and hard cases are of.
struct HeightScene {
  const char* name;
  HeightMap map;
  float step;                // mm: a power of two; 2^23 of them lead past all that the map has
  std::vector<float> edges;  // mm: coordinates at which something changes
};

// The samples of each kind: scenes() for hashes, hard cases and the common suite, examples() for the energies.
template <class Kind>
struct Samples;

template <>
struct Samples<height::Plane> {
  static std::vector<HeightScene> scenes() { return {{"plane", {{{height::Plane{0.75F, -1.0F / 3, 2}}}}, 0x1p-19F, {0, 1}}}; }
  static std::vector<HeightExample> examples() {
    return {{"slope", {{{height::Plane{0.25F, -0.5F, 1}}}}, [](double x, double y) { return 1 + 0.25 * x - 0.5 * y; }}};
  }
};

template <>
struct Samples<height::Cone> {
  static std::vector<HeightScene> scenes() {
    return {{"cone", {{{height::Cone{0.5F, -0.25F, 2.5F, 4}}}}, 0x1p-20F, {0.5F, -0.25F, 4.5F, -3.5F, 3.75F}}};
  }
  static std::vector<HeightExample> examples() {
    return {{"cone", {{{height::Cone{1, 2, 3, 4}}}}, [](double x, double y) {
               return std::max(0.0, 3 * (1 - std::hypot(x - 1, y - 2) / 4));
             }}};
  }
};

inline double cap_height(double R, double w, double rho) {
  return 2 * rho < w ? std::sqrt(R * R - rho * rho) - std::sqrt(R * R - w * w / 4) : 0.0;
}

template <>
struct Samples<height::CylinderCap> {
  static std::vector<HeightScene> scenes() {
    return {{"cylinder-cap", {{{height::CylinderCap{1, 15.24F, 25.4F}}}}, 0x1p-19F, {1, 13.7F, -11.7F}}};
  }
  static std::vector<HeightExample> examples() {
    return {{"ridge", {{{height::CylinderCap{0, 15.24F, 25.4F}}}}, [](double x, double) {
               return cap_height(15.24, 25.4, std::fabs(x));
             }}};
  }
};

template <>
struct Samples<height::SphereCap> {
  static std::vector<HeightScene> scenes() {
    return {{"sphere-cap", {{{height::SphereCap{1, -1, 5, 8}, true}}}, 0x1p-20F, {1, -1, 5, -3, 3, -5}}};
  }
  static std::vector<HeightExample> examples() {
    return {{"ball", {{{height::SphereCap{1, -0.5F, 5, 8}}}}, [](double x, double y) {
               return cap_height(5, 8, std::hypot(x - 1, y + 0.5));
             }}};
  }
};

template <>
struct Samples<height::Gaussian> {
  static std::vector<HeightScene> scenes() {
    return {{"gaussian", {{{height::Gaussian{1, -1, 3, 1.5F}}}}, 0x1p-18F, {1, -1, 0x1p-30F, 31}}};
  }
  static std::vector<HeightExample> examples() {
    return {{"hill", {{{height::Gaussian{0, 1, 2, 2.5F}}}}, [](double x, double y) {
               return 2 * std::exp(-(x * x + (y - 1) * (y - 1)) / 12.5);
             }}};
  }
};

template <>
struct Samples<height::Grating> {
  static std::vector<HeightScene> scenes() {
    return {{"grating", {{{height::Grating{0.5F, 6.5F, -2, 0.25F}}}}, 0x1p-19F, {0, 0.5F, 0.03125F}}};
  }
  static std::vector<HeightExample> examples() {
    return {{"waves", {{{height::Grating{0.25F, 2, 0.5F, 0.3F}}}}, [](double x, double y) {
               return 0.25 * std::cos(2 * x + 0.5 * y + 0.3);
             }}};
  }
};

template <>
struct Samples<height::Polygons> {
  static std::vector<HeightScene> scenes() {
    const height::Polygons roof{{{-4, 0.5F}, {-1.5F, 3}, {0, 3}, {2, -1.0F / 3}, {7, 0.25F}}};
    return {{"polygons", {{{roof}}}, 0x1p-20F, {-4, -1.5F, 0, 2, 7}}};
  }
  static std::vector<HeightExample> examples() {
    return {{"tent", {{{height::Polygons{{{-5, 0}, {-1, 2}, {3, 1}, {5, 0}}}}}}, [](double x, double) {
               return x < -5 || x > 5 ? 0 : x < -1 ? (x + 5) / 2 : x < 3 ? 2 - (x + 1) / 4 : (5 - x) / 2;
             }}};
  }
};

// Values from bits, multiples of 1/256 mm.
inline std::shared_ptr<const height::Grid> rough_grid_of_bits(height::Interpolant interpolant, height::Edge edge) {
  std::mt19937_64 random(1995);
  height::Grid grid{13, 9, 0.3F, edge, interpolant, {}};
  for (int i = 0; i < 13 * 9; ++i) grid.values.push_back(static_cast<float>(random() >> 56) * 0x1p-8F);
  return std::make_shared<const height::Grid>(std::move(grid));
}

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
    return t < 1 ? 2.0 / 3 - t * t + t * t * t / 2 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0.0;
  };
  const auto kept = [&](long i, long n) {
    return grid.edge == height::Edge::tile ? ((i % n) + n) % n : std::min(std::max(i, 0L), n - 1);
  };
  const double u = x / static_cast<double>(grid.pitch) + (grid.columns - 1.0) / 2,
               v = y / static_cast<double>(grid.pitch) + (grid.rows - 1.0) / 2;
  double sum = 0;
  const long column = std::lround(u), row = std::lround(v);
  for (long i = column - 3; i <= column + 3; ++i) {
    const double across = bump(u - static_cast<double>(i));
    if (across == 0) continue;
    for (long j = row - 3; j <= row + 3; ++j)
      sum +=
          across * bump(v - static_cast<double>(j)) *
          static_cast<double>(grid.values[static_cast<std::size_t>(kept(j, grid.rows) * grid.columns + kept(i, grid.columns))]);
  }
  return sum;
}

template <>
struct Samples<height::Grid> {
  // call(interpolant, edge) for each sort of grid.
  template <class Call>
  static void for_each_sort(const Call& call) {
    for (const auto interpolant : {height::Interpolant::bilinear, height::Interpolant::cubic_spline})
      for (const auto edge : {height::Edge::clamp, height::Edge::tile}) call(interpolant, edge);
  }
  static std::vector<HeightScene> scenes() {
    std::vector<HeightScene> scenes;
    for_each_sort([&](height::Interpolant interpolant, height::Edge edge) {
      const bool is_clamped = edge == height::Edge::clamp;
      const char* name = interpolant == height::Interpolant::bilinear ? is_clamped ? "bilinear-clamp" : "bilinear-tile"
                         : is_clamped                                 ? "cubic-spline-clamp"
                                                                      : "cubic-spline-tile";
      scenes.push_back({name, {{{rough_grid_of_bits(interpolant, edge)}}}, 0x1p-22F, {0, 0.15F, -0.3F, 1.8F, -1.8F}});
    });
    return scenes;
  }
  static std::vector<HeightExample> examples() {
    std::vector<HeightExample> examples;
    for_each_sort([&](height::Interpolant interpolant, height::Edge edge) {
      const auto grid = rough_grid(interpolant, edge);
      examples.push_back({interpolant == height::Interpolant::bilinear ? "facets" : "spline",
                          {{{grid}}},
                          [grid](double x, double y) { return grid_height(*grid, x, y); }});
    });
    return examples;
  }
};

// samples_of(std::type_identity<Kind>()) of all kinds, one after the other.
template <class SamplesOf>
auto samples_of_every_kind(const SamplesOf& samples_of) {
  decltype(samples_of(std::type_identity<height::Plane>())) all;
  for (std::size_t kind = 0; kind < height::kKinds; ++kind)
    height::make_shape(kind, [&]<class Kind>(std::type_identity<Kind> of) {
      for (auto& sample : samples_of(of)) all.push_back(std::move(sample));
      return height::Plane{};
    });
  return all;
}

inline std::vector<HeightScene> scenes_of_every_kind() {
  return samples_of_every_kind([]<class Kind>(std::type_identity<Kind>) { return Samples<Kind>::scenes(); });
}
inline std::vector<HeightExample> examples_of_every_kind() {
  return samples_of_every_kind([]<class Kind>(std::type_identity<Kind>) { return Samples<Kind>::examples(); });
}

}  // namespace tests
}  // namespace forceshade
