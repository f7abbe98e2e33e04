// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom_end.h"

#include <utility>

#include "device/phantom/ending.h"
#include "device/phantom/phantom_shared.h"

namespace forceshade::device {
namespace {

constexpr std::chrono::milliseconds kWatch{10};
constexpr std::chrono::microseconds kBetweenLooks{500};

// Ends the process when the other one is gone, whatever the driver's calls are stuck in: where they let no zero be sent, at
// once, since the device's port is then closed, which is the last that can be done.
void watch(system::Packets& packets, PhantomEnd& end, LastWords& last_words) {
  std::optional<std::string> words;
  EndingSeen seen;
  do {
    words = last_words.due();
    seen = {.is_alone = packets.is_alone(system::now() + system::in_ns(kWatch)), .words_are_due = words.has_value()};
  } while (next(Ending::held, seen) == Ending::held);
  Ending state = end.let_go() ? Ending::released : Ending::over;
  for (const std::int64_t since = system::now(); (state = next(state, seen)) != Ending::over;) {
    system::sleep_for(kWatch);
    seen.is_late = system::now() - since >= system::in_ns(longest_of(state));
  }
  if (words) send_words(packets, PhantomMessage::Kind::failed, *words);
  system::end(kStuck);
}

}  // namespace

// A frame that does not end keeps the driver's locks, so that every call of another thread waits for it: then the frames' own
// thread, which has the locks, releases the device.
bool PhantomEnd::let_go() noexcept {
  PhantomFrames* const frames = frames_;
  if (!frames) return true;
  if (is_driver()) {
    frames->abandon();
    return true;
  }
  frames->close();
  std::int64_t since = system::now();
  for (Ending state = Ending::closing; state != Ending::released;) {
    const bool is_late = system::now() - since >= system::in_ns(longest_of(state));
    const Ending before = std::exchange(state, next(state, {.is_closed = frames->closed(), .is_late = is_late}));
    if (state == before) {
      system::sleep_for(kBetweenLooks);
    } else if (state == Ending::interrupting) {
      interrupts_ = true;
      system::interrupt(driver_);
      since = system::now();
    } else if (state == Ending::over) {
      return false;
    }
  }
  return true;
}

// On the frames' own thread. Back in the library it would run a frame of a device that is released.
bool PhantomEnd::interrupted() noexcept {
  const PhantomFrames* const frames = frames_;
  return is_driver() && interrupts_ && frames && !frames->closed() && let_go();
}

void PhantomEnd::meet_driver() noexcept {
  if (is_driver()) return;
  driver_ = system::this_thread();
  system::allow_interrupt();
}

void watch_for_the_end(system::Packets& packets, PhantomEnd& end, LastWords& last_words) {
  system::Thread("watch", [&] { watch(packets, end, last_words); }).leave();
}

}  // namespace forceshade::device
