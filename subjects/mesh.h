// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh from its file and the options that say how it is rendered.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/meshes.h"
#include "rendering/mesh_rendering.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// name: of the option. Throws Error for a word that is not one of mesh::kUnitNames.
mesh::Unit unit_named(const std::string& word, const std::string& name = "--unit");

// The rule of contact: the one that is named, or friction where a material has some. Throws Error where the options name
// another rule beside friction, or let faces cross.
mesh::Contact contact_beside(const mesh::Materials& materials, const Options& options);

// A mesh with its materials, as it is before its check.
struct Unchecked {
  mesh::LoadedMesh loaded;
  mesh::Materials materials;
  std::function<std::string(const mesh::Findings&)> words;  // one line for each finding of the check
};

// Makes a rendering of a mesh or scene for both sides: looks at the numbers of the options, calls `load`, and checks what it
// gives. The monitor follows that check. Throws Error with the option, or the file and the faces, and what was expected;
// Interrupted; and what `load` throws.
MeshRendering rendered(const Options& options, float stiffness, const std::function<Unchecked()>& load, const Monitor& monitor);

// Reads a mesh for both sides. The monitor follows the check of the mesh. Throws Error with the file, its
// line or faces, and what was expected; and Interrupted.
MeshRendering read_mesh(const Options& options, float stiffness, const Monitor& monitor = {});

// The options in force, as keys and values: the given value, else the default; an empty value where the default is to leave
// it out. with_folders: files are named with their folders, else without.
std::vector<std::pair<std::string, std::string>> written_mesh(const Options& options, bool with_folders);

}  // namespace forceshade::subjects
