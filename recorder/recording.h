// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a recording: one that is finished, one that was cut off, or one that is still being made.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "forceshade/recorder/recorder.h"

namespace forceshade::recorder {

// What the file held when it was opened. Nothing in it is changed.
class Recording {
 public:
  // Throws RecordingError when the file cannot be read, is no recording, or is one of another format.
  explicit Recording(const std::string& path);

  const std::string& path() const noexcept { return database_.path(); }
  const Metadata& metadata() const noexcept { return metadata_; }

  // Whether the run came to its end and all its samples were pushed into the file or counted as lost.
  bool ended() const { return metadata_.contains("ended"); }

  // From the table of chunks, without looking into them; all zero if there is none.
  struct Extent {
    std::uint64_t samples = 0, first_tick = 0, last_tick = 0;
    std::uint64_t missing() const { return samples == 0 ? 0 : last_tick - first_tick + 1 - samples; }
  };
  Extent extent();

  // In order, chunk by chunk. Throws RecordingError at the first chunk that is not as it was written.
  void for_each_chunk(const std::function<void(std::span<const device::Sample>)>& take);

 private:
  friend std::vector<std::string> problems_of(Recording& recording);
  Database database_;
  Metadata metadata_;
};

// In words, whatever keeps the recording from being a whole run as it was written: SQLite's own integrity check, chunks that
// differ from their checksum, missing ticks, a missing end. Empty if it is whole.
std::vector<std::string> problems_of(Recording& recording);

}  // namespace forceshade::recorder
