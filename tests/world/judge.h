// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rules that every step of every session keeps, whatever goes wrong. tests/world/rules.md lists them.

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "forceshade/servo_loop.h"
#include "tests/world/session.h"

namespace forceshade::world {

// An order of the loop is obeyed for so long, and a frame takes so long.
inline constexpr Ns kWatchdog = 25'000'000, kFrame = 1'000'000;
// From a frame's look at its order to the moment at which its force is sent.
inline constexpr Ns kSend = 50'000;

class Judge final : public device::SampleSink {
 public:
  Judge(World& world, Arm& arm);

  // At each step.
  void look();
  // Judges a session that is over; adds what only its whole shows.
  void conclude(Outcome& outcome);
  const std::vector<Violation>& violations() const noexcept { return violations_; }

  // Notes what the loop does with its device.
  void ordered(const Eigen::Vector3f& force);
  void read(const device::ReadResult& result);
  void woken(Ns frame);
  void push(const device::Sample& sample) noexcept override { samples_.push_back(sample); }

 private:
  void sent(const Arm::Sent& sent);
  void grown(const Eigen::Vector3d& force, Ns now);
  void violate(int rule, std::string words);

  World& world_;
  Arm& arm_;
  struct Order {
    Ns time;
    Eigen::Vector3d force;
  };
  std::vector<Order> orders_;
  std::vector<device::Sample> samples_;
  std::vector<Violation> violations_;
  Ns sent_before_ = 0;        // the frame before
  double share_before_ = 1;   // of its order, that it sent
  Ns unreached_ = 0;          // the last time at which nothing reached the arm
  Ns stood_still_ = 0;        // of the machine, up to the last order
  bool was_excused_ = false;  // its thread stood still between its look at the clock and its send
  bool obeyed_ = false;       // the state that the arm gave last
  double last_reading_ = -1;  // s
  bool held_button_ = true;
  Ns last_frame_ = 0;            // that the loop was woken for
  std::size_t read_ = 0;         // frames that it has read
  double without_watchdog_ = 0;  // ms
  Ns felt_until_ = 0;
};

// Hands everything on, and tells the judge.
class Watched final : public device::Device {
 public:
  Watched(std::unique_ptr<device::Device> device, Judge& judge) : device_(std::move(device)), judge_(judge) {}

  device::Capabilities capabilities() const noexcept override { return device_->capabilities(); }
  std::optional<device::Fault> start(double rate) noexcept override { return device_->start(rate); }
  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override {
    const std::int64_t frame = device_->wait_for_frame(deadline);
    judge_.woken(frame);
    return frame;
  }
  device::ReadResult read() noexcept override {
    device::ReadResult result = device_->read();
    judge_.read(result);
    return result;
  }
  void allow(const device::Allowance& allowance) noexcept override { device_->allow(allowance); }
  device::State state() const noexcept override { return device_->state(); }
  std::optional<device::Fault> command(const Eigen::Vector3f& force) noexcept override {
    judge_.ordered(force);
    return device_->command(force);
  }

 private:
  std::unique_ptr<device::Device> device_;
  Judge& judge_;
};

}  // namespace forceshade::world
