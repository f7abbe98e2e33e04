// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A step of the hand among objects that move, in numbers of 50 digits that share nothing with either side.

#include "forceshade/properties.h"

namespace forceshade::properties {

// The position in the world of a point of an object, mm. Rounded; a NaN stays one.
Eigen::Vector3f in_world(const scene::Pose& pose, const Eigen::Vector3f& point);

// An object in contact: its poses in the tick and in the next one, where it sees the hand in both, mm, and its answer to the
// first in its own axes, N.
struct ContactOfTick {
  scene::Pose now, next;
  Eigen::Vector3f seen, seen_next;
  Eigen::Vector3f force;
};

// The account of one tick (properties/mesh_energy.md, "Energy"), mJ.
class WorkOfTick {
 public:
  // The hand's positions in the tick and in the next one, mm.
  WorkOfTick(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

  void add(const ContactOfTick& contact);

  // Nothing where the force on the hand, N, does the work that the objects and their motions do, within what rounding explains.
  Violation difference_from(const Eigen::Vector3f& force) const;

 private:
  Eigen::Vector3f from_, to_;
  double expected_ = 0, allowed_ = 0;  // mJ
};

}  // namespace forceshade::properties
