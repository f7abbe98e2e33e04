// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A scene of fixed objects from its TOML file (docs/scenes.md): their meshes at their places are one mesh, the ground.

#include <string>
#include <utility>
#include <vector>

#include "forceshade/checks.h"
#include "rendering/meshes/ground.h"
#include "rendering/subjects/options.h"

namespace forceshade::subjects {

struct Scene {
  Options options;  // those that were given, and those of the scene's file
  mesh::Ground ground;
  mesh::Materials materials;  // of the ground's triangles
};

// The ground as it is before mesh::check(). Throws BadInput or mesh::Error with file, line, value and what was expected.
Scene load_scene(const Options& options);

// What both sides can build. The monitor follows the check of the ground. Throws the same, and Interrupted.
MeshRendering read_scene(const Options& options, float stiffness, const Monitor& monitor = {});

// The options that were given beside the file; what they leave open, the file says. with_folders: as written_mesh() of mesh.h.
std::vector<std::pair<std::string, std::string>> written_scene(const Options& options, bool with_folders);

}  // namespace forceshade::subjects
