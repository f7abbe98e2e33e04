// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device of DHD that is open: what it is, a frame of it, and its end. One thread calls all of it, since DHD keeps the last
// error for each thread, and perhaps the expert mode.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "device/dhd/dhd_library.h"
#include "device/frames/link.h"
#include "system/system.h"

namespace forceshade::device::dhd {

// The devices that DHD drives, and what is assumed of each: the vendor's library has no function for its limits.

struct Model {
  int type;  // as dhdGetSystemType() has it
  const char* name;
  float reach;             // mm, from the middle of the workspace
  float peak, continuous;  // N
  int buttons;
};

inline constexpr int kFalcon = 60;

// Null: a type of which nothing is known here.
const Model* model_of(int type) noexcept;

struct Identity {
  Model model;
  std::string name;    // as the vendor's library has it
  std::string serial;  // empty: a Falcon, which has none
  bool is_left_handed = false;
  std::optional<double> gripper;  // mm: how far it is open, of a device that has one
  bool has_watchdog = false;      // it accepted 31.875 ms
};

class Arm {
 public:
  // may_force: false: no function that could give a force is ever called.
  Arm(const Functions& functions, bool may_force) : dhd_(functions), may_force_(may_force) {}
  ~Arm() { close(); }
  Arm(const Arm&) = delete;
  Arm& operator=(const Arm&) = delete;

  // `which`: a serial number; "#" and an index from 0; or empty for the only device. Its forces are off afterwards. Throws
  // DeviceError.
  Identity open(const std::string& which);

  // Sends this force, in N and the axes of the laws, and brings the state. Forces are switched on by the first exchange of a
  // calibrated device, and sent once its status says that they are on. After `until` (system::now()) its force is old, and zero
  // is sent instead. Throws DeviceError.
  FrameState exchange(const Eigen::Vector3d& force, std::int64_t until = system::kForever);

  // Zero force, dhdStop, a tenth of a second, dhdClose.
  void close() noexcept;

  // Frames whose force the device shortened, since its motors were saturated; and frames with the position of the one before.
  std::size_t saturated() const noexcept { return saturated_; }
  std::size_t guarded() const noexcept { return guarded_; }

 private:
  int open_device(const std::string& which);
  int expect(int result, const char* what) const;
  void switch_on();
  void send(const Eigen::Vector3d& force, bool matters);
  FrameState state_at_position();

  Functions dhd_;
  bool may_force_;
  std::optional<Id> id_;  // none: it is not open
  double peak_ = 0;       // N
  enum class Output { off, switched_on, on } output_ = Output::off;
  std::int64_t switched_on_ = 0;  // system::now()
  std::size_t saturated_ = 0, guarded_ = 0;
};

// The number of devices that are connected, and of those that no other program has locked. Throws DeviceError.
struct Counts {
  int connected, available;
};
Counts counted(const Functions& functions);

}  // namespace forceshade::device::dhd
