// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks for two ticks of a god-object between which the force changes much, with the fast path (tick_changes.h).

#include <vector>

#include "properties/rest_regions.h"
#include "properties/tick_changes.h"

namespace forceshade::properties {

// Radians: the state is rounded to a grid. Only ticks count where the god-object is so far from the hand that two steps of the
// grid turn the force by less than this.
constexpr double kGridAngle = 0x1p-14;

// Two regions between which the force may change by much.
struct SuspectPair {
  Affine first, second;                       // D in each
  std::vector<Eigen::Vector3d> corners = {};  // mm, of the positions at which the hand may leave the first for the second
  Eigen::Vector3d inwards;                    // into the first, of length 1; zero where both are the same region
  double force = 0;                           // mm: the change over K, at most
  double turn = 0;                            // radians, at most
};

// Puts what it finds into `changes`: from the positions of these pairs, in steps into many directions, and on a random walk
// over the whole mesh. Throws Interrupted.
void search_changes(const MeshRendering& rendering, const HandStep& hand, const std::vector<SuspectPair>& pairs,
                    TickChanges& changes, const Monitor& monitor);

}  // namespace forceshade::properties
