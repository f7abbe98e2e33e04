// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/dhd.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <system_error>
#include <utility>

#include "device/dhd/dhd_arm.h"
#include "device/dhd/timed_calls.h"
#include "device/frames/framed_device.h"
#include "files/csv.h"
#include "files/printable.h"
#include "text/joined.h"

namespace forceshade::device::dhd {
namespace {

constexpr float kResolution = 0.05F;  // mm: assumed, no document of the library has one
constexpr std::chrono::milliseconds kToCount{5000};
constexpr std::chrono::milliseconds kToEnd{500};  // for zero force, dhdStop, its tenth of a second and dhdClose
// While the forces are not on, nothing pushes; and the frame that switches them on may take its time.
constexpr std::chrono::milliseconds kWithoutForce{1000};

constexpr const char* kToCalibrate =
    "put the calibration pole of its end-effector into the pit of the base, or move a Falcon's grip out and in, as its manual "
    "says";
constexpr const char* kForces =
    "as commanded; the vendor's library adds its gravity compensation, and shortens them where the motors are saturated, which "
    "no certificate covers";
constexpr const char* kUdev =
    R"(write SUBSYSTEM=="usb", ATTR{idVendor}=="1451", MODE="0666" (a Falcon: ATTR{idVendor}=="0403", )"
    R"(ATTR{idProduct}=="cb48") into a file of /etc/udev/rules.d, and plug the device in again)";

std::string counted_words(std::size_t frames, const char* of) {
  return frames == 0 ? "" : std::to_string(frames) + " frames had " + of;
}

// The link of a device of DHD: its arm, whose calls are waited for no longer than a frame may take.
class Link final : public FrameLink {
 public:
  // Opens the device: `which` as in Arm::open(). Throws DeviceError.
  Link(const Functions& functions, const std::string& which, const FramedOptions& options)
      : frame_(std::make_shared<Frame>(functions, options.force)),
        answer_(options.answer),
        end_(std::max(kToEnd, options.end)) {
    if (!calls_.run([frame = frame_, which] { frame->identity = frame->arm.open(which); }, options.open))
      throw DeviceError("the vendor's library has not answered for " + std::to_string(options.open.count()) +
                        " ms while the device was opened: check its cable and power");
  }

  const Identity& identity() const noexcept { return frame_->identity; }

  FrameState exchange(const Eigen::Vector3d& force) override {
    const std::chrono::milliseconds longest = frame_->state.forces_on ? answer_ : std::max(answer_, kWithoutForce);
    const std::int64_t until = system::now() + system::in_ns(longest);
    if (!calls_.run_until(until, [frame = frame_, force, until] { frame->state = frame->arm.exchange(force, until); }))
      throw DeviceError("the vendor's library has not answered for " + std::to_string(longest.count()) +
                        " ms: check the device's cable and power; if it still pushes, switch it off");
    return frame_->state;
  }

  void close() noexcept override {
    try {
      calls_.run([frame = frame_] { frame->arm.close(); }, end_);
    } catch (const std::exception&) {  // of a lack of memory
    }
  }

  std::string remark() const override {
    const std::string saturated = counted_words(frame_->arm.saturated(), "saturated motors, which shortened their force");
    const std::string guarded = counted_words(frame_->arm.guarded(), "the position of the one before (time guard)");
    return saturated + (saturated.empty() || guarded.empty() ? "" : "; ") + guarded;
  }

 private:
  // The data that a call that does not return may still refer to.
  struct Frame {
    Frame(const Functions& functions, bool may_force) : arm(functions, may_force) {}
    Arm arm;
    Identity identity{};
    FrameState state{.calibrated = false, .forces_on = false};
  };
  std::shared_ptr<Frame> frame_;
  std::chrono::milliseconds answer_, end_;
  TimedCalls calls_;
};

FramedDescription description_of(const Identity& its, const Functions& functions) {
  const Model& model = its.model;
  return {.name = std::string("the ") + model.name,
          .partner = "the vendor's library",
          .to_calibrate = kToCalibrate,
          .model = model.name,
          .serial = its.serial,
          .driver = file_of(functions),
          .firmware = "",
          .forces = kForces,
          .capabilities = {.workspace_low = Eigen::Vector3f::Constant(-model.reach),
                           .workspace_high = Eigen::Vector3f::Constant(model.reach),
                           .resolution = kResolution,
                           .peak_force = model.peak,
                           .continuous_force = model.continuous,
                           .buttons = model.buttons}};
}

void report(const Identity& its, bool may_force, Attendant& attendant) {
  std::string words = files::printable(its.name) + (its.serial.empty() ? "" : ", serial number " + its.serial) + ": " +
                      "left-handed: " + (its.is_left_handed ? "yes" : "no");
  if (its.gripper)
    words += ", gripper open by " + shortest(std::round(*its.gripper * 10) / 10) + " mm (no force is sent to it)";
  if (may_force)
    words += its.has_watchdog ? "; the device ends a force that is not renewed for 31.875 ms"
                              : "; the device refuses a watchdog: if this program is killed, the last force may stay on";
  attendant.report(words);
}

Check check_devices(const Functions& functions) {
  const char* what = "devices";
  TimedCalls calls;
  const auto counts = std::make_shared<Counts>();
  if (!calls.run([counts, functions] { *counts = counted(functions); }, kToCount))
    return {what, Grade::wrong, "the vendor's library does not answer"};
  const std::string words = "the vendor's library sees " + std::to_string(counts->connected) + ", of which " +
                            std::to_string(std::max(0, counts->available)) + " can be opened";
  if (counts->connected == 0) return {what, Grade::wrong, words + ": check cable, power and the udev rule"};
  if (counts->available <= 0) return {what, Grade::wrong, words + ": end the program that uses it"};
  return {what, Grade::ok, words};
}

namespace fs = std::filesystem;

std::string word_in(const fs::path& file) {
  std::string word;
  std::ifstream(file) >> word;
  return word;
}

// A number of the USB as the names of nodes have it: with three digits.
std::string with_zeros(const std::string& number) {
  return std::string(3 - std::min<std::size_t>(3, number.size()), '0') + number;
}

}  // namespace

std::vector<UsbDevice> usb_devices(const fs::path& root) {
  std::vector<UsbDevice> found;
  std::error_code error;
  for (fs::directory_iterator entry(root / "sys/bus/usb/devices", error), end; !error && entry != end; entry.increment(error)) {
    const std::string vendor = word_in(entry->path() / "idVendor"), product = word_in(entry->path() / "idProduct");
    if (vendor != "1451" && !(vendor == "0403" && product == "cb48")) continue;
    const std::string node =
        "dev/bus/usb/" + with_zeros(word_in(entry->path() / "busnum")) + '/' + with_zeros(word_in(entry->path() / "devnum"));
    const bool accessible = ::faccessat(AT_FDCWD, (root / node).c_str(), R_OK | W_OK, AT_EACCESS) == 0;
    found.push_back({vendor + ':' + product, '/' + node, accessible});
  }
  std::ranges::sort(found, {}, &UsbDevice::node);
  return found;
}

std::unique_ptr<Device> open(const Functions& functions, const std::string& name, const FramedOptions& options,
                             Attendant& attendant) {
  auto link = std::make_unique<Link>(functions, name, options);
  report(link->identity(), options.force, attendant);
  const FramedDescription description = description_of(link->identity(), functions);
  return std::make_unique<FramedDevice>(std::move(link), description, options, attendant);
}

}  // namespace forceshade::device::dhd

namespace forceshade::device {

std::unique_ptr<Device> open_dhd(const std::string& name, const FramedOptions& options, Attendant& attendant) {
  return dhd::open(dhd::load(dhd::names_to_try()), name, options, attendant);
}

std::unique_ptr<Device> open_dhd(const std::string& name, Attendant& attendant, Forces forces) {
  return open_dhd(name, {.force = forces == Forces::as_commanded}, attendant);
}

Check check_usb(const std::vector<dhd::UsbDevice>& devices) {
  const char* what = "USB";
  if (devices.empty())
    return {what, Grade::unknown, "no device of Force Dimension (1451) and no Falcon (0403:cb48) is plugged in and has power"};
  const std::string words = joined(devices, "; ", [](const dhd::UsbDevice& device) {
    return device.id + " at " + device.node +
           (device.accessible ? " can be read and written" : " cannot be read and written by this user");
  });
  const bool all = std::ranges::all_of(devices, &dhd::UsbDevice::accessible);
  return {what, all ? Grade::ok : Grade::wrong, all ? words : words + ": " + dhd::kUdev};
}

std::vector<Check> dhd_checks(const std::string&) {
  std::vector<Check> checks{check_usb(dhd::usb_devices())};
  try {
    checks.push_back(dhd::check_devices(dhd::load(dhd::names_to_try())));
  } catch (const std::runtime_error&) {
    checks.push_back({"devices", Grade::unknown, "the vendor's library could not be loaded: see the opening"});
  }
  return checks;
}

}  // namespace forceshade::device
