// SPDX-License-Identifier: BSD-3-Clause
// A device of Force Dimension in the simulated world: the vendor's library as a table of functions over the arm of a session.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/dhd/dhd.h"
#include "device/dhd/dhd_library.h"
#include "system/system.h"
#include "tests/world/arms.h"

namespace forceshade::world {
namespace {

constexpr Ns kMillisecond = 1'000'000;

// The one library of the session that runs. A fault sets what goes wrong in it.
struct Dhd {
  Arm* arm = nullptr;
  // Its next call fails, returns after so long, or never does.
  bool fails = false, never_returns = false;
  Ns late = 0;
  double position = 0;      // m, added to each
  int force_off_cause = 0;  // why the forces were switched off
  std::array<int, 17> status{1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};

  void switch_off(int cause) {
    force_off_cause = cause;
    status[device::dhd::kForce] = 0;
    arm->has_forces_on = false;
  }
  void lose_calibration() {
    status[device::dhd::kReset] = 1;
    arm->is_calibrated = false;
  }
};
Dhd dhd;

using device::dhd::Functions;
using device::dhd::Id;

constexpr Ns kCall = 10'000;
constexpr int kOmega3 = 33, kFailed = 2;
int last_error = 0;
bool is_sent = false;  // a force, in this frame

void take_time() {
  const Ns late = std::exchange(dhd.late, 0);
  dhd.arm->is_out_of_reach = late > 0;
  system::sleep_until(system::now() + kCall + late);
  if (late > 0) system::step();  // the last one at which nothing reaches the arm
  dhd.arm->is_out_of_reach = false;
}

// Begins every call: another thread may go on, and a fault happens. Returns 0 or -1.
int begun() {
  system::step();
  if (std::exchange(dhd.never_returns, false)) {
    dhd.arm->is_out_of_reach = true;
    const system::Number nothing = 0;
    for (;;) system::wait_for_change(nothing, 0, system::kForever);
  }
  if (!std::exchange(dhd.fails, false)) return 0;
  last_error = kFailed;
  return -1;
}

int called() {
  const int result = begun();
  take_time();
  return result;
}

int get_status(int* status, Id) {
  if (called() != 0) return -1;
  is_sent = false;
  std::ranges::copy(dhd.status, status);
  status[device::dhd::kForceOffCause] = dhd.force_off_cause;
  return 0;
}

// The laws: x right, y away from the user, z up. DHD: x towards the operator, y to the operator's right, z up.
// The force acts at once, however late the call returns.
int set_force(double x, double y, double z, Id) {
  if (begun() != 0) return -1;
  if (dhd.status[device::dhd::kForce] == 0) {
    last_error = device::dhd::kNotEnabled;
    return -1;
  }
  is_sent = true;
  dhd.arm->push({y, -x, z});
  take_time();
  return 0;
}

int get_position(double* x, double* y, double* z, Id) {
  if (called() != 0) return -1;
  if (!is_sent) dhd.arm->push({0, 0, 0});
  const Eigen::Vector3d position = dhd.arm->state().position / 1000;
  *x = -position.y() + dhd.position;
  *y = position.x();
  *z = position.z();
  return 0;
}

unsigned get_buttons(Id) {
  called();
  const unsigned buttons = dhd.arm->state().buttons;
  dhd.arm->answered();
  return buttons;
}

int enable_force(unsigned char on, Id) {
  if (called() != 0) return -1;
  dhd.status[device::dhd::kForce] = on;
  dhd.arm->has_forces_on = on != 0;
  return 0;
}

int stop(Id) {
  dhd.switch_off(4);
  return 0;
}

Functions functions() {
  Functions its{};
  its.dhdGetDeviceCount = [] { return 1; };
  its.dhdGetAvailableCount = [] { return 1; };
  its.dhdOpenID = [](Id) { return called(); };
  its.dhdClose = [](Id) { return dhd.arm->close(), 0; };
  its.dhdStop = stop;
  its.dhdGetSerialNumber = [](unsigned short* serial, Id) { return *serial = 1234, called(); };
  its.dhdGetSystemType = [](Id) { return kOmega3; };
  its.dhdGetSystemName = [](Id) { return "omega.3"; };
  its.dhdIsLeftHanded = [](Id) { return false; };
  its.dhdHasGripper = [](Id) { return false; };
  its.dhdGetStatus = get_status;
  its.dhdEnableForce = enable_force;
  its.dhdSetBrakes = [](int, Id) { return called(); };
  its.dhdSetGravityCompensation = [](int, Id) { return called(); };
  its.dhdSetMaxForce = [](double, Id) { return called(); };
  its.dhdGetPosition = get_position;
  its.dhdSetForce = set_force;
  its.dhdGetButtonMask = get_buttons;
  its.dhdEnableExpertMode = called;
  its.dhdSetWatchdog = [](unsigned char, Id) { return called(); };
  its.dhdErrorGetLast = [] { return last_error; };
  its.dhdErrorGetLastStr = [] { return "its words"; };
  return its;
}

std::unique_ptr<device::Device> open_dhd(Arm& arm) {
  static device::Attendant nobody;
  dhd = {.arm = &arm};
  arm.has_forces_on = false;
  arm.peak = 12;
  return device::dhd::open(functions(), "", kOptions, nobody);
}

// The faults of the library, with the words that end the run.
std::vector<Fault> faults_of_the_library() {
  const std::string off = "the device has switched its forces off: ";
  const auto sets = [](int place, int value) {
    return [=](World&, Arm&) { dhd.status[static_cast<std::size_t>(place)] = value; };
  };
  const auto switches_off = [](int cause) { return [=](World&, Arm&) { dhd.switch_off(cause); }; };
  const auto moves = [](double metres) { return [=](World&, Arm&) { dhd.position = metres; }; };
  const std::vector<std::string> unanswered{"the vendor's library has not answered for 25 ms"};
  const std::vector<std::string> elsewhere{"the device's position: expected numbers of at most 1 m"};
  return {{"a call fails", [](World&, Arm&) { dhd.fails = true; }, {": communication with the device failed", "time up"}},
          {"a call never returns", [](World&, Arm&) { dhd.never_returns = true; }, unanswered},
          {"a call takes 40 ms", [](World&, Arm&) { dhd.late = 40 * kMillisecond; }, unanswered},
          {"a call takes 5 ms", [](World&, Arm&) { dhd.late = 5 * kMillisecond; }},
          {"its force button is pressed", switches_off(1), {off + "its force button was pressed"}},
          {"its arm is too fast", switches_off(2), {off + "its arm was too fast"}},
          {"it is not calibrated any more", [](World&, Arm&) { dhd.lose_calibration(); }, {"tripped: uncalibrated"}},
          {"its power is lost", sets(device::dhd::kPower, 0), {"the device has no power"}},
          {"it is unplugged", sets(device::dhd::kConnected, 0), {"the device is no longer connected"}},
          {"it reports an error", sets(device::dhd::kError, 1), {"the device reports an error"}},
          {"a position is not a number", moves(std::nan("")), elsewhere},
          {"a position is in another unit", moves(1e3), elsewhere},
          {"the arm leaps by 10 mm", [](World&, Arm& arm) { arm.jump(); }, {"tripped: jump"}}};
}

}  // namespace

ArmKind dhd_arm() {
  // The device ends a force that is not renewed for 31.875 ms, as the library was told to.
  constexpr Ns kOwnWatchdog = 31'875'000;
  return {"dhd", open_dhd, kOwnWatchdog, faults_of_the_library()};
}

}  // namespace forceshade::world
