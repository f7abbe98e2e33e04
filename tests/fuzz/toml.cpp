// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/heights.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "map.toml");
  // An error is about the spec or about a grid's file, which is taken relative to the spec's directory; or of any other place,
  // where the spec names one.
  fuzz::read_or_refuse<Error>("", [&] {
    const heights::Spec spec = heights::read_spec(file);
    fuzz::require(!spec.map.parts.empty(), "a map has a part");
    fuzz::require(heights::lines_of_parts(file).parts.size() == spec.map.parts.size(), "every part has a line");
  });
  return 0;
}
