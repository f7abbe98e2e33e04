// SPDX-License-Identifier: BSD-3-Clause
// Prints the lines of tests/golden/hashes.txt as this build makes them. Exit codes: 1 refused, or instruction sets differ.

#include "same_bits.h"

#include <exception>

#include "same_bits_damping.h"
#include "same_bits_heights.h"
#include "same_bits_meshes.h"

int main() {
  using namespace forceshade;
  bool all_same = true;
  const auto print = [&](const std::string& name, const tests::Bits& bits) {
    std::printf("%s %s\n", name.c_str(), bits.hash.c_str());
    for (const std::size_t different : bits.different) all_same &= different == 0;
  };
  const auto scenes = tests::height_scenes();
  try {
    // First, so that an arithmetic that height maps, meshes, scenes or damping alone refuse is refused at once.
    tests::bits_of_moving_objects();
    tests::bits_of_damping();
    const auto built = fast::HeightMapField::build(scenes.front().map, height::Mode::true_height, 1);
    if (const auto* error = std::get_if<ParameterError>(&built)) throw std::runtime_error(error->message());
    for (const LawName& law : kLaws) print(std::string(law.name), tests::bits_of(law.id));
    for (const tests::HeightScene& scene : scenes)
      for (const auto& [mode, name] : height::kModes)
        if (is_rendered(scene, mode)) print(name_of(scene, mode), bits_of(scene, mode));
    for (const tests::MeshScene& scene : tests::mesh_scenes()) print(scene.name, bits_of(scene));
    print("scene-of-moving-objects", tests::bits_of_moving_objects());
    print("damping", tests::bits_of_damping());
  } catch (const std::runtime_error& error) {
    return std::fprintf(stderr, "refused: %s\n", error.what()), 1;
  }
  return all_same ? 0 : 1;
}
