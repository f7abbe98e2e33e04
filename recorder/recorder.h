// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes down every tick of a run while it runs, so that a crash costs its last moments and not the run.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "device/sample.h"
#include "recorder/sqlite.h"

namespace forceshade::recorder {

using Metadata = std::map<std::string, std::string>;

// push() puts the sample into a lock-free ring; a thread of the recorder's own moves the ring into the file. One thread may
// push. What a kill or a failing disk can cost is in docs/recording.md.
class Recorder final : public device::SampleSink {
 public:
  struct Options {
    std::size_t ring = std::size_t{1} << 16;  // samples: 65 s at 1 kHz, 6.5 s at 10 kHz, 8 MB
    std::chrono::milliseconds interval{25};   // from ring to file
    bool waits = false;  // when the ring is full, for the disk to make room, if it does; not for a run with deadlines
  };

  struct Result {
    std::uint64_t written = 0;
    std::uint64_t lost = 0;  // pushed while the ring was full, or not taken by the disk until the end
    std::string error;       // why the disk did not take them; empty if it did
  };

  // Makes the file, beside which SQLite keeps PATH-wal and PATH-shm until it is closed. Takes the metadata and adds `started`
  // (UTC) and `layout`. Throws RecordingError, also when the file exists: a recording is never overwritten.
  Recorder(const std::string& path, Metadata metadata, const Options& options);
  Recorder(const std::string& path, Metadata metadata) : Recorder(path, std::move(metadata), Options{}) {}

  // Without close() before, the recording stays marked as cut off.
  ~Recorder() override;

  void push(const device::Sample& sample) noexcept override;

  // Whether the disk refused at the last try. The recorder tries on, and nothing is lost if it succeeds before the ring is
  // full.
  bool failing() const noexcept;

  // Call once, when nothing more is pushed: writes what is left and, if all of it could be, that the run is over and why.
  Result close(const std::string& end_reason);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace forceshade::recorder
