// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The data that a PHANToM's driver's process shares with the servo loop's: memory that both map, where samples go one
// way and orders the other, and messages about all that is not urgent. Plain data, since either process may die at any moment.

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "device/frame_samples.h"
#include "device/frame_times.h"
#include "device/triple_buffer.h"
#include "forceshade/device.h"
#include "system/process.h"

namespace forceshade::device {

// The data of one frame, in the driver's frame of reference and units: x right, y up, z to the user; mm, N, rad.
struct PhantomSample {
  // Closed: zero was sent last and the output is off, for good.
  enum class Phase { settling, ready, closed };

  Phase phase = Phase::settling;
  bool troubled = false;  // PhantomShared::trouble says why; from then on the force is zero and the output off
  std::int64_t time = 0;  // CLOCK_MONOTONIC, ns; 0: there was no frame
  Eigen::Vector3d position{0, 0, 0}, gimbal{0, 0, 0};
  std::optional<std::array<double, 3>> joints = std::nullopt;
  std::optional<std::array<std::int64_t, 3>> encoder = std::nullopt;
  int buttons = 0;
  bool calibrated = false, forces_on = false;
  bool answers = true;                           // by the driver's count of its frames
  bool has_temperature = true, has_rate = true;  // else it has no such thing, and nothing is watched there
  double temperature = 0;
  int update_rate = 0;  // Hz, as the driver counts; 0 where it does not
  Sent sent;
  std::optional<FrameTimes::Window> times = std::nullopt;  // of the last whole window
};

struct PhantomShared {
  FrameSamples<PhantomSample> samples;
  TripleBuffer<ForceOrder> orders;
  std::array<char, 512> trouble{};  // written once, before the sample that is troubled
};
static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "shared between processes");

// The driver's description of the device when it was opened.
struct PhantomDescription {
  std::array<char, 96> model{}, serial{}, driver{}, firmware{};
  double peak = 0, continuous = 0, speed = 0, slew = 0;
  Eigen::Vector3f low{0, 0, 0}, high{0, 0, 0};
  int rate = 0;  // Hz; 0: the driver does not say
  bool gimbal = false;
};

struct PhantomMessage {
  enum class Kind {
    start,      // to the driver: with `rate`
    yes,        // to the driver: what the attendant was asked to do is done
    no,         //
    described,  // from the driver: it is open
    report,     // from the driver: words for the attendant
    asked,      // from the driver: words for the attendant, who answers
    ready,      // from the driver: frames run, and a force that is ordered is sent
    failed,     // from the driver: why; it has closed
  };
  Kind kind = Kind::failed;
  double rate = 0;  // Hz
  PhantomDescription description = {};
  std::array<char, 4096> words{};
};

// Messages between the two processes of a PHANToM.

// False if the other end is closed.
inline bool send_message(system::Packets& packets, const PhantomMessage& message) noexcept {
  return packets.send(&message, sizeof message);
}

inline bool send_words(system::Packets& packets, PhantomMessage::Kind kind, const std::string& words) noexcept {
  PhantomMessage message{.kind = kind};
  std::snprintf(message.words.data(), message.words.size(), "%s", words.c_str());
  return send_message(packets, message);
}

}  // namespace forceshade::device
