// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map as a subject.

#include "forceshade/properties/height_map_claims.h"
#include "forceshade/properties/subject.h"

namespace forceshade::properties {

// What renders a height map, which is in the domain with this stiffness (N/mm).
using RenderHeightMap = std::function<Calls(const HeightMap& map, height::Rendering rendering, float stiffness)>;
Calls fast_height_map(const HeightMap& map, height::Rendering rendering, float stiffness);

class HeightMapSubject final : public Subject {
 public:
  // name: of its file. Throws std::invalid_argument for a map or a stiffness outside the domain.
  HeightMapSubject(const std::string& name, const HeightMap& map, height::Rendering rendering, float stiffness,
                   RenderHeightMap render = &fast_height_map);
  // Any renderer of a map; drawn parameters are rendered by the fast path.
  explicit HeightMapSubject(RenderedHeightMap rendered, const std::string& name = "map");

  const Identity& identity() const override { return identity_; }
  std::vector<std::string> parts() const override { return words_of(rendered_.law.map()); }
  std::unique_ptr<ReferenceSession> open_reference() const override;
  const Calls& calls() const override { return calls_; }
  std::unique_ptr<Positions> positions(std::uint64_t seed) const override;
  std::vector<Eigen::Vector3f> draw_path() const override;
  Violation check_continuity() const override;
  Violation check_unit_normals() const override;
  Violation check_passivity() const override;
  // "cell lines", where the map has a grid: whether its gradient is continuous across them. A bilinear grid's is not, and a
  // certificate does not demand it.
  std::vector<FurtherProperty> further_properties() const override;
  std::vector<std::string> jumps() const override { return claims_.jumps(); }
  // A conservative map's normal is not one, and should not be.
  bool has_unit_directions() const override { return rendered_.law.rendering() != height::Rendering::conservative; }
  bool is_conservative() const override { return claims_.is_conservative; }
  std::vector<LoopEnergy> energies(const reference::Watch& watch) const override;
  DrawnSubject with_drawn_parameters(std::uint64_t seed) const override;
  // The two sides of a map take long to build, so there are few sets.
  std::uint64_t points_of_a_set(std::uint64_t points) const override { return (points + 7) / 8; }

 private:
  RenderHeightMap render_;
  Calls calls_;
  RenderedHeightMap rendered_;
  HeightMapClaims claims_;
  Identity identity_;
};

}  // namespace forceshade::properties
