// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// prepare() of the public header, of bumps that are read in the caller's way.

#include "study/apparatus/bumps.h"
#include "study/preparation/preparation.h"

namespace forceshade::apparatus {

bool prepare(const Bumps& bumps, const std::filesystem::path& folder, const PreparationOptions& options,
             const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
