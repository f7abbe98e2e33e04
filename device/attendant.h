// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The person who prepares a device: what a device has to say to them, and what it needs them to do.

#include <atomic>
#include <cstdint>
#include <string>

namespace forceshade::device {

class Steering;  // device/simulated/steering.h

// This one is nobody: hears nothing and does nothing.
class Attendant {
 public:
  virtual ~Attendant() = default;

  virtual void report(const std::string& words) noexcept { static_cast<void>(words); }

  // Shows what is to be done and waits. False if nobody did it.
  virtual bool did(const std::string& words) noexcept {
    static_cast<void>(words);
    return false;
  }

  // Whether they have given up waiting.
  virtual bool has_left() const noexcept { return false; }

  // Buttons for a device that has none of its own: bit k is set while they hold button k down. As long as they live; null if
  // they have none to offer.
  static constexpr int kButtons = 2;  // as many as the stylus of a Touch has
  virtual const std::atomic<std::uint16_t>* buttons() noexcept { return nullptr; }

  // Where they mean a simulated hand to be, with a mouse for instance. As long as they live; null if they steer nothing.
  virtual Steering* steering() noexcept { return nullptr; }
};

}  // namespace forceshade::device
