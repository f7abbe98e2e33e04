// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a recording: one that is finished, one that was cut off, or one that is still being made.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "recorder/layout.h"
#include "recorder/recorder.h"

namespace forceshade::recorder {

// What the file held when it was opened. Nothing in it is changed, and nothing in it is trusted: a file that someone else made
// costs no more time and memory than a recording of its size.
class Recording {
 public:
  // Throws RecordingError when the file cannot be read, is no recording (also one with a table too many, a view or a trigger),
  // or is one of another format.
  explicit Recording(const std::string& path);

  const std::string& path() const noexcept { return database_.path(); }
  const Metadata& metadata() const noexcept { return metadata_; }

  // Whether the run came to its end and all its samples were pushed into the file or counted as lost.
  bool ended() const { return metadata_.contains("ended"); }

  // Whether there is a digest that covers the metadata. Recordings of format 2 have none: a change of their law or stiffness
  // would not be seen.
  bool has_digest() const { return metadata_.contains(kDigestKey); }

  // Why the metadata are not those that were written; empty if they are, or if there is no digest.
  const std::string& metadata_problem() const noexcept { return metadata_problem_; }

  // The extent by the table of chunks, without reading them; all zero if there is none. `missing` ticks were left out on the
  // way to the last; `repeated` samples are of ticks not after those of an earlier chunk. Throws RecordingError for a chunk
  // that cannot be: more samples than ticks, or a first tick after its last.
  struct Extent {
    std::uint64_t samples = 0, first_tick = 0, last_tick = 0, missing = 0, repeated = 0;
  };
  Extent extent();

  // Whether it has the columns from `shown` on; without them (before format 4) they are zero.
  bool has_all_columns() const noexcept { return sample_bytes_ == sizeof(device::Sample); }

  // Takes the samples in order, chunk by chunk. Throws RecordingError at the first chunk that is not as it was written.
  void for_each_chunk(const std::function<void(std::span<const device::Sample>)>& take);

 private:
  friend std::vector<std::string> problems_of(Recording& recording);
  void expect_tables_of_a_recording();
  void read_metadata();
  std::string words_of_cut();  // empty where the file has all of its pages

  Database database_;
  std::size_t sample_bytes_ = sizeof(device::Sample);  // in the file
  Metadata metadata_;
  std::string metadata_problem_;
};

// A text for whatever keeps the recording from being a whole run as it was written: SQLite's own integrity check, chunks that
// differ from their checksum, metadata that differ from theirs, missing ticks, a missing end. Empty if it is whole.
std::vector<std::string> problems_of(Recording& recording);

}  // namespace forceshade::recorder
