// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// trials.jsonl: one event a line, as JSON with a checksum, so that a line that a crash cut short is recognised.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "study/experiments/session.h"

namespace forceshade::experiments {

// The event as line `number` of a log, from 1, with its line feed. Numbers are written so that they read back as they were.
std::string line_of(const Event& event, std::size_t number);

struct LogText {
  std::vector<Event> events;
  std::size_t size = 0;  // bytes of the whole lines
  std::string note;      // that a torn last line was left out; empty where there was none
};

// Only the last line may be torn, because each is on the disk before the next is written: a torn one has no line feed or fails
// its checksum. Throws Error with file and line for every other line that is not what line_of() writes.
LogText read_log(const std::filesystem::path& file);

// CRC-32 of IEEE 802.3, as zlib and PNG use it.
std::uint32_t crc32(std::string_view bytes);

}  // namespace forceshade::experiments
