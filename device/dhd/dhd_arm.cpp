// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/dhd_arm.h"

#include <array>
#include <cmath>

#include "device/dhd/dhd_words.h"
#include "files/csv.h"
#include "files/printable.h"
#include "forceshade/device.h"
#include "text/number_text.h"

namespace forceshade::device::dhd {
namespace {

constexpr double kMetre = 1000;  // mm
// Far beyond every workspace: a position in another unit, or garbage.
constexpr double kFarthest = 1000;  // mm
constexpr std::chrono::milliseconds kBeforeClose{100};
// The longest wait until the status shows that forces are on: it may be of an earlier packet.
constexpr std::chrono::milliseconds kToSwitchOn{1000};

constexpr const char* kNone =
    "no device of Force Dimension is connected: check its cable and its power, and the udev rule for USB vendor 1451 (Falcon "
    "0403:cb48), which docs/dhd.md has";

// The laws: x right, y away from the user, z up. DHD: x towards the operator, y to the operator's right, z up.
Eigen::Vector3d in_laws(double x, double y, double z) {
  return {y, -x, z};
}

DeviceError failed(const Functions& dhd, const char* what) {
  const int error = dhd.dhdErrorGetLast();
  return DeviceError(sentence(what, error, dhd.dhdErrorGetLastStr()));
}

// Reach and peak are those of an open-source client (CHAI3D), which are no more than the data sheets'. Those of sigma.3 and
// lambda.3, which it does not have, are taken from sigma.7 and lambda.7. No continuous force is published: half of the peak.
constexpr std::array kModels{
    Model{63, "delta.3", 150, 20, 10, 1},    Model{33, "omega.3", 75, 12, 6, 1},      Model{34, "omega.6", 75, 12, 6, 1},
    Model{36, "omega.6", 75, 12, 6, 1},      Model{35, "omega.7", 75, 12, 6, 1},      Model{37, "omega.7", 75, 12, 6, 1},
    Model{206, "sigma.3", 75, 12, 6, 1},     Model{104, "sigma.7", 75, 12, 6, 1},     Model{105, "sigma.7", 75, 12, 6, 1},
    Model{203, "lambda.3", 112.5, 12, 6, 1}, Model{108, "lambda.7", 112.5, 12, 6, 1}, Model{109, "lambda.7", 112.5, 12, 6, 1},
    Model{kFalcon, "Falcon", 40, 8, 4, 4},
};

}  // namespace

Counts counted(const Functions& dhd) {
  const int connected = dhd.dhdGetDeviceCount();
  if (connected < 0) throw failed(dhd, "counting the devices");
  return {connected, dhd.dhdGetAvailableCount()};
}

int Arm::expect(int result, const char* what) const {
  if (result < 0) throw failed(dhd_, what);
  return result;
}

int Arm::open_device(const std::string& which) {
  const Counts counts = counted(dhd_);
  if (counts.connected == 0) throw DeviceError(kNone);
  if (counts.available == 0) throw DeviceError("another program uses the device of Force Dimension: end it");
  if (which.empty() && counts.connected > 1)
    throw DeviceError(std::to_string(counts.connected) +
                      " devices of Force Dimension are connected: name one, as dhd:SERIAL or, from dhd:#0 on, by its index");
  const std::string what = "opening the device" + (which.empty() ? "" : " \"" + files::printable(which) + '"');
  if (which.empty()) return expect(dhd_.dhdOpenID(0), what.c_str());
  const bool is_index = which.front() == '#';
  const auto number = number_in<int>(std::string_view(which).substr(is_index ? 1 : 0));
  if (!number || *number < 0 || (is_index && *number >= counts.connected))
    throw DeviceError(what + ": expected a serial number, or # and an index below " + std::to_string(counts.connected));
  if (!is_index && *number == static_cast<int>(kFalconsSerial))
    throw DeviceError(what + ": every Falcon has this serial number; name it by its index, as dhd:#0");
  return expect(is_index ? dhd_.dhdOpenID(static_cast<Id>(*number)) : dhd_.dhdOpenSerial(*number), what.c_str());
}

Identity Arm::open(const std::string& which) {
  id_ = static_cast<Id>(open_device(which));
  dhd_.dhdEnableForce(0, *id_);  // they may still be on from another program
  const int type = expect(dhd_.dhdGetSystemType(*id_), "reading the device's type");
  const char* name = dhd_.dhdGetSystemName(*id_);
  const Model* model = model_of(type);
  if (!model)
    throw DeviceError("the device is a \"" + files::printable(name ? name : "") + "\" (type " + std::to_string(type) +
                      "), whose limits are not known here");
  peak_ = static_cast<double>(model->peak);
  Identity its{.model = *model, .name = name ? name : model->name, .serial = "", .gripper = std::nullopt};
  unsigned short serial = 0;
  expect(dhd_.dhdGetSerialNumber(&serial, *id_), "reading the device's serial number");
  if (serial != kFalconsSerial) its.serial = std::to_string(serial);
  its.is_left_handed = dhd_.dhdIsLeftHanded(*id_);
  double gap = 0;
  if (dhd_.dhdHasGripper(*id_) && dhd_.dhdGetGripperGap(&gap, *id_) >= 0 && std::isfinite(gap)) its.gripper = gap * kMetre;
  if (may_force_) its.has_watchdog = dhd_.dhdEnableExpertMode() >= 0 && dhd_.dhdSetWatchdog(kMostWatchdog, *id_) >= 0;
  return its;
}

void Arm::switch_on() {
  expect(dhd_.dhdSetMaxForce(peak_, *id_), "setting the highest force");
  expect(dhd_.dhdSetGravityCompensation(1, *id_), "switching the gravity compensation on");
  expect(dhd_.dhdSetBrakes(0, *id_), "releasing the brakes");
  expect(dhd_.dhdEnableForce(1, *id_), "switching the forces on");
  output_ = Output::switched_on;
  switched_on_ = system::now();
}

// matters: whether a failure is one of the run.
void Arm::send(const Eigen::Vector3d& force, bool matters) {
  const Eigen::Vector3d its{-force.y(), force.x(), force.z()};
  const int result = dhd_.dhdSetForce(its.x(), its.y(), its.z(), *id_);
  if (result == kSaturated) ++saturated_;
  if (result >= 0 || !matters) return;
  const DeviceError why = failed(dhd_, "sending a force");
  std::array<int, kStatusRoom> status{};
  if (dhd_.dhdGetStatus(status.data(), *id_) >= 0 && status[kForce] == 0)
    throw DeviceError(forces_are_off(status[kForceOffCause]));
  throw why;
}

FrameState Arm::exchange(const Eigen::Vector3d& force, std::int64_t until) {
  std::array<int, kStatusRoom> status{};
  expect(dhd_.dhdGetStatus(status.data(), *id_), "reading the status");
  if (status[kConnected] == 0) throw DeviceError("the device is no longer connected: check its cable and power");
  if (status[kPower] == 0) throw DeviceError("the device has no power: check its power supply");
  if (status[kError] != 0) throw DeviceError("the device reports an error: switch it off and on, and calibrate it");
  const bool is_calibrated = status[kReset] == 0;
  if (output_ != Output::off && is_calibrated) {
    const bool was_on = output_ == Output::on;
    if (status[kForce] != 0)
      output_ = Output::on;
    else if (was_on || system::now() - switched_on_ > system::in_ns(kToSwitchOn))
      throw DeviceError(forces_are_off(status[kForceOffCause]));
  }
  if (output_ == Output::off && may_force_ && is_calibrated) switch_on();
  const bool obeys = output_ == Output::on && is_calibrated;
  // Zero, too: without a force command gravity is not compensated, and the watchdog's time goes by.
  if (output_ != Output::off) send(obeys && system::now() < until ? force : Eigen::Vector3d(0, 0, 0), obeys);
  FrameState state = state_at_position();
  state.calibrated = is_calibrated;
  state.forces_on = obeys;
  state.withheld = !obeys;
  return state;
}

FrameState Arm::state_at_position() {
  double x = 0, y = 0, z = 0;
  if (expect(dhd_.dhdGetPosition(&x, &y, &z, *id_), "reading the position") == kTimeGuard) ++guarded_;
  const Eigen::Vector3d position = in_laws(x, y, z) * kMetre;
  if (!position.allFinite() || position.cwiseAbs().maxCoeff() > kFarthest)
    throw DeviceError("the device's position: expected numbers of at most " + shortest(kFarthest / kMetre) + " m, got (" +
                      shortest(x) + ", " + shortest(y) + ", " + shortest(z) + ")");
  return {.position = position, .buttons = static_cast<std::uint16_t>(dhd_.dhdGetButtonMask(*id_))};
}

void Arm::close() noexcept {
  if (!id_) return;
  if (output_ != Output::off) {
    dhd_.dhdSetForce(0, 0, 0, *id_);
    dhd_.dhdStop(*id_);
    system::sleep_for(kBeforeClose);
  }
  dhd_.dhdClose(*id_);
  id_.reset();
}

const Model* model_of(int type) noexcept {
  for (const Model& model : kModels)
    if (model.type == type) return &model;
  return nullptr;
}

}  // namespace forceshade::device::dhd
