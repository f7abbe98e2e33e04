// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vendor's library of a PHANToM in the simulated world: over an arm of a session, with a scheduler's thread of its own. It
// does what it is told by the orders of the stand-in that stands in its place in real time, and what its caller should not have
// done is a misuse of the arm. Orders of signals, crashes and output are for the stand-in alone.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "device/phantom/hdapi_library.h"
#include "device/phantom/phantom.h"
#include "system/system.h"
#include "tests/device/stand_in_hd/orders.h"
#include "tests/world/session.h"

namespace forceshade::world {

class Hd {
 public:
  explicit Hd(Arm& arm);
  ~Hd();
  Hd(const Hd&) = delete;
  Hd& operator=(const Hd&) = delete;

  // The one that there is, and the functions that call it.
  static Hd& current() noexcept;
  static const device::hdapi::Functions& functions();

  // From now on.
  void tell(const stand_in_hd::Orders& orders);
  const stand_in_hd::Orders& orders() const noexcept { return orders_; }

  struct Frame {
    Eigen::Vector3d position, force;  // mm, N, in the driver's frame
  };
  struct Seen {
    std::optional<std::string> name;
    bool initialised = false, scheduler = false, output = false;
    int updates = 0;
    double rate = 1000;
    std::vector<Frame> frames;
  };
  const Seen& seen() const noexcept { return seen_; }

 private:
  friend struct HdFunctions;
  void run();
  void tick();

  Arm& arm_;
  stand_in_hd::Orders orders_;
  Seen seen_;
  std::vector<device::hdapi::HDErrorInfo> errors_;
  std::set<std::pair<std::string, device::hdapi::HDerror>> reported_;  // in frames, since orders were given
  std::map<device::hdapi::HDSchedulerHandle, std::pair<device::hdapi::HDCallback, void*>> callbacks_;
  system::Thread scheduler_;
  int scheduler_id_ = -1;
  bool stop_ = false, in_frame_ = false, calibrated_ = false, has_position_ = false;
  system::Number ticking_ = 0;  // 1: a callback runs, and other threads' calls wait
  device::FrameState state_;
  Eigen::Vector3d position_{0, 0, 0}, force_{0, 0, 0};  // in the driver's frame
};

// The attendant of a session's PHANToM; a test tells it what to do.
struct Attends final : device::Attendant {
  void report(const std::string& words) noexcept override {
    heard += words + "\n";
    if (on_words) on_words(words);
  }
  bool did(const std::string& words) noexcept override;
  bool has_left() const noexcept override { return leaves; }

  std::string heard;
  std::vector<std::string> asked;
  bool does = false, leaves = false;
  Ns patience = 0;  // for so long it thinks about what it is asked, unless it does that or leaves
  std::function<void(const std::string&)> on_words;
};

// A device of a session: a Phantom over a driver and an attendant of its own, which the test may change before.
struct OpenPhantom {
  stand_in_hd::Orders orders = {.peak_force = 3.0};
  device::PhantomOptions options = {};
  std::function<void(Attends&)> attended = nullptr;

  std::unique_ptr<device::Device> operator()(Arm& arm) const;
  // The attendant of the session that runs, or was the last.
  static Attends& attends() noexcept;
};

}  // namespace forceshade::world
