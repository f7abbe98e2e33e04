// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Height maps of every kind, and sums, that are the same to the bit on every machine: what hashes and hard cases are of.

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "forceshade/vocabulary/height_map.h"

namespace forceshade::tests {

struct HeightScene {
  const char* name;
  HeightMap map;
  float step;                // mm: a power of two; 2^23 of them lead past all that the map has
  std::vector<float> edges;  // mm: coordinates at which something changes
};

// Values from bits, multiples of 1/256 mm.
inline std::shared_ptr<const height::Grid> rough_grid_of_bits(height::Interpolant interpolant, height::Edge edge) {
  std::mt19937_64 random(1995);
  height::Grid grid{13, 9, 0.3F, edge, interpolant, {}};
  for (int i = 0; i < 13 * 9; ++i) grid.values.push_back(static_cast<float>(random() >> 56) * 0x1p-8F);
  return std::make_shared<const height::Grid>(std::move(grid));
}

// Every kind, and sums that cancel, tie, or meet a tail. A name with "texture on" has a surface, and is force-shaded alone.
inline std::vector<HeightScene> height_scenes() {
  using namespace height;
  const Cone cone{0.5F, -0.25F, 2.5F, 4};
  const CylinderCap ridge{1, 15.24F, 25.4F};
  const SphereCap ball{1, -1, 5, 8};
  const Gaussian hill{1, -1, 3, 1.5F};
  const Grating waves{0.5F, 6.5F, -2, 0.25F};
  const Polygons roof{{{-4, 0.5F}, {-1.5F, 3}, {0, 3}, {2, -1.0F / 3}, {7, 0.25F}}};
  std::vector<HeightScene> scenes{
      {"plane", {{{Plane{0.75F, -1.0F / 3, 2}}}}, 0x1p-19F, {0, 1}},
      {"cone", {{{cone}}}, 0x1p-20F, {0.5F, -0.25F, 4.5F, -3.5F, 3.75F}},
      {"cylinder-cap", {{{ridge}}}, 0x1p-19F, {1, 13.7F, -11.7F}},
      {"sphere-cap", {{{ball, true}}}, 0x1p-20F, {1, -1, 5, -3, 3, -5}},
      {"gaussian", {{{hill}}}, 0x1p-18F, {1, -1, 0x1p-30F, 31}},
      {"grating", {{{waves}}}, 0x1p-19F, {0, 0.5F, 0.03125F}},
      {"polygons", {{{roof}}}, 0x1p-20F, {-4, -1.5F, 0, 2, 7}},
  };
  for (const Interpolant interpolant : {Interpolant::bilinear, Interpolant::cubic_spline})
    for (const Edge edge : {Edge::clamp, Edge::tile})
      scenes.push_back({interpolant == Interpolant::bilinear ? edge == Edge::clamp ? "bilinear-clamp" : "bilinear-tile"
                        : edge == Edge::clamp                ? "cubic-spline-clamp"
                                                             : "cubic-spline-tile",
                        {{{rough_grid_of_bits(interpolant, edge)}}},
                        0x1p-22F,
                        {0, 0.15F, -0.3F, 1.8F, -1.8F}});
  const auto texture = rough_grid_of_bits(Interpolant::cubic_spline, Edge::tile);
  scenes.push_back({"what-cancels", {{{cone}, {cone, true}, {Plane{0, 0, 1.5F}}}}, 0x1p-20F, {0.5F, -0.25F, 4.5F}});
  scenes.push_back(
      {"tails-over-a-plane", {{{Plane{0, 0, 0.25F}}, {hill}, {Gaussian{-30, 2, 1, 0.5F}}}}, 0x1p-17F, {1, -1, 31}});
  scenes.push_back({"all-kinds",
                    {{{Plane{0.25F, 0, 0}}, {cone}, {ridge, true}, {ball}, {hill}, {waves}, {roof}, {texture, true}}},
                    0x1p-20F,
                    {0, 0.5F, -0.25F, 1, -1, 4.5F}});
  scenes.push_back({"texture-on-two-polygons", {{{texture}}, {{Polygons{{{-6, 0}, {0, 2}, {6, 0}}}}}}, 0x1p-20F, {0, 6, -6}});
  return scenes;
}

inline bool is_rendered(const HeightScene& scene, height::Rendering rendering) {
  return scene.map.surface.empty() || rendering == height::Rendering::force_shaded;
}

}  // namespace forceshade::tests
