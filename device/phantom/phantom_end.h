// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ends the process that holds a PHANToM, whatever the cause: with zero force first, where that can still be done.

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "device/phantom/phantom_frames.h"
#include "device/triple_buffer.h"
#include "system/process.h"
#include "system/system.h"

namespace forceshade::device {

// Exit codes: the device was let go; it was not opened or started, as reported; a call of the driver's did not return.
inline constexpr int kLetGo = 0, kRefused = 1, kStuck = 2;

// One for a process, which lives as long as it.
class PhantomEnd final : public system::LastAct {
 public:
  // The frames that are to be closed before the process ends; null: none. They live as long as the process.
  void hold(PhantomFrames* frames) noexcept { frames_ = frames; }
  // Called in each frame by the driver's thread.
  void meet_driver() noexcept;
  // True once the force has ended. Called by any thread, and by a signal handler.
  bool let_go() noexcept override;
  bool interrupted() noexcept override;

 private:
  bool is_driver() const noexcept { return driver_ == system::this_thread(); }

  std::atomic<PhantomFrames*> frames_ = nullptr;
  std::atomic<int> driver_ = -1;  // the frames' own thread
  std::atomic<bool> interrupts_ = false;
};

// The message that the watch sends for the process before it ends it, where the driver's call does not return in time.
class LastWords {
 public:
  // Both are called by the thread that calls the driver.
  void say_unless_taken_back(const std::string& words, std::chrono::milliseconds timeout) {
    words_.publish({words, system::now() + system::in_ns(timeout)});
  }
  void take_back() { words_.publish({}); }
  // Called by the watch.
  std::optional<std::string> due() {
    const Words& latest = words_.latest();
    return system::now() > latest.due ? std::optional(latest.words) : std::nullopt;
  }

 private:
  struct Words {
    std::string words;
    std::int64_t due = system::kForever;
  };
  TripleBuffer<Words> words_;
};

// A thread that ends the process when it is alone or its last words are due, whatever the driver's calls are stuck in. All of
// them live as long as the process.
void watch_for_the_end(system::Packets& packets, PhantomEnd& end, LastWords& last_words);

}  // namespace forceshade::device
