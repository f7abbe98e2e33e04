// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The thesis's edge scheme (3.3): a triangle's normal, mixed with those of its three neighbours. It jumps across edges; the
// vertex scheme does not.

#include <vector>

#include "reference/meshes/schemes/scheme.h"

namespace forceshade::reference::meshes {

class EdgeScheme final : public Scheme {
 public:
  explicit EdgeScheme(const Surface& surface);

  // Inside triangles alone.
  Direction direction(const Rest& rest) const override;

 private:
  const Surface& surface_;
  std::vector<Vector> normals_;                  // of the triangles: unit, each component rounded to binary32
  std::vector<std::array<Integer, 3>> lengths_;  // of their sides, mm, rounded to binary32
};

}  // namespace forceshade::reference::meshes
