// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certificate.h"

#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  fuzz::read_or_refuse<Error>("certificate.json", [&] {
    const properties::Certificate certificate =
        properties::from_json(std::string(fuzz::text_of(data, size)), "certificate.json");
    // A certificate that is read once is read the same again.
    const std::string json = properties::to_json(certificate);
    fuzz::require(properties::to_json(properties::from_json(json, "certificate.json")) == json, "a certificate reads back");
  });
  return 0;
}
