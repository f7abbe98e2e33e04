// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade::fuzz;
  return load_mesh(text_of(data, size), "mesh.ply");
}
