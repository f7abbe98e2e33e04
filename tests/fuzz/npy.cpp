// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/grid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade::fuzz;
  return load_grid(text_of(data, size), "\x93NUMPY");
}
