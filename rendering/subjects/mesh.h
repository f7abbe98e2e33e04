// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh from its file and the options that say how it is rendered.

#include <string>
#include <utility>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/meshes.h"
#include "rendering/mesh_rendering.h"
#include "rendering/subjects/options.h"

namespace forceshade::subjects {

// name: of the option. Throws BadInput for a word that is none of mesh::kUnitNames.
mesh::Unit unit_named(const std::string& word, const std::string& name = "--unit");

// What both sides can build. The monitor follows the check of the mesh. Throws BadInput or mesh::Error with the file, its line
// or faces, and what was expected; and Interrupted.
MeshRendering read_mesh(const Options& options, float stiffness, const Monitor& monitor = {});

// What holds, as keys and values; where it was not given, what holds unless said; an empty value where that is said by leaving
// it out. with_folders: files are named with their folders, else without.
std::vector<std::pair<std::string, std::string>> written_mesh(const Options& options, bool with_folders);

}  // namespace forceshade::subjects
