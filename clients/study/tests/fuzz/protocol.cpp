// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/protocol.h"

#include "files/input_file.h"
#include "study/experiments/language.h"
#include "study/experiments/order.h"
#include "tests/fuzz/input_file.h"

// Protocols and texts, both TOML: the input is read as one and as the other.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "protocol.toml");
  fuzz::read_or_refuse<Error>(file, [&] {
    const experiments::Protocol protocol = experiments::read_protocol(file);
    std::size_t trials = 0;
    for (const experiments::Block& block : experiments::order(protocol, size))
      trials += block.is_practice ? 0 : block.trials.size();
    fuzz::require(trials == static_cast<std::size_t>(protocol.trials()) && trials > 0, "every trial has its place");
    fuzz::require(!protocol.bumps().empty(), "a session renders something");
  });
  fuzz::read_or_refuse<Error>(file,
                              [&] { fuzz::require(!experiments::read_language(file).name.empty(), "a language has a name"); });
  return 0;
}
