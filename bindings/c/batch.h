// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A batch of the C interface: checked, and gone through in blocks, without allocation.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>

#include "bindings/c/errors.h"
#include "bindings/c/strided.h"
#include "forceshade.h"
#include "forceshade/fast.h"

namespace forceshade::c {

// Returns OK, or an error code after setting the error text.
forceshade_result check(const forceshade_batch* batch) noexcept;

inline forceshade_status status_of(Status status) noexcept {
  static_assert(FORCESHADE_UNFINISHED == static_cast<int>(Status::unfinished) &&
                FORCESHADE_INVALID == static_cast<int>(Status::invalid));
  return static_cast<forceshade_status>(status);
}

// Writes an answer to where the caller has room for it.
inline forceshade_result give(const fast::Evaluation& answer, float* force, forceshade_status* status) noexcept {
  // One by one, as they were just stored: a wider load would have to wait until these stores have reached the cache, 3 ns.
  const volatile float* const components = answer.force.data();
  for (std::size_t axis = 0; axis < 3; ++axis) force[axis] = components[axis];
  if (status != nullptr) *status = status_of(answer.status);
  return FORCESHADE_OK;
}

// True if it can be answered where it lies. Statuses need the positions after the forces are written.
inline bool is_without_gaps(const forceshade_batch& batch) noexcept {
  return batch.position_stride == 12 && batch.position_component == 4 && batch.force_stride == 12 &&
         batch.force_component == 4 &&
         (batch.statuses == nullptr || (batch.status_stride == 1 && batch.positions != batch.forces));
}

// The widest block is what a vector call makes the most of.
inline constexpr std::size_t kBlock = 512;
using Block = std::array<Eigen::Vector3f, kBlock>;

// answer(positions, forces, statuses) for one block after the other: writes the forces, and the statuses where the span is not
// empty; its results are added up.
template <class Answer>
std::size_t for_each_block(const forceshade_batch& batch, const Answer& answer) noexcept {
  if (batch.count > 0 && is_without_gaps(batch)) {
    return answer(std::span(as_vectors(batch.positions), batch.count), std::span(as_vectors(batch.forces), batch.count),
                  std::span(batch.statuses, batch.statuses == nullptr ? 0 : batch.count));
  }
  Block positions, forces;
  std::array<forceshade_status, kBlock> statuses;
  std::size_t sum = 0;
  for (std::size_t begin = 0; begin < batch.count; begin += kBlock) {
    const std::size_t count = std::min(kBlock, batch.count - begin);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        positions[i][static_cast<Eigen::Index>(axis)] =
            *at(batch.positions, begin + i, batch.position_stride, axis, batch.position_component);
    sum += answer(std::span(positions.data(), count), std::span(forces.data(), count),
                  std::span(statuses.data(), batch.statuses == nullptr ? 0 : count));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        *at(batch.forces, begin + i, batch.force_stride, axis, batch.force_component) =
            forces[i][static_cast<Eigen::Index>(axis)];
    if (batch.statuses == nullptr) continue;
    for (std::size_t i = 0; i < count; ++i) *at(batch.statuses, begin + i, batch.status_stride) = statuses[i];
  }
  return sum;
}

// Writes what evaluate(position, index) gives for one position after the other. Returns how many were invalid.
template <class Evaluate>
std::size_t answer_each(const forceshade_batch& batch, const Evaluate& evaluate) noexcept {
  std::size_t index = 0;
  return for_each_block(batch, [&](auto positions, auto forces, auto statuses) noexcept {
    std::size_t invalid = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const fast::Evaluation answer = evaluate(positions[i], index++);
      forces[i] = answer.force;
      invalid += answer.status == Status::invalid ? 1 : 0;
      if (!statuses.empty()) statuses[i] = status_of(answer.status);
    }
    return invalid;
  });
}

}  // namespace forceshade::c
