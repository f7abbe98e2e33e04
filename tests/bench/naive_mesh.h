// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A god-object as it is usually written, for comparison: binary32, an epsilon against passing through, rays against a tree.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::bench {

// Moves towards the position along up to three planes that it has met (Zilles and Salisbury 1995), staying kEpsilon above them.
class NaiveGodObject {
 public:
  // normals: of each corner, for a force along the interpolated one, or none.
  NaiveGodObject(const mesh::TriangleMesh& mesh, float stiffness, const mesh::CornerNormals& normals = {});

  // N. position: mm.
  Eigen::Vector3f step(const Eigen::Vector3f& position);

 private:
  struct Node {
    Eigen::Vector3f low, high;
    std::uint32_t first, count;  // triangles of a leaf; count 0: children `first` and first + 1
  };
  struct Corner3 {
    Eigen::Vector3f a, b, c;
  };
  struct RayHit {
    float t;
    std::uint32_t triangle;
  };

  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::vector<std::uint32_t>& order,
             const std::vector<Corner3>& corners);
  // The normal between the corners of triangle i, at the point of it that is nearest to the place.
  Eigen::Vector3f interpolated_normal(std::uint32_t i) const;
  RayHit cast(const Eigen::Vector3f& from, const Eigen::Vector3f& by) const;

  std::vector<Node> nodes_;
  std::vector<Corner3> triangles_, normals_;
  float stiffness_;
  Eigen::Vector3f place_{0, 0, 0};
  bool has_place_ = false;
};

}  // namespace forceshade::bench
