// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Passes values from one thread of the world to another, whole and in order.

#include <deque>
#include <optional>
#include <utility>

#include "system/system.h"

namespace forceshade::world {

template <class T>
class Channel {
 public:
  void send(T what) {
    system::step();
    said_.push_back(std::move(what));
    change();
  }
  void close() {
    is_closed_ = true;
    change();
  }
  bool is_closed() const noexcept { return is_closed_; }

  // None: nothing came until then, or it is closed.
  std::optional<T> receive(std::int64_t until) {
    for (;;) {
      system::step();
      const std::uint32_t seen = changes_;
      if (!said_.empty()) {
        T first = std::move(said_.front());
        said_.pop_front();
        return first;
      }
      if (is_closed_ || system::now() >= until) return std::nullopt;
      system::wait_for_change(changes_, seen, until);
    }
  }

 private:
  void change() {
    ++changes_;
    system::wake(changes_);
  }

  std::deque<T> said_;
  bool is_closed_ = false;
  system::Number changes_ = 0;
};

}  // namespace forceshade::world
