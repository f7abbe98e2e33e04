// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/plan.h"

#include "forceshade/certificate.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  fuzz::read_or_refuse<Error>("plan.json", [&] {
    const properties::Plan plan = properties::plan_from_json(std::string(fuzz::text_of(data, size)), "plan.json");
    // A plan that is read once is read the same again.
    const std::string json = properties::to_json(plan);
    fuzz::require(properties::to_json(properties::plan_from_json(json, "plan.json")) == json, "a plan reads back");
  });
  return 0;
}
