// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A PHANToM that is not there, in a hand that is not there: what the servo loop commands moves it, and the hand gives way.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "device/sent_forces.h"
#include "device/simulated/model.h"
#include "device/simulated/plant.h"
#include "device/simulated/steering.h"
#include "forceshade/device.h"

namespace forceshade::device {

// A hand that follows an intention, shaken.
struct Operator {
  Grip grip;
  Intention intention;
  Tremor tremor;
  bool ends;  // true if the device has no more readings once the intention is over
};

// Its clock is the number of readings: each one moves the arm on by one period under the force last commanded, or, as on a
// real device, under the one before (`latency`). Nothing depends on the time of day, so a run can be repeated to the bit, but
// for the time at which a button is pressed.
// Each reading is a frame: it reports the force that has acted and, with latency, sends the one that acts from there on.
class Simulated final : public Device {
 public:
  struct Options {
    double step_rate = 20'000;  // Hz, at least: a period is cut into equal steps
    bool latency = true;        // of one sample
    Joints start{0, 0, 0};      // the start of an arm without a hand; in a hand it is where the hand is
    // Attendant::kButtons of them, which live as long as the device; null: it has no button.
    const std::atomic<std::uint16_t>* buttons = nullptr;
    // The source of the hand's target, instead of its intention; lives as long as the device. Null: the intention.
    Steering* steering = nullptr;
  };

  Simulated(const Model& model, std::optional<Operator> hand, const Options& options);
  Simulated(const Model& model, std::optional<Operator> hand) : Simulated(model, std::move(hand), Options{}) {}

  Capabilities capabilities() const noexcept override;

  // Refuses when the hand starts where the arm does not reach.
  std::optional<Fault> start(double rate) noexcept override;

  ReadResult read() noexcept override;

  void allow(const Allowance& allowance) noexcept override { sent_.allow(allowance); }

  // Refuses, and holds no force, when one is not finite.
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override;

  State state() const noexcept override;

  // The state that no encoder measures: the tip itself, mm in the laws' frame, and all that moves.
  Eigen::Vector3d tip() const noexcept;
  const Motion& motion() const noexcept { return motion_; }

 private:
  Target next_meant() noexcept;
  void send(const Eigen::Vector3d& force) noexcept;

  Model model_;
  std::optional<Operator> hand_;
  Options options_;
  Plant plant_;
  Motion motion_;
  Target meant_;       // as of the last reading
  double period_ = 0;  // s; 0 before start
  std::size_t readings_ = 0;
  Joints measured_{0, 0, 0};  // angles as the encoders have them
  SentForces sent_;
  Eigen::Vector3d commanded_{0, 0, 0};  // N, to be sent in the next frame, with latency
  Joints torque_{0, 0, 0};              // N·m, held until the next reading
  std::array<Heat, 3> heat_{};
};

// "", MODEL, MODEL:mouse or MODEL:RECORDING.csv. A recording is a hand's intention, with the columns of a replay's; without one
// the hand makes strokes, and with the word "mouse" it is open_mouse(). Its buttons are the attendant's. Throws Error,
// or Error for a recording that cannot be read.
std::unique_ptr<Device> open_simulated(const std::string& rest, Attendant& attendant);

// The same in a hand that means to be where the attendant steers it. model: as above. Throws Error for another model,
// and where the attendant steers nothing.
std::unique_ptr<Device> open_mouse(const std::string& model, Attendant& attendant);

}  // namespace forceshade::device
