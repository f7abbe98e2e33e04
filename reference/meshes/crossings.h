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

  // Along the flight. Where sheets cross, several are at one place: vertices first, then edges, then triangles, by their index.
  friend std::strong_ordering operator<=>(const Crossing& a, const Crossing& b);
  friend bool operator==(const Crossing& a, const Crossing& b) { return (a <=> b) == 0; }
};

// Tries every feature of the surface, but for those whose box is apart from the flight.
class Crossings {
 public:
  explicit Crossings(const Surface& surface);

  // Every point strictly between g and p that the flight has in common with the surface, in order; but where it runs in a
  // triangle's plane, or along an edge, only the points at which it meets that triangle's border, or that edge's ends. So the
  // first point of every part of the flight that is in the surface is one of them, unless that part begins at g.
  std::vector<Crossing> between(const Vector& g, const Vector& p) const;
  // True if the point `over`/`scale` of the surface is in one feature alone, and there is nothing such from it to e. It is in
  // the box around `ends`.
  bool is_alone(const Vector& over, const Integer& scale, const Vector& e, const std::array<Vector, 2>& ends) const;

  // The number of triangles that have a box, along the axes, that a flight towards p meets from g to the share s of the way
  // there.
  std::size_t looks(const Vector& g, const Vector& p, const Fraction& s) const;

  // The features that a point lies in, in the same order: more than one only where sheets meet.
  std::vector<Feature> features_at(const Vector& p) const;
  // The point of the surface that is at p, in the first of them.
  std::optional<SurfacePoint> at(const Vector& p) const;

 private:
  // All three are of the surface times scale.
  std::vector<Crossing> between(const Vector& g, const Vector& p, const Integer& scale, const Reach& reach) const;
  std::vector<Feature> features_at(const Vector& over, const Integer& scale, const Reach& reach) const;

  const Surface& surface_;
  BoxTree vertices_, edges_, triangles_;
};

}  // namespace forceshade::reference::meshes
