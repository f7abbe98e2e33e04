// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds where a straight flight meets the surface.

#include <optional>
#include <vector>

#include "reference/meshes/boxes.h"
#include "reference/meshes/points.h"

namespace forceshade::reference::meshes {

struct Crossing {
  Fraction s;  // from 0 to 1 along the flight, excluding both
  SurfacePoint point;
};

// Tries every feature of the surface, but for those whose box is apart from the flight.
class Crossings {
 public:
  explicit Crossings(const Surface& surface);

  // Every point strictly between g and p that the flight has in common with the surface, in order; but where it runs in a
  // triangle's plane, or along an edge, only the points at which it meets that triangle's border, or that edge's ends. So the
  // first point of every part of the flight that is in the surface is one of them, unless that part begins at g.
  std::vector<Crossing> between(const Vector& g, const Vector& p) const;
  // The number of triangles that have a box, along the axes, that a flight towards p meets from g to the share s of the way
  // there.
  std::size_t looks(const Vector& g, const Vector& p, const Fraction& s) const;

  // The point of the surface that is at p.
  std::optional<SurfacePoint> at(const Vector& p) const;

 private:
  const Surface& surface_;
  BoxTree vertices_, edges_, triangles_;
};

}  // namespace forceshade::reference::meshes
