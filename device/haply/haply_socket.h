// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A WebSocket, and HTTP beside it, where no call takes longer than it was given.

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

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

struct Answer {
  // Late: none came in time; the next call goes on waiting for it. Closed: none will come, and why().
  enum class Kind { message, late, closed };
  Kind kind;
  std::string_view text;  // until the next call
};

class Socket {
 public:
  using Time = std::chrono::nanoseconds;

  // Throws std::runtime_error where nobody listens, or what listens is no WebSocket.
  Socket(const Address& address, Time timeout);
  ~Socket();
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  // The next message.
  Answer receive(Time timeout);
  // Sends a message and waits for the next one. What came unasked before is counted and left out.
  Answer ask(std::string_view text, Time timeout);
  // The end that both sides know of.
  void close(Time timeout) noexcept;

  const std::string& why() const noexcept;
  std::size_t unasked() const noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

// The body of the answer. Throws std::runtime_error where there is none, or its status is not 200.
std::string http_get(const Address& address, const std::string& target, Socket::Time timeout);

}  // namespace forceshade::device::haply
