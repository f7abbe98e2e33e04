// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/trial_log.h"

#include <algorithm>
#include <cstdio>

#include "files/input_file.h"
#include "tests/fuzz/input_file.h"

// The input as it is, and with its lines' checksums made right, which no fuzzer would find.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string_view text = fuzz::text_of(data, size);
  std::string checked;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line(text.substr(at, end - at));
    const std::string body = line.substr(0, line.rfind(",\"crc\""));
    char sum[16];
    std::snprintf(sum, sizeof sum, "%08x", static_cast<unsigned>(experiments::crc32(body)));
    checked += body + ",\"crc\":\"" + sum + "\"}\n";
    at = end + 1;
  }
  for (const std::string_view each : {text, std::string_view(checked)}) {
    const std::string file = fuzz::file_of(each, "trials.jsonl");
    fuzz::read_or_refuse<Error>(file, [&] {
      const experiments::LogText log = experiments::read_log(file);
      std::string again;
      for (std::size_t i = 0; i < log.events.size(); ++i) again += experiments::line_of(log.events[i], i + 1);
      const std::string second = fuzz::file_of(again, "again.jsonl");
      fuzz::require(experiments::read_log(second).events == log.events, "events read back as they were");
    });
  }
  return 0;
}
