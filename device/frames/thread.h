// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The frames of a device, in a thread of their own, which alone uses its link: in each a force is sent, and the device answers
// with a position. The servo loop's thread exchanges the latest of each with it, and neither waits for the other.

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "device/frame_samples.h"
#include "device/frame_times.h"
#include "device/frames/link.h"
#include "device/lasting_words.h"
#include "device/sent_forces.h"
#include "device/triple_buffer.h"
#include "forceshade/device.h"
#include "system/system.h"

namespace forceshade::device {

struct FrameSample {
  bool ready = false;  // forces that are ordered are sent
  // The words that the frames were given hold the reason; no sample follows, and zero was sent if possible.
  bool troubled = false;
  std::int64_t time = 0;  // system::now(), when the state came; 0: there was no frame
  FrameState state{.calibrated = false, .forces_on = false};
  Sent sent;
  std::optional<FrameTimes::Window> times = std::nullopt;  // of the last whole window
};

// The statistics of a run that is over.
struct FrameCount {
  std::size_t frames = 0, late = 0;  // late: more than a period after it was due
  double longest_trip = 0;           // ms, from sending a frame's force to its answer
  double largest_difference = 0;     // N, between the force that the device says it applied and what was sent
  bool says_force = false;           // true if it says one
};

class FrameThread {
 public:
  // The thread begins at once, with frames of this rate in Hz. Forces are sent after one window of good frames, of half a
  // second: calibrated, as near to the rate as the options say, with no gap longer than half the watchdog's timeout. trouble:
  // where it says why there was trouble. Link and words outlive it.
  FrameThread(FrameLink& link, const FramedOptions& options, double rate, LastingWords& trouble);
  ~FrameThread() { end(); }
  FrameThread(const FrameThread&) = delete;
  FrameThread& operator=(const FrameThread&) = delete;

  // Closes the link, and waits for that.
  void end() noexcept;
  // After end().
  const FrameCount& count() const noexcept { return count_; }

  FrameSamples<FrameSample> samples;
  TripleBuffer<ForceOrder> orders;

 private:
  void run() noexcept;
  void frame();
  void take(const FrameState& state, const Eigen::Vector3d& ordered, const Eigen::Vector3d& force);
  void note(const std::string& words) noexcept;
  bool is_good() const noexcept;

  FrameLink& link_;
  FramedOptions options_;
  double rate_;  // Hz
  LastingWords& trouble_;
  std::atomic<bool> ending_ = false;

  FrameSample sample_;
  SentForces sent_;
  SentShare share_;
  FrameTimes times_;
  FrameCount count_;
  system::Thread thread_;  // the last, so that all else is there when it begins
};

}  // namespace forceshade::device
