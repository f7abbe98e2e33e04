// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The materials of a mesh, from --friction or from a file of --materials (docs/meshes.md, "Materials and friction").

#include <string>

#include "forceshade/meshes.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// The one of a whole mesh: "0.3", "0.4,0.3" (static, dynamic) or "inf". name: what a message calls it. Throws Error.
mesh::Material parse_friction(const std::string& name, const std::string& text);

// Those that the options give a mesh; without a list where they give none, or such as change nothing. Throws Error with
// file, line, value and what was expected.
mesh::Materials read_materials(const Options& options, const mesh::LoadedMesh& loaded);

// The same materials without a list where they change nothing, and without a number for each triangle where they are one.
mesh::Materials simplest(mesh::Materials made);

}  // namespace forceshade::subjects
