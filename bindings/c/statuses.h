// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The statuses of a batch.

#include <Eigen/Core>
#include <span>

#include "bindings/c/batch.h"
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
      statuses[i] = status_of(field.evaluate(position));
  }
}

}  // namespace forceshade::c
