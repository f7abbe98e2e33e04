// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The profile of a height map, its section y = 0 between two x, and polygons under it: what the theta-critical hypothesis
// (5.2), stated for a cylinder, requires of any smooth profile.

#include <memory>
#include <vector>

#include "forceshade/height_map.h"
#include "reference/theta_critical.h"

namespace forceshade::reference {

// Holds exact_arithmetic while it computes. Throws std::invalid_argument, which says why, for a section that it cannot answer
// for.
class Profile {
 public:
  // The profile of the sum of parts in their domains, from < to in mm. Refuses kinks strictly between the two, and more than
  // 20 000 changes of the curvature's sign or cells of a grid.
  Profile(const std::vector<height::Part>& parts, float from, float to);
  ~Profile();

  // The turning of the normal on the way, there and back counted alike: the total variation of arctan U_x, degrees. The two
  // enclose it, and are less than 1e-12 apart.
  double least_turning() const;
  double most_turning() const;

  struct Needed {
    unsigned polygons;  // each of as many equal shares of the turning is surely less than theta-critical
    bool is_fewest;     // surely; false means that one fewer would have shares within 1e-18 degrees of it or at it
  };
  // theta_critical: at least kLeastThetaCritical.
  Needed polygons_needed(const RationalAngle& theta_critical) const;

  // The ends of up to 20 000 `polygons`, pieces that turn equally, each at the binary32 nearest to where it belongs; heights
  // rounded likewise.
  std::vector<height::Knot> knots(unsigned polygons) const;

 private:
  struct Pieces;
  std::unique_ptr<const Pieces> pieces_;
};

}  // namespace forceshade::reference
