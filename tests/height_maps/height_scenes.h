// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Height maps of every kind, and sums, that are the same to the bit on every machine: what hashes and hard cases are of.

#include "tests/height_maps/height_kinds.h"

namespace forceshade::tests {

// Every kind, and sums that cancel, tie, or meet a tail. A name with "texture on" has a surface, and is force-shaded alone.
inline std::vector<HeightScene> height_scenes() {
  using namespace height;
  std::vector<HeightScene> scenes = scenes_of_every_kind();
  const Part cone = Samples<Cone>::scenes().front().map.parts.front(),
             hill = Samples<Gaussian>::scenes().front().map.parts.front();
  const auto texture = rough_grid_of_bits(Interpolant::cubic_spline, Edge::tile);
  std::vector<Part> all_kinds{{Plane{0.25F, 0, 0}}};
  for (const HeightScene& scene : scenes) {
    const Shape& shape = scene.map.parts.front().shape;
    if (!std::holds_alternative<Plane>(shape) && !std::holds_alternative<std::shared_ptr<const Grid>>(shape))
      all_kinds.push_back({shape, std::holds_alternative<CylinderCap>(shape)});
  }
  all_kinds.push_back({texture, true});
  scenes.push_back({"what-cancels", {{cone, {cone.shape, true}, {Plane{0, 0, 1.5F}}}}, 0x1p-20F, {0.5F, -0.25F, 4.5F}});
  scenes.push_back({"tails-over-a-plane", {{{Plane{0, 0, 0.25F}}, hill, {Gaussian{-30, 2, 1, 0.5F}}}}, 0x1p-17F, {1, -1, 31}});
  scenes.push_back({"all-kinds", {std::move(all_kinds)}, 0x1p-20F, {0, 0.5F, -0.25F, 1, -1, 4.5F}});
  scenes.push_back({"texture-on-two-polygons", {{{texture}}, {{Polygons{{{-6, 0}, {0, 2}, {6, 0}}}}}}, 0x1p-20F, {0, 6, -6}});
  return scenes;
}

inline bool is_rendered(const HeightScene& scene, height::Mode mode) {
  return scene.map.surface.empty() || mode == height::Mode::force_shaded;
}

}  // namespace forceshade::tests
