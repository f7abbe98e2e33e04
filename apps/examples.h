// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An example or two of each command of forceshade.

#include <span>

#include "apps/documentation.h"

namespace forceshade::apps {

std::span<const Example> forceshade_examples();

}  // namespace forceshade::apps
