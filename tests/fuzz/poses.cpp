// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/error.h"
#include "rendering/meshes/placement.h"
#include "subjects/motion.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "poses.csv");
  fuzz::read_or_refuse<Error>(file + ":", [&] {
    const scene::Motion motion = subjects::read_motion(file, 1000, size % 2 == 0);
    fuzz::require(!motion.poses.empty(), "there is a first pose");
    for (const scene::Pose& pose : motion.poses) {
      for (const float coordinate : pose.translation) fuzz::require(mesh::is_of_translation(coordinate), "a translation");
      for (const float component : pose.rotation) fuzz::require(mesh::is_of_rotation(component), "a rotation");
      fuzz::require(pose.rotation != std::array<float, 4>{}, "a rotation that is not 0");
    }
  });
  return 0;
}
