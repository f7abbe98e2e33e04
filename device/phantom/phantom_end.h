// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the process that holds a PHANToM ends, whatever ends it: with zero force first, where that can still be done.

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "device/phantom/phantom_frames.h"
#include "device/triple_buffer.h"
#include "system/system.h"

namespace forceshade::device {

// Exit codes: the device was let go; it was not opened or started, which was said; some call of the driver's did not return.
inline constexpr int kLetGo = 0, kRefused = 1, kStuck = 2;

// The time that the driver has to stop, after which the process ends in any case.
inline constexpr std::chrono::milliseconds kTimeToEnd{1000};

// Makes the forked process one of its own: nothing that is sent to a terminal's programs reaches it, no handler of the driver's
// is ever called, no file of the other process's stays open, and what a library prints goes to standard error. Before the
// library is loaded. The socket, which may have a new number.
int become_process_of_driver(int socket);

// A library that ends the process ends the force first. After the library has been loaded, so that this is called before its
// objects are destroyed.
void end_force_at_exit() noexcept;

// The frames that are to be closed before the process ends; null: none. They live as long as the process.
void hold_frames(PhantomFrames* frames) noexcept;
// Called in each frame by the driver's thread.
void meet_driver() noexcept;
// Whether the force has ended; by any thread, and by a signal handler.
bool let_go() noexcept;

// Whether the other process is gone, or has closed its end of the socket.
bool is_alone(int socket, pid_t parent) noexcept;

// What the watch says for the process, and ends it, where the driver's call does not return in time.
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

// A thread that ends the process when it is alone or its last words are due, whatever the driver's calls are stuck in. Both
// live as long as the process.
void watch_for_the_end(int socket, pid_t parent, LastWords& last_words);

}  // namespace forceshade::device
