// SPDX-License-Identifier: BSD-3-Clause
#include "files/input_file.h"
#include "study/experiments/stimulus_list.h"
#include "tests/fuzz/input_file.h"

// The list of what a run rendered. A list that is read is written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "stimuli.jsonl");
  fuzz::read_or_refuse<Error>(file, [&] {
    const std::vector<experiments::ListedStimulus> read = experiments::read_stimuli(file);
    std::string again;
    for (const experiments::ListedStimulus& stimulus : read) again += experiments::line_of(stimulus);
    const std::string second = fuzz::file_of(again, "again.jsonl");
    fuzz::require(experiments::read_stimuli(second) == read, "stimuli read back as they were");
  });
  return 0;
}
