// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A scene from its TOML file (docs/scenes.md): the meshes of the objects that stay where they are, at their places, are one
// mesh, the ground; each of the others has a motion.

#include <string>
#include <utility>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "rendering/meshes/ground.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// An object with a motion, before its files are read.
struct UnreadObject {
  std::string name;
  Options options;  // a law, height map or mesh
  scene::Motion motion;
};

struct Scene {
  Options options;  // those that were given, and those of the scene's file
  mesh::Ground ground;
  mesh::Materials materials;  // of the ground's triangles
  std::vector<UnreadObject> moving;
  float rate = 1000;  // ticks per second of the motions, Hz
};

// The ground as it is before mesh::check(). Throws Error with file, line, value and what was expected.
Scene load_scene(const Options& options);

// Reads a scene for both sides: the ground alone where nothing moves; else a scene, whose first object is the ground where it
// has one. The monitor follows the check of each mesh. Throws the same, and Interrupted.
Description read_scene(const Options& options, float stiffness, const Monitor& monitor = {});

// The options that were given beside the file; what they leave open, the file says. with_folders: as written_mesh() of mesh.h.
std::vector<std::pair<std::string, std::string>> written_scene(const Options& options, bool with_folders);

}  // namespace forceshade::subjects
