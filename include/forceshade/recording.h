// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recordings of runs: every tick of a run in a file that survives a crash, read again, checked, and exported. The library is
// forceshade::recorder, of the component run; it needs SQLite and OpenSSL.
//
//   recorder::Recording recording("run.fsr");
//   for (const std::string& problem : recorder::problems_of(recording)) std::puts(problem.c_str());
//   double peak = 0;  // N, along z
//   recording.for_each_chunk([&](std::span<const device::Sample> samples) {
//     for (const device::Sample& sample : samples) peak = std::max(peak, double{sample.force[2]});
//   });
//   recorder::export_csv(recording, "run.csv");
//
// The units are those of device::Sample in servo_loop.h: mm, N, mJ, ns. The format: docs/recording.md.
//
// Errors: a file that cannot be read or written is a thrown Error.
//
// Threads: an object belongs to one thread at a time; Recorder has a thread of its own that writes.
//
// Not promised: that a recording was not changed on purpose: its checksums protect against mistakes, not against forgery.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "forceshade/error.h"
#include "forceshade/servo_loop.h"

namespace forceshade::recorder {

using Metadata = std::map<std::string, std::string>;

// Writes down every tick of a run while it runs, so that a crash costs its last moments and not the run.
//
// push() puts the sample into a lock-free ring; a thread of the recorder's own moves the ring into the file. One thread may
// push. What a kill or a failing disk can cost is in docs/recording.md.
class Recorder final : public device::SampleSink {
 public:
  struct Options {
    std::size_t ring = std::size_t{1} << 16;  // samples: 65 s at 1 kHz, 6.5 s at 10 kHz, 8 MB
    std::chrono::milliseconds interval{25};   // from ring to file
    bool waits = false;                       // for the disk to make room, when the ring is full; not for a run with deadlines
  };

  struct Result {
    std::uint64_t written = 0;
    std::uint64_t lost = 0;  // pushed while the ring was full, or not taken by the disk until the end
    std::string error;       // why the disk did not take them; empty if it did
  };

  // Makes the file, beside which SQLite keeps PATH-wal and PATH-shm until it is closed. Takes the metadata and adds `started`
  // (UTC) and `layout`. Throws Error, also when the file exists: a recording is never overwritten.
  Recorder(const std::string& path, Metadata metadata, const Options& options);
  Recorder(const std::string& path, Metadata metadata) : Recorder(path, std::move(metadata), Options{}) {}

  // Without close() before, the recording stays marked as cut off.
  ~Recorder() override;

  void push(const device::Sample& sample) noexcept override;

  // True if the disk refused at the last try. The recorder tries on, and nothing is lost if it succeeds before the ring is
  // full.
  bool failing() const noexcept;

  // Call once, when nothing more is pushed: writes what is left and, if all of it could be, that the run is over and why.
  Result close(const std::string& end_reason);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

class Database;  // run/recorder/sqlite.h

// Reads a recording: one that is finished, one that was cut off, or one that is still being made. It holds what the file held
// when it was opened. Nothing in it is changed, and nothing in it is trusted: a file that someone else made costs no more time
// and memory than a recording of its size.
class Recording {
 public:
  // Throws Error when the file cannot be read, is no recording (also one with a table too many, a view or a trigger),
  // or is one of another format.
  explicit Recording(const std::string& path);
  ~Recording();
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;

  const std::string& path() const noexcept;
  const Metadata& metadata() const noexcept { return metadata_; }

  // True if the run came to its end and all its samples were pushed into the file or counted as lost.
  bool ended() const { return metadata_.contains("ended"); }

  // True if a digest covers the metadata. Recordings of format 2 have none: a change of their law or stiffness
  // would not be seen.
  bool has_digest() const;

  // The reason why the metadata are not those that were written; empty if they are, or if there is no digest.
  const std::string& metadata_problem() const noexcept { return metadata_problem_; }

  // The extent by the table of chunks, without reading them; all zero without a table. `missing` ticks were left out on the
  // way to the last; `repeated` samples are of ticks not after those of an earlier chunk. Throws Error for a chunk
  // that cannot be: more samples than ticks, or a first tick after its last.
  struct Extent {
    std::uint64_t samples = 0, first_tick = 0, last_tick = 0, missing = 0, repeated = 0;
  };
  Extent extent();

  // True if it has the columns from `shown` on; without them (before format 4) they are zero.
  bool has_all_columns() const noexcept;

  // Takes the samples in order, chunk by chunk. Throws Error at the first chunk that is not as it was written.
  void for_each_chunk(const std::function<void(std::span<const device::Sample>)>& take);

 private:
  friend std::vector<std::string> problems_of(Recording& recording);
  void expect_tables_of_a_recording();
  void read_metadata();
  std::string words_of_cut();  // empty where the file has all of its pages

  std::unique_ptr<Database> database_;
  std::size_t sample_bytes_ = sizeof(device::Sample);  // in the file
  Metadata metadata_;
  std::string metadata_problem_;
};

// A text for whatever keeps the recording from being a whole run as it was written: SQLite's own integrity check, chunks that
// differ from their checksum, metadata that differ from theirs, missing ticks, a missing end. Empty if it is whole.
std::vector<std::string> problems_of(Recording& recording);

// A recording as files that other programs read.

// One row a sample, times in seconds and µs. Numbers in the shortest form that reads back the same; an encoder that the device
// has not is empty. Both throw Error, also for a damaged recording, and then leave no file.
void export_csv(Recording& recording, const std::string& path);

// NPY 1.0, a structured array: numpy.load(path)["x_mm"]. The very bytes of the recording.
void export_npy(Recording& recording, const std::string& path);

// Writes the format that the end of the path names: .npy or .NPY, else CSV.
void export_table(Recording& recording, const std::string& path);

}  // namespace forceshade::recorder
