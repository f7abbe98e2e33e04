// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reference of a law or height map as a path: each step depends on its position alone.

#include <memory>

#include "forceshade/properties/subject.h"

namespace forceshade::properties {

// The field must outlive the session.
template <class Field>
std::unique_ptr<ReferenceSession> reference_of_field(const Field& field) {
  struct Session final : ReferenceSession {
    explicit Session(const Field& its) : field(its) {}
    reference::Rounded step(const Eigen::Vector3f& position) override { return field.round_to_binary32(position); }
    const Field& field;
  };
  return std::make_unique<Session>(field);
}

}  // namespace forceshade::properties
