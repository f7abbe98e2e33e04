// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages between the two processes of a PHANToM, over a socket that keeps them whole.

#include <chrono>
#include <optional>
#include <string>

#include "device/phantom/phantom_shared.h"

namespace forceshade::device {

// False if the other end is closed.
bool send_message(int socket, const PhantomMessage& message) noexcept;
bool send_words(int socket, PhantomMessage::Kind kind, const std::string& words) noexcept;

enum class Received { message, nothing_yet, closed };

// Waits no longer than this; negative: for ever.
Received receive_message(int socket, std::chrono::milliseconds timeout, PhantomMessage& message) noexcept;

}  // namespace forceshade::device
