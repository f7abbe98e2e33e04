// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Positions aimed at what is hard for a height map, as PositionSource does for a law.

#include <array>

#include "properties/height_map_claims.h"
#include "properties/positions.h"

namespace forceshade::properties {

// An endless, repeatable stream: half by bit pattern or spread over the map, half aimed. Aim::facet_line is a cell line, an
// edge or a rim, Aim::axis a centre, an apex or a crest.
class HeightPositionSource final : public Positions, private Draws {
 public:
  // Both must outlive this.
  HeightPositionSource(const reference::HeightMapField& law, const HeightMapClaims& shape, std::uint64_t seed)
      : Draws(seed), law_(law), shape_(shape) {}

  Aimed next() override;

  // (x, y) spread over one of the parts.
  std::array<float, 2> anywhere();
  // Within three steps of a line or a rim of one of the parts.
  std::array<float, 2> on_a_line();
  // mm: U, or what else a position must be below to feel a force; 0 outside the domain.
  double surface(const std::array<float, 2>& at) const;

 private:
  const PartShape& part() { return shape_.parts[bits() % shape_.parts.size()]; }
  float mark(const std::vector<float>& marks) { return marks.empty() ? 0 : marks[bits() % marks.size()]; }
  float cell_line(const Lines& lines);
  std::array<float, 2> on_rim(const Rim& rim);
  std::array<float, 2> at_a_centre();
  float below(const std::array<float, 2>& at);
  float near_surface(const std::array<float, 2>& at);
  Eigen::Vector3f near_tie(Eigen::Vector3f position);

  const reference::HeightMapField& law_;
  const HeightMapClaims& shape_;
};

}  // namespace forceshade::properties
