// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/grid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade::fuzz;
  const std::string_view bytes = text_of(data, size);
  return load_grid(bytes, bytes.starts_with("I") ? std::string_view("II*\0", 4) : std::string_view("MM\0*", 4));
}
