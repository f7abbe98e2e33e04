// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The frames of an Inverse3, in a thread of their own, which alone uses the socket: in each a force is sent, and the service
// answers with a position. The servo loop's thread exchanges the latest of each with it, and neither waits for the other.

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>

#include "device/force_order.h"
#include "device/frame_samples.h"
#include "device/frame_times.h"
#include "device/haply/haply_messages.h"
#include "device/haply/haply_socket.h"
#include "device/lasting_words.h"
#include "device/sent_forces.h"
#include "device/triple_buffer.h"
#include "forceshade/device.h"

namespace forceshade::device::haply {

struct FrameSettings {
  Version version;
  std::string id;     // of the arm
  bool force = true;  // false: no command that gives one is ever sent
  std::chrono::nanoseconds watchdog_timeout{25'000'000};
  double rate = 1000;  // Hz
  // Forces are sent after one window of good frames: calibrated, this near to the rate, no longer gap.
  int window = 500;
  double rate_tolerance = 0.05;
  double longest_gap = 0.0125;  // s
};

struct FrameSample {
  bool ready = false;  // forces that are ordered are sent
  bool troubled =
      false;  // why, is in the words that the frames were given; none follows, and zero was sent if that was possible
  std::int64_t time = 0;              // CLOCK_MONOTONIC, ns, when the position came; 0: there was no frame
  Eigen::Vector3d position{0, 0, 0};  // mm
  std::uint16_t buttons = 0;
  bool calibrated = false, forces_on = false;
  Sent sent;
  std::optional<FrameTimes::Window> times = std::nullopt;  // of the last whole window
};

// What was seen of a run, once it is over.
struct FrameCount {
  std::size_t frames = 0, late = 0, unasked = 0;  // late: more than a period after it was due
  double longest_trip = 0;                        // ms, from a frame's message to its answer
  double largest_difference = 0;                  // N, between the force that the service says it applies and what was sent
  bool says_force = false;                        // whether it says one
};

class FrameThread {
 public:
  // The thread begins at once. Words: where it says why there was trouble.
  FrameThread(std::unique_ptr<Socket> socket, const FrameSettings& settings, LastingWords& trouble);
  ~FrameThread() { end(); }
  FrameThread(const FrameThread&) = delete;
  FrameThread& operator=(const FrameThread&) = delete;

  // Sends zero, ends the session, and waits for both a moment.
  void end() noexcept;
  // After end().
  const FrameCount& count() const noexcept { return count_; }

  FrameSamples<FrameSample> samples;
  TripleBuffer<ForceOrder> orders;

 private:
  void run() noexcept;
  void frame();
  void take(const Message& message, const Eigen::Vector3d& force);
  void send_zero() noexcept;
  void publish() noexcept;
  void note(const std::string& words) noexcept;
  bool is_good() const noexcept;

  std::unique_ptr<Socket> socket_;
  FrameSettings settings_;
  Frames messages_;
  LastingWords& trouble_;
  std::int64_t period_;  // ns
  std::atomic<bool> ending_ = false;

  FrameSample sample_;
  SentForces sent_;
  FrameTimes times_;
  FrameCount count_;
  bool is_closed_ = false;
  std::thread thread_;  // the last, so that all else is there when it begins
};

}  // namespace forceshade::device::haply
