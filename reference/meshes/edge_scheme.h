// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The thesis's edge scheme (3.3): a triangle's normal, mixed with those of its three neighbours. It jumps across edges; the
// vertex scheme does not.

#include <optional>
#include <vector>

#include "forceshade/reference/meshes/descent.h"

namespace forceshade::reference::meshes {

class EdgeScheme {
 public:
  explicit EdgeScheme(const Surface& surface);

  // N but for its length, as it is seen from in front; inside triangles alone.
  std::optional<Vector> direction(const SurfacePoint& r) const;

 private:
  const Surface& surface_;
  std::vector<Vector> normals_;                  // of the triangles: unit, each component rounded to binary32
  std::vector<std::array<Integer, 3>> lengths_;  // of their sides, mm, rounded to binary32
};

}  // namespace forceshade::reference::meshes
