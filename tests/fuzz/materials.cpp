// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/materials.h"

#include "rendering/mesh_rendering.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "materials.toml");
  mesh::LoadedMesh loaded;
  loaded.mesh.triangles.resize(4);
  loaded.materials = {{"rubber", "steel"}, {0, 0, 1, mesh::FaceNames::kNone}};
  loaded.groups = {{"tyre"}, {0, mesh::FaceNames::kNone, mesh::FaceNames::kNone, mesh::FaceNames::kNone}};
  fuzz::read_or_refuse<Error>(file + ": ", [&] {
    const mesh::Materials read = subjects::read_materials({{"materials", file}}, loaded);
    fuzz::require(!error_of_materials(read, loaded.mesh.triangles.size(), true), "a mesh can have what is read");
  });
  return 0;
}
