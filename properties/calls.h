// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer under comparison: every way in which it can be called.

#include <Eigen/Core>
#include <functional>
#include <span>

#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/law.h"

namespace forceshade::properties {

// Both are called from several threads at once.
struct Calls {
  std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate;

  // The forces at the positions, into a span of the same length, by one instruction set's code.
  std::function<fast::BatchResult(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces,
                                  fast::InstructionSet set)>
      batch;

  // Whether a call for one position, too, has code of its own in each instruction set: a batch of one then stands for the
  // single call on a machine whose widest set is that one.
  bool single_depends_on_set = false;
};

Calls calls_of(const fast::Law& law);
Calls calls_of(const fast::HeightMapField& law);

// What certify compares, made for a law or map and its parameters, all in the domain.
struct MakeCalls {
  std::function<Calls(LawId law, const Parameters& parameters)> law;
  std::function<Calls(const HeightMap& map, height::Rendering rendering, float stiffness)> height_map;
};

MakeCalls calls_of_the_fast_path();

}  // namespace forceshade::properties
