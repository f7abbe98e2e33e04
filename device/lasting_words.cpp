// SPDX-License-Identifier: BSD-3-Clause
#include "device/lasting_words.h"

#include <deque>
#include <mutex>

namespace forceshade::device {

LastingWords* room_for_words() {
  static std::mutex mutex;
  static std::deque<LastingWords> rooms;
  const std::lock_guard lock(mutex);
  return &rooms.emplace_back();
}

}  // namespace forceshade::device
