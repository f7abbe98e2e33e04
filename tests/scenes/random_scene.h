// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random meshes, motions, and scenes of objects that move.

#include <cstdint>
#include <string>

#include "forceshade/description.h"
#include "tests/meshes/both_sides.h"
#include "tests/scenes/poses.h"
#include "tests/support/mesh_source.h"

namespace forceshade::tests {

inline scene::Motion random_motion(std::uint64_t seed, std::size_t ticks) {
  PosePath path(seed);
  scene::Motion motion{{}, seed % 2 == 0};
  for (std::size_t tick = 0; tick < ticks; ++tick) motion.poses.push_back(path.next());
  return motion;
}

inline Description law(LawId id) {
  return {std::string(name_of(id)), DescribedLaw{id, {15.24F, 25.4F, 0.5F}}};
}

inline Description random_mesh(tests::MeshSource& source, bool has_friction) {
  const tests::RandomMesh made = source.next();
  MeshRendering rendering = shaded(made.mesh, source.normals_of(made.mesh), made.sides, 0.3F);
  if (has_friction) {
    rendering.contact = mesh::Contact::friction;
    rendering.materials = source.materials_of(made.mesh);
  }
  return {"its.off", rendering};
}

// One to three objects with motions of 50 ticks: laws and meshes with and without friction.
inline DescribedScene random_scene(tests::MeshSource& source, std::uint64_t seed) {
  DescribedScene scene{{}, 1000, 0.5F};
  for (std::uint64_t i = 0; i <= seed % 3; ++i)
    scene.objects.push_back({"object " + std::to_string(i),
                             (seed + i) % 4 == 0 ? law(LawId::bump_3p) : random_mesh(source, i % 2 == 0),
                             random_motion(10 * seed + i, 50)});
  return scene;
}

}  // namespace forceshade::tests
