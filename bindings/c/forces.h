// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Forces and statuses of a batch.

#include <Eigen/Core>
#include <span>
#include <variant>

#include "bindings/c/batch.h"
#include "bindings/c/described.h"
#include "bindings/c/parts.h"
#include "fast/domain.h"
#include "forceshade.h"

namespace forceshade::c {

// A batch gives no statuses. Where it gives a force there is contact; where it gives none, a single call says why.
template <class Field>
void add_statuses(const Field& field, std::span<const Eigen::Vector3f> positions, std::span<const Eigen::Vector3f> forces,
                  std::span<forceshade_status> statuses) noexcept {
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    const Eigen::Vector3f& position = positions[i];
    if (!fast::in_domain({position.x(), position.y(), position.z()}))
      statuses[i] = FORCESHADE_INVALID;
    else if ((forces[i].array() != 0).any())
      statuses[i] = FORCESHADE_CONTACT;
    else
      statuses[i] = status_of(field.evaluate(position).status);
  }
}

// The forces and statuses of a subject that has a batch call. Returns how many positions were invalid.
inline std::size_t forces_of(const Subject& subject, const forceshade_batch& batch) noexcept {
  const fast::InstructionSet set = fast::best_instruction_set();
  return in_parts(batch, [&](const forceshade_batch& part, std::size_t) noexcept {
    return for_each_block(part, [&](auto positions, auto forces, auto statuses) noexcept {
      const std::size_t invalid = subject.renderer.batch(positions, forces, set).invalid;
      if (const auto* law = std::get_if<fast::Law>(&subject.field))
        add_statuses(*law, positions, forces, statuses);
      else if (const auto* map = std::get_if<fast::HeightMapField>(&subject.field))
        add_statuses(*map, positions, forces, statuses);
      return invalid;
    });
  });
}

}  // namespace forceshade::c
