// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Equivalence: the renderer's force is the exact force rounded to binary32, bit for bit, and its status is right.

#include <stdexcept>

#include "properties/rendered.h"

namespace forceshade::properties {

// Compares an answer already given with a rounding already done.
Violation difference(const Eigen::Vector3f& position, const Rendered& answer, const reference::Rounded& exact);

// The violation where the reference throws: an answer that is not known is not known to be right.
std::string not_decided(const Eigen::Vector3f& position, const std::domain_error& error);

template <class Reference>
Violation equivalence(const RenderedField<Reference>& rendered, const Eigen::Vector3f& position) {
  try {
    return difference(position, rendered.force_at(position), rendered.law.round_to_binary32(position));
  } catch (const std::domain_error& error) {
    return not_decided(position, error);
  }
}

}  // namespace forceshade::properties
