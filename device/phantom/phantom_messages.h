// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages between the two processes of a PHANToM.

#include <cstdio>
#include <string>

#include "device/phantom/phantom_shared.h"
#include "system/process.h"

namespace forceshade::device {

// False if the other end is closed.
inline bool send_message(system::Packets& packets, const PhantomMessage& message) noexcept {
  return packets.send(&message, sizeof message);
}

inline bool send_words(system::Packets& packets, PhantomMessage::Kind kind, const std::string& words) noexcept {
  PhantomMessage message{.kind = kind};
  std::snprintf(message.words.data(), message.words.size(), "%s", words.c_str());
  return send_message(packets, message);
}

}  // namespace forceshade::device
