// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The subject of a description: what is rendered by the fast path, beside its exact definition.

#include <memory>

#include "forceshade/description.h"
#include "forceshade/properties.h"

namespace forceshade::properties {

// Throws std::invalid_argument where a side refuses it.
std::shared_ptr<const Subject> subject_of(const Description& description);

}  // namespace forceshade::properties
