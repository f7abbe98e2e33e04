// SPDX-License-Identifier: BSD-3-Clause
#include "files/csv.h"
#include "forceshade/device.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "hand.csv");
  fuzz::read_or_refuse<Error>(file + ':', [&] {
    device::Replay replay = device::Replay::load(file);
    fuzz::require(!replay.start(1000), "a recording can be started");
    const std::size_t left = replay.readings_left().value();
    fuzz::require(left >= 1, "a recording has a reading");
    double last = 0;
    for (std::size_t k = 0; k < 1000; ++k) {
      const device::ReadResult read = replay.read();
      const auto* reading = std::get_if<device::Reading>(&read);
      fuzz::require((reading != nullptr) == (k < left), "there are as many readings as it says");
      if (reading == nullptr) break;
      fuzz::require(k == 0 || reading->time >= last, "time does not go back");
      last = reading->time;
    }
  });
  return 0;
}
