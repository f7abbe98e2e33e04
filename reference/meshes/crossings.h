// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a straight flight meets the surface.

#include <optional>
#include <vector>

#include "forceshade/reference/meshes/points.h"

namespace forceshade::reference::meshes {

struct Crossing {
  Fraction s;  // from 0 to 1 along the flight, excluding both
  SurfacePoint point;
};

// Tries every feature of the surface, but for those whose box is apart from the flight's.
class Crossings {
 public:
  explicit Crossings(const Surface& surface);

  // Every point strictly between g and p that the flight has in common with the surface, in order; but where it runs in a
  // triangle's plane, or along an edge, only the points at which it meets that triangle's border, or that edge's ends. So the
  // first point of every part of the flight that is in the surface is one of them, unless that part begins at g.
  std::vector<Crossing> between(const Vector& g, const Vector& p) const;

  // The point of the surface that is at p.
  std::optional<SurfacePoint> at(const Vector& p) const;

 private:
  // Binary64 numbers of the units of Vector; vertices are exact in them.
  struct Box {
    std::array<double, 3> low, high;
    explicit Box(const Vector& point);
    Box join(const Box& other) const;
    bool is_apart(const Box& other) const;
  };

  const Surface& surface_;
  std::vector<Box> vertices_, edges_, triangles_;
};

}  // namespace forceshade::reference::meshes
