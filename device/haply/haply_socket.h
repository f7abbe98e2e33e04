// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A WebSocket, and HTTP beside it, where no call takes longer than it was given.

#include <memory>
#include <string>
#include <string_view>

#include "device/haply/conversation.h"

namespace forceshade::device::haply {

// HOST:PORT, or [HOST]:PORT for an address with colons.
struct Address {
  std::string host;
  int port = 0;

  std::string words() const {
    return (host.find(':') == std::string::npos ? host : '[' + host + ']') + ':' + std::to_string(port);
  }
};

// Throws std::invalid_argument.
Address address_of(const std::string& text);

class Socket final : public Conversation {
 public:
  // Throws std::runtime_error where no WebSocket listens.
  Socket(const Address& address, Time timeout);
  ~Socket() override;
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void close(Time timeout) noexcept override;

 private:
  void send(std::string_view text) override;
  void wait(std::int64_t until) override;

  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

// The body of the answer. Throws std::runtime_error where no answer comes, or its status is not 200.
std::string http_get(const Address& address, const std::string& target, Socket::Time timeout);

}  // namespace forceshade::device::haply
