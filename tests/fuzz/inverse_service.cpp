// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "device/haply/haply_messages.h"
#include "forceshade/error.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  namespace haply = device::haply;
  const std::string text(fuzz::text_of(data, size));
  fuzz::read_or_refuse<Error>("the Inverse Service", [&] {
    for (const haply::Inverse3& arm : haply::message_of(text).arms) {
      fuzz::require(!arm.id.empty(), "an arm has an id");
      fuzz::require(!arm.position || arm.position->cwiseAbs().maxCoeff() <= 2000, "a position is within reach");
    }
  });
  fuzz::read_or_refuse<Error>("the Inverse Service",
                              [&] { fuzz::require(haply::version_of(text).major == 3, "a version is spoken"); });
  haply::sessions_in(text);
  return 0;
}
