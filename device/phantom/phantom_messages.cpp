// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom_messages.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdio>

namespace forceshade::device {

bool send_message(int socket, const PhantomMessage& message) noexcept {
  ssize_t sent = 0;
  do sent = ::send(socket, &message, sizeof message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(sizeof message);
}

bool send_words(int socket, PhantomMessage::Kind kind, const std::string& words) noexcept {
  PhantomMessage message{.kind = kind};
  std::snprintf(message.words.data(), message.words.size(), "%s", words.c_str());
  return send_message(socket, message);
}

Received receive_message(int socket, std::chrono::milliseconds timeout, PhantomMessage& message) noexcept {
  pollfd waiting{.fd = socket, .events = POLLIN, .revents = 0};
  if (::poll(&waiting, 1, static_cast<int>(timeout.count())) <= 0) return Received::nothing_yet;  // also where a signal came
  const ssize_t size = ::recv(socket, &message, sizeof message, 0);
  if (size == static_cast<ssize_t>(sizeof message)) return Received::message;
  return size < 0 && errno == EINTR ? Received::nothing_yet : Received::closed;
}

}  // namespace forceshade::device
