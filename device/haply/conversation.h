// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Questions and answers over a connection that carries whole messages. Whoever moves them (haply_socket.h; in tests, a
// script) is a few lines; all that is decided is here, and no call takes longer than it was given.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace forceshade::device::haply {

struct Answer {
  // Late: none came in time; the next call goes on waiting for it. Closed: none will come, and why().
  enum class Kind { message, late, closed };
  Kind kind;
  std::string_view text;  // until the next call
};

class Conversation {
 public:
  using Time = std::chrono::nanoseconds;

  virtual ~Conversation() = default;

  // The next message.
  Answer receive(Time timeout);
  // Sends a message and waits for the next one. What came unasked before is counted and left out.
  Answer ask(std::string_view text, Time timeout);
  // The end that both sides know of.
  virtual void close(Time timeout) noexcept = 0;

  const std::string& why() const noexcept { return why_; }
  std::size_t unasked() const noexcept { return unasked_; }

 protected:
  // Events, reported by the class that moves messages. The text stays until no message is kept any more.
  void came(std::string_view message) noexcept { message_ = message; }
  bool keeps_message() const noexcept { return message_.has_value(); }
  void was_sent() noexcept { is_sending_ = false; }
  void was_closed(const std::string& why);
  bool is_closed() const noexcept { return !why_.empty(); }

 private:
  // Begins to send this; was_sent() follows.
  virtual void send(std::string_view text) = 0;
  // Waits until one of these has happened, or until then (system::now()); what is there already happens in any case. While a
  // message is kept, no other one comes.
  virtual void wait(std::int64_t until) = 0;

  Answer next(std::int64_t until);

  std::optional<std::string_view> message_;
  bool is_sending_ = false;
  std::string why_;
  std::size_t unasked_ = 0;
};

}  // namespace forceshade::device::haply
