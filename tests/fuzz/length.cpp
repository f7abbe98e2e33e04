// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/quantity.h"
#include "forceshade/error.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string text(fuzz::text_of(data, size));
  fuzz::read_or_refuse<Error>(
      "--radius", [&] { fuzz::require(!std::isnan(files::parse_length("--radius", text)), "a length is a number"); });
  fuzz::read_or_refuse<Error>("--stiffness", [&] {
    fuzz::require(!std::isnan(files::parse_stiffness("--stiffness", text)), "a stiffness is a number");
  });
  return 0;
}
