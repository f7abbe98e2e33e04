// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The samples of a device's frames, from the thread or process that makes them to the servo loop, which waits for the next
// one. Two processes may map it.

#include <Eigen/Core>
#include <cstdint>

#include "device/triple_buffer.h"
#include "forceshade/device.h"
#include "system/system.h"

namespace forceshade::device {

// Sample::time says when a sample was made (system::now()).
template <class Sample>
class FrameSamples {
 public:
  // Called by the maker of frames.
  void publish(const Sample& sample) noexcept {
    samples_.publish(sample);
    system::step();
    frames_.fetch_add(1, std::memory_order_release);
    system::wake(frames_);
  }

  // Both are called by the servo loop. TripleBuffer::latest().
  const Sample& latest() noexcept { return samples_.latest(); }

  // The time of the latest sample, once that is another time than `read`, or the deadline is over. A sample that was read,
  // though it was made after the last wait, is not waited for again.
  std::int64_t wait_for_another(std::int64_t read, std::int64_t deadline) noexcept {
    // The count first: a frame between the two is then not waited for.
    const std::uint32_t frames = frames_.load(std::memory_order_acquire);
    if (latest().time == read) system::wait_for_change(frames_, frames, deadline);
    return latest().time;
  }

 private:
  TripleBuffer<Sample> samples_;
  system::Number frames_ = 0;  // published
};

// The force that the servo loop orders from frames that run beside it.

struct ForceOrder {
  Eigen::Vector3d force{0, 0, 0};  // N
  std::int64_t time = 0;           // CLOCK_MONOTONIC, ns
  Allowance allowance;
};

}  // namespace forceshade::device
