// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/scene.h"

#include "forceshade/fast.h"
#include "rendering/mesh_rendering.h"
#include "subjects/damping.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "scene.toml");
  static const std::string mesh =
      fuzz::file_of("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\ng tyre\nf 1 3 2\nf 1 2 4\ng\nf 1 4 3\nf 2 3 4\n", "its.obj");
  // An error is about the scene, or about a file that it names, wherever that lies.
  fuzz::read_or_refuse<Error>("", [&] {
    const subjects::Scene scene = subjects::load_scene({{"scene", file}});
    const mesh::Ground& ground = scene.ground;
    const std::size_t triangles = ground.loaded.mesh.triangles.size();
    fuzz::require(!error_of_materials(scene.materials, triangles, true), "a ground can have what is read");
    for (const subjects::UnreadObject& one : scene.moving) fuzz::require(!one.motion.poses.empty(), "a motion has a pose");
    const damping::Described without_time{subjects::read_damping(scene.options).parameters};
    fuzz::require(std::holds_alternative<fast::Damping>(fast::Damping::build(without_time.at(1))),
                  "a damping that is read is in its ranges, but for the share that a rate makes");
    fuzz::require(triangles == 4 * ground.objects.size(), "each object has its triangles");
    fuzz::require(ground.loaded.groups.of_triangle.size() == triangles, "each triangle has a group or none");
    for (const mesh::Triangle& triangle : ground.loaded.mesh.triangles)
      for (const std::uint32_t vertex : triangle)
        fuzz::require(vertex < ground.loaded.mesh.vertices.size(), "a triangle has vertices of the ground");
  });
  return 0;
}
