// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "study/experiments/results_csv.h"
#include "tests/fuzz/input_file.h"

// The input as matching.csv when its first byte is even, else as classification.csv. Its rows are written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  if (size == 0) return 0;
  const bool is_matching = data[0] % 2 == 0;
  const tests::TemporaryDirectory folder, again;
  const char* name = is_matching ? "matching.csv" : "classification.csv";
  const std::string file = folder.write(name, fuzz::text_of(data + 1, size - 1));
  fuzz::read_or_refuse<std::runtime_error>(file + ':', [&] {
    const experiments::Results read = experiments::read_results(folder.path());
    experiments::write_results(read, again.path());
    const experiments::Results same = experiments::read_results(again.path());
    fuzz::require(same.matching.size() == read.matching.size() && same.classification.size() == read.classification.size(),
                  "what is written is read again");
    for (std::size_t i = 0; i < read.matching.size(); ++i)
      fuzz::require(same.matching[i].participant == read.matching[i].participant &&
                        same.matching[i].final_radius == read.matching[i].final_radius,
                    "a trial is read as it was written");
  });
  return 0;
}
