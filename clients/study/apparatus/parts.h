// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run in several recordings, one after the other: a file for each trial of a session.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "forceshade/recording.h"
#include "system/system.h"

namespace forceshade::apparatus {

// Each tick is in exactly one part. Every part counts its ticks from 0, so that each is a whole recording by
// itself; `part` in its metadata (from 1) says its place in the run. A Recorder writes each, with all that it promises.
class Parts final : public device::SampleSink {
 public:
  explicit Parts(const recorder::Recorder::Options& options);
  // Without end() before, the last part stays marked as cut off.
  ~Parts() override;

  // Called by one thread: ticks go to this new file from now on, and the part before is closed meanwhile. Before the first
  // call ticks are dropped. Throws Error where the file cannot be made, and then the part before goes on; and where
  // the one before that has lost ticks.
  void begin(const std::string& path, recorder::Metadata metadata);

  // Called by the same thread, when nothing more is pushed. Throws Error where a part has lost ticks.
  void end(const std::string& end_reason);

  // True if the disk refused the current part's ticks at the last try.
  bool failing() const noexcept;

  // Called by the loop: neither waits nor allocates. It looks at most twice for where ticks go.
  void push(const device::Sample& sample) noexcept override;

 private:
  struct Part;
  void close(std::unique_ptr<Part> part, const std::string& why);
  void expect_closed();

  recorder::Recorder::Options options_;
  std::unique_ptr<Part> part_;
  std::atomic<Part*> current_ = nullptr, in_use_ = nullptr;  // the second: by the loop, just now
  int number_ = 0;
  std::string lost_;        // by the part that was closed last, in words
  system::Thread closing_;  // writes them
};

}  // namespace forceshade::apparatus
