// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sessions of the servo loop over an arm, in a simulated world, judged at every step by the rules that each session must keep.
// tests/world/rules.md lists the rules.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/frames/link.h"
#include "forceshade/servo_loop.h"
#include "tests/world/world.h"

namespace forceshade::world {

// An event of an arm in one of its frames, counted from 0.
struct Event {
  enum class Kind { late, garbage, jump, uncalibrated, forces_off, lets_go_of_button };
  int frame;
  Kind kind;
  double milliseconds = 0;  // for which it lasts; of `late`, by which the answer is late
};

class Arm;

// The parts of a session that do not depend on how an arm is driven.
struct Plan {
  Schedule schedule = {};
  double seconds = 0.6;  // of ticks; the hand touches the wall from 0.25 s on
  std::vector<Event> events = {};
  std::optional<Ns> own_watchdog = std::nullopt;  // of the arm: without a frame for this long it gives no force
  bool has_dead_man_button = false, follows_device = true;
  float stiffness = 0.5F;         // N/mm, of the wall
  bool may_be_lost = false;       // the arm under force, since what could end it is killed
  Ns longest_force = 27'000'000;  // after the loop's last order: the watchdog's time and two frames
  // Called at each step, before the rules are: places faults.
  std::function<void(Arm&)> at_step = {};
};

// An arm in a hand that goes its way whatever force it feels. It holds the last force that it was sent, by a clock of its own.
class Arm {
 public:
  explicit Arm(const Plan& plan) : plan_(plan) {}

  // Properties that differ between arms: the highest force in N, and how long it holds its force once its client is gone, where
  // it sees that at all.
  double peak = 3;
  std::optional<Ns> sees_end_after = std::nullopt;

  // A frame: this force from now on, and the state. Takes the time of the answer.
  device::FrameState frame(const Eigen::Vector3d& force);
  // The parts of a frame, for arms that are driven otherwise: its position, which push() measures where look() has not; the
  // force; and the state.
  void look();
  void push(const Eigen::Vector3d& force);
  device::FrameState state() const;
  void answered() { sent_.back().answered = current()->now(); }
  void close();
  // Once more, after it was closed.
  void open() noexcept;
  // The process that drives it is gone, as the arm sees it.
  void lose_client();

  // Its condition, beside the events.
  bool is_calibrated = true, has_forces_on = true;
  // Nothing that its client does reaches it any more.
  bool is_out_of_reach = false;
  bool can_be_reached() const noexcept { return !is_out_of_reach && !lost_at_; }
  void jump() { offset_ += 10; }

  Eigen::Vector3d felt() const noexcept;
  // The last moment, by the arm's clock and up to now, at which the force that was sent last is felt; 0: it is zero.
  Ns felt_until() const noexcept;
  bool is_closed() const noexcept { return closed_at_.has_value(); }
  const Event* event_at(int frame, Event::Kind kind) const noexcept;
  int frames() const noexcept { return static_cast<int>(sent_.size()); }
  // The frame in which a position was measured.
  static std::size_t frame_of(double y) noexcept { return static_cast<std::size_t>(std::lround(y * kFramesInMillimetre)); }

  struct Sent {
    Ns time;  // by the arm's clock
    Eigen::Vector3d force, position;
    bool obeys;       // it is calibrated and its forces are on
    Ns answered = 0;  // by the machine's clock; 0: not yet
  };
  const std::vector<Sent>& sent() const noexcept { return sent_; }
  const Plan& plan() const noexcept { return plan_; }
  double work() const noexcept { return most_work_; }  // mJ: the most that the hand had been given beyond what it put in

  // Called when a force has been sent, and when something follows the end.
  std::function<void(const Sent&)> on_sent;
  std::function<void(const char*)> on_misuse;
  // Called when the process that drives it is gone, of an arm that sees that.
  std::function<void()> on_lost;

 private:
  static constexpr double kFramesInMillimetre = 1024;

  const Plan& plan_;
  std::vector<Sent> sent_;
  std::optional<Sent> next_;  // measured, and not sent yet
  double work_ = 0, most_work_ = 0;
  std::optional<Ns> closed_at_, lost_at_;
  double offset_ = 0;  // mm, after a jump
};

// A rule that a session broke, and how.
struct Violation {
  int rule;
  std::string words;
};

struct Outcome {
  std::vector<Violation> violations;
  World::End end = World::End::over;
  device::ServoResult result;                     // if the loop was not killed
  std::string refused;                            // why the device was not opened
  std::optional<int> driver_exit = std::nullopt;  // of the process of a PHANToM's driver
  std::vector<Entry> decisions;
  std::size_t frames = 0;
  std::size_t repeated = 0, skipped = 0;  // positions, between the first that the loop used and the last
  std::size_t one_later = 0, pushed = 0;  // forces that were ordered; those of them that the frame after their position sent
  double peak = 0;                        // N, felt
  Ns lasted = 0;                          // in the world
  long steps = 0;
  std::uint64_t digest = 0;     // of all that happened
  double without_watchdog = 0;  // ms, from the loop's last order, where only the arm itself could have ended its force
  Ns felt_until = 0;            // by the arm's clock
  bool stays = false;           // the force is felt at the end, and nothing will end it
  std::string words() const;    // of the end
};

// Opens an arm: makes the device whose frames are the arm's.
using Open = std::function<std::unique_ptr<device::Device>(Arm&)>;

// One session, in a world of its own.
Outcome session(const Plan& plan, const Open& open);

// The thread of a session's loop; that of its frames is named "frames".
inline constexpr int kLoop = 0;
// The thread of a third-party program that an arm is driven through. It is not of the process that may die.
inline constexpr const char* kPartner = "partner";
// The process of a PHANToM's driver, and its threads: the one that calls the driver, the watch, and the driver's own.
inline constexpr int kDriver = 1, kHost = 1, kWatch = 2, kScheduler = 3;

}  // namespace forceshade::world
