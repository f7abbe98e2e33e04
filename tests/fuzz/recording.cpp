// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/recording.h"

#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "run.fsr");
  fuzz::read_or_refuse<Error>(file + ": ", [&] {
    recorder::Recording recording(file);
    const std::vector<std::string> problems = problems_of(recording);
    const recorder::Recording::Extent extent = recording.extent();
    fuzz::require(extent.missing <= extent.last_tick, "no more ticks are missing than there are");
    std::uint64_t samples = 0;
    recording.for_each_chunk([&](std::span<const device::Sample> chunk) { samples += chunk.size(); });
    fuzz::require(samples == extent.samples, "there are as many samples as the chunks say");
    fuzz::require(!problems.empty() || (extent.missing == 0 && extent.repeated == 0), "a whole recording has every tick once");
  });
  return 0;
}
