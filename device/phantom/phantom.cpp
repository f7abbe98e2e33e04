// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include "device/lasting_words.h"
#include "device/phantom/hdapi_words.h"
#include "device/phantom/phantom_end.h"
#include "device/phantom/phantom_host.h"
#include "device/phantom/phantom_shared.h"
#include "device/simulated/arm.h"
#include "files/csv.h"
#include "forceshade/device.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

using Kind = PhantomMessage::Kind;
using std::chrono::milliseconds;

constexpr milliseconds kListen{50};
constexpr milliseconds kEnding{1500};  // for the process to end by itself

Attendant& nobody() {
  static Attendant it;
  return it;
}

std::int64_t after(milliseconds time) noexcept {
  return system::now() + system::in_ns(time);
}

}  // namespace

Phantom::Phantom(const std::string& name, const PhantomOptions& options) : Phantom(name, options, nobody()) {}

Phantom::Phantom(const std::string& name, const PhantomOptions& options, Attendant& attendant, HdapiLibrary library)
    : options_(options), attendant_(attendant), room_(room_for_words()) {
  try {
    shared_ = new (system::map_shared(sizeof *shared_)) PhantomShared;
    process_.emplace("forceshade-hd", [shared = shared_, name, options, library](system::Packets& packets) {
      return run_phantom_host(packets, *shared, name, options, library);
    });
  } catch (const std::system_error& error) {
    end_process();
    throw DeviceError(std::string("the process that holds the PHANToM: ") + error.what());
  }
  const PhantomMessage message = answer(options_.open);
  if (message.kind != Kind::described) {
    end_process();
    throw DeviceError(message.words.data());
  }
  describe(message.description);
}

Phantom::~Phantom() {
  end_process();
}

// The next message that is not for the attendant. Of kind failed, with why, where none came.
PhantomMessage Phantom::answer(milliseconds timeout) {
  PhantomMessage message;
  const auto failed = [&](const std::string& why) {
    PhantomMessage it{.kind = Kind::failed};
    std::snprintf(it.words.data(), it.words.size(), "%s", why.c_str());
    return it;
  };
  using Received = system::Packets::Received;
  std::int64_t deadline = after(timeout);
  while (system::now() < deadline) {
    if (attendant_.has_left()) return failed("stopped before the PHANToM was ready");
    const Received received = process_->packets().receive(&message, sizeof message, after(kListen));
    if (received == Received::closed) return failed(how_it_ended());
    if (received == Received::nothing_yet) continue;
    if (message.kind == Kind::report) {
      attendant_.report(message.words.data());
    } else if (message.kind == Kind::asked) {
      const bool done = attendant_.did(message.words.data());
      send_message(process_->packets(), {.kind = done ? Kind::yes : Kind::no});
      deadline = after(timeout);
    } else {
      return message;
    }
  }
  const std::string seconds = shortest(std::chrono::duration<double>(timeout).count());
  return failed("the PHANToM's driver has not answered for " + seconds +
                " s: check cable and power, and whether another program holds the device");
}

std::string Phantom::how_it_ended() {
  const auto ended = process_->ended(after(kEnding));
  if (ended) process_.reset();
  const std::string how = !ended              ? "closed its connection"
                          : ended->signal > 0 ? std::string("was ended by a signal (") + strsignal(ended->signal) + ")"
                                              : "ended with exit code " + std::to_string(ended->code);
  return "the process of the PHANToM's driver " + how + ": the vendor's library failed in it";
}

void Phantom::end_process() noexcept {
  if (process_) {
    process_->close();
    process_->resume();
    auto ended = process_->ended(after(kEnding));
    if (!ended) {
      process_->kill();
      ended = process_->ended(after(kEnding));  // not where it is stuck in the system itself
    }
    const bool in_order = ended && ended->signal == 0 && (ended->code == kLetGo || ended->code == kRefused);
    if (!in_order) attendant_.report(hdapi::kNoEnd);
  }
  process_.reset();
  if (shared_) system::unmap_shared(shared_, sizeof *shared_);
  shared_ = nullptr;
}

void Phantom::describe(const PhantomDescription& driver) {
  description_ = driver;
  capabilities_ = {.model = description_.model.data(),
                   .serial = description_.serial.data(),
                   .driver = description_.driver.data(),
                   .firmware = description_.firmware.data(),
                   .workspace_low = driver.low,
                   .workspace_high = driver.high,
                   .resolution = 0.055F,  // the driver does not say; the coarsest sheet's, Omni's and Touch's
                   .peak_force = static_cast<float>(driver.peak),
                   .continuous_force = static_cast<float>(driver.continuous),
                   .latency = true,  // of a frame
                   .highest_speed = driver.speed,
                   .highest_slew = driver.slew,
                   .paces = true,
                   .buttons = 4,  // as many as the driver has bits for; it does not say how many there are
                   .gimbal = driver.gimbal};
  if (driver.rate > 0) capabilities_.highest_rate = driver.rate;
}

std::optional<Fault> Phantom::start(double rate) noexcept {
  if (started_ || failed_) return Fault{"the PHANToM was started before"};
  send_message(process_->packets(), {.kind = Kind::start, .rate = rate});
  // Each step of the driver's has a limit of its own, which it says more about.
  const PhantomMessage message = answer(options_.start + options_.calibration + milliseconds(1000));
  if (message.kind != Kind::ready) {
    failed_ = true;
    *room_ = message.words;
    return fault();
  }
  started_ = true;
  first_ = shared_->samples.latest().time;
  return std::nullopt;
}

Fault Phantom::fault() noexcept {
  return Fault{room_->data()};
}

std::int64_t Phantom::wait_for_frame(std::int64_t deadline) noexcept {
  return shared_->samples.wait_for_another(read_, deadline);
}

ReadResult Phantom::read() noexcept {
  if (failed_) return fault();
  if (!started_) return Fault{"the PHANToM was not started"};
  const PhantomSample& sample = shared_->samples.latest();
  read_ = sample.time;
  state_ = {.calibrated = sample.calibrated,
            .forces_on = sample.forces_on,
            .forces_off = sample.forces_on ? "" : hdapi::kForcesOff,
            .temperature = static_cast<float>(sample.temperature),
            .update_rate = static_cast<double>(sample.update_rate)};
  if (sample.troubled) {
    failed_ = true;
    std::snprintf(room_->data(), room_->size(), "%s", shared_->trouble.data());
    return fault();
  }
  if (system::now() - sample.time > system::in_ns(options_.watchdog_timeout)) {
    failed_ = true;
    const bool has_ended = process_->ended(0).has_value();
    if (has_ended)
      process_.reset();
    else
      process_->resume();  // a stopped one then sends zero
    std::snprintf(room_->data(), room_->size(), "%s", has_ended ? hdapi::kDriverEnded : hdapi::kSilent);
    return fault();
  }
  Sent sent = sample.sent;
  sent.acted = turned_to_law(sent.acted.cast<double>()).cast<float>();
  sent.acting = turned_to_law(sent.acting.cast<double>()).cast<float>();
  Reading reading{.position = turned_to_law(sample.position).cast<float>(),
                  .time = static_cast<double>(sample.time - first_) * 1e-9,
                  .buttons = static_cast<std::uint16_t>(sample.buttons),
                  .encoder = sample.encoder,
                  .joints = sample.joints,
                  .sent = sent};
  if (capabilities_.gimbal) reading.gimbal = sample.gimbal.cast<float>();
  return reading;
}

std::optional<Fault> Phantom::command(const Eigen::Vector3f& force) noexcept {
  const bool finite = force.allFinite();
  Eigen::Vector3d limited = Eigen::Vector3d::Zero();
  if (finite) limited = turned_to_arm(force.cast<double>());
  const double size = limited.norm(), highest = static_cast<double>(capabilities_.peak_force);
  if (size > highest) limited *= highest / size;
  if (started_) shared_->orders.publish({.force = limited, .time = system::now(), .allowance = allowance_});
  if (!finite) return Fault{"a force that is not finite was commanded"};
  return std::nullopt;
}

std::unique_ptr<Device> open_phantom(const std::string& name, Attendant& attendant, Forces forces) {
  return std::make_unique<Phantom>(name, PhantomOptions{.force = forces == Forces::as_commanded}, attendant);
}

}  // namespace forceshade::device
