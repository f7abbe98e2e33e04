// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map as a subject.

#include "properties/field_subject.h"

namespace forceshade::properties {

Renderer fast_height_map(const HeightMap& map, height::Mode mode, float stiffness);

class HeightMapSubject final : public FieldSubject<reference::HeightMapField, HeightMapClaims> {
 public:
  // name: of its file. Each throws std::invalid_argument for a map or a stiffness outside the domain.
  HeightMapSubject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness)
      : HeightMapSubject(name, map, mode, stiffness, &fast_height_map, true) {}
  HeightMapSubject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness, RenderHeightMap render,
                   bool is_rendered_by_library = false);
  // Any renderer of a map; drawn parameters are rendered by the fast path.
  explicit HeightMapSubject(const RenderedHeightMap& rendered, const std::string& name = "map");

  std::vector<std::string> parts() const override { return words_of(rendered_.law.map()); }
  std::unique_ptr<Positions> positions(std::uint64_t seed) const override;
  Violation check_continuity(Chooser& choose) const override;
  // "cell lines", where the map has a grid: whether its gradient is continuous across them. A bilinear grid's is not, and a
  // certificate does not demand it.
  std::vector<FurtherProperty> further_properties() const override;
  Expected expected() const override;
  std::vector<LoopEnergy> energies(const Monitor& monitor) const override;
  DrawnSubject with_drawn_parameters(std::uint64_t seed) const override;
  // The two sides of a map take long to build, so there are few sets.
  std::uint64_t points_of_a_set(std::uint64_t points) const override { return (points + 7) / 8; }

 private:
  RenderHeightMap render_;
};

}  // namespace forceshade::properties
