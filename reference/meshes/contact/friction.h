// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object goes for the hand's position; friction may hold it, or stop it before (docs/friction.md).

#include "reference/meshes/contact/direct.h"

namespace forceshade::reference::meshes {

// The ground of a descent has the coefficients, by any rule; by others than this one they are 0.
using Frictional = Direct;

}  // namespace forceshade::reference::meshes
