// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh as an OFF file, in mm.

#include <ostream>

#include "forceshade/vocabulary/mesh.h"

namespace forceshade::mesh {

// Each coordinate as the shortest decimal that is read as the same binary32 number, whatever the locale.
void write_off(std::ostream& out, const TriangleMesh& mesh);

}  // namespace forceshade::mesh
