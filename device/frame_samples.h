// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The samples of a device's frames, from the thread or process that makes them to the servo loop, which waits for the next
// one. Two processes may map it.

#include "device/futex.h"
#include "device/triple_buffer.h"

namespace forceshade::device {

// Sample::time says when a sample was made (monotonic_now()).
template <class Sample>
class FrameSamples {
 public:
  // Called by whoever makes frames.
  void publish(const Sample& sample) noexcept {
    samples_.publish(sample);
    frames_.fetch_add(1, std::memory_order_release);
    wake(frames_);
  }

  // Both are called by the servo loop. TripleBuffer::latest().
  const Sample& latest() noexcept { return samples_.latest(); }

  // When the latest sample was made, once that is another time than `read`, or the deadline is over. A sample that was read,
  // though it was made after the last wait, is not waited for again.
  std::int64_t wait_for_another(std::int64_t read, std::int64_t deadline) noexcept {
    // The count first: a frame between the two is then not waited for.
    const std::uint32_t frames = frames_.load(std::memory_order_acquire);
    if (latest().time == read) wait_for_change(frames_, frames, deadline);
    return latest().time;
  }

 private:
  TripleBuffer<Sample> samples_;
  std::atomic<std::uint32_t> frames_ = 0;  // published; a futex
};

}  // namespace forceshade::device
