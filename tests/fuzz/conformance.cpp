// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/error.h"
#include "report/conformance/comparison.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  fuzz::read_or_refuse<Error>("run.json", [&] {
    const std::string_view text = fuzz::text_of(data, size);
    const conformance::Comparison found = conformance::compare(text, "run.json", text, "run.json");
    fuzz::require(found.changes.empty(), "a run is as good as itself");
    conformance::words_of(found);
  });
  return 0;
}
