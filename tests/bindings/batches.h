// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Batches of the C interfaces for tests.

#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "forceshade.h"

namespace forceshade::tests {

inline std::array<std::uint32_t, 3> bits_of(const float* force) {
  return {std::bit_cast<std::uint32_t>(force[0]), std::bit_cast<std::uint32_t>(force[1]),
          std::bit_cast<std::uint32_t>(force[2])};
}

// Positions about the surface, and some of any bits at all.
inline std::vector<float> positions(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> across(-16, 16), up(-4, 4);
  std::vector<float> all;
  for (std::size_t i = 0; i < count; ++i) {
    if (random() % 8 != 0)
      all.insert(all.end(), {across(random), across(random), up(random)});
    else
      for (int axis = 0; axis < 3; ++axis) all.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  }
  return all;
}

inline forceshade_batch batch_of(std::span<const float> at, std::span<float> forces, std::span<forceshade_status> statuses) {
  return {.size = sizeof(forceshade_batch),
          .count = at.size() / 3,
          .positions = at.data(),
          .position_stride = 12,
          .position_component = 4,
          .forces = forces.data(),
          .force_stride = 12,
          .force_component = 4,
          .statuses = statuses.data(),
          .status_stride = 1,
          .threads = 1};
}

}  // namespace forceshade::tests
