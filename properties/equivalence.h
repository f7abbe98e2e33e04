// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Equivalence: the renderer's force is the exact force rounded to binary32, bit for bit, and its status is right.

#include "forceshade/properties/subject.h"

namespace forceshade::properties {

Violation equivalence(const Subject& subject, const Eigen::Vector3f& position);

// The same for an answer already given, against a rounding already done.
Violation difference(const Eigen::Vector3f& position, const Rendered& answer, const reference::Rounded& exact);

}  // namespace forceshade::properties
