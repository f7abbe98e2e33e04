// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Texts for errors of a PHANToM, with advice for each.

#include <cstddef>
#include <span>
#include <string>

#include "device/phantom/hdapi_abi.h"

namespace forceshade::device::hdapi {

struct Meaning {
  HDerror code;
  const char* name;
  const char* advice;
};

// Never fails: an unknown code has words, too.
const Meaning& meaning_of(HDerror code) noexcept;

// The first error: one of the driver's with what it was asked for, or, with no code, words that say it all.
struct Trouble {
  const char* words = nullptr;  // null: nothing went wrong
  HDErrorInfo error{};
  const char* vendors_words = "";

  explicit operator bool() const noexcept { return words != nullptr; }
};

// A sentence about the trouble, in `room`, or a constant. Allocates nothing.
const char* sentence(const Trouble& trouble, std::span<char> room) noexcept;

// The reason why hdInitDevice failed, and what to check. The driver's error is often a general one, whatever the cause.
std::string initialisation_advice(const std::string& name, const Trouble& trouble);

inline constexpr const char* kHoldInResetPose =
    "hold the arm in its reset pose (upper arm level, forearm straight down, all joints in the middle), as the vendor's "
    "calibration program shows it";
inline constexpr const char* kRestInInkwell = "rest the stylus in its inkwell until its light stops blinking";
inline constexpr const char* kMoveItAbout = "move the arm slowly through its workspace until it is calibrated";
inline constexpr const char* kNotCalibrated =
    "the PHANToM is not calibrated: hold it in its reset pose, rest its stylus in the inkwell or move it about, as its "
    "manual says, then start again";
inline constexpr const char* kUncalibratedPose =
    "the PHANToM's position stays at exactly (0, -110, -35) mm, where an uncalibrated Omni or Touch says it is: rest the "
    "stylus "
    "in its inkwell until the light stops blinking, move it once, then start again";
inline constexpr const char* kNoTemperature =
    "the driver gives motor temperatures that are no numbers from 0 on: the motors cannot be kept from burning";
inline constexpr const char* kDriverEnded =
    "the process of the PHANToM's driver has ended: the vendor's library failed in it, or it was killed. If the device still "
    "pushes, switch it off";
inline constexpr const char* kTemperatureUnknown =
    "the driver does not report this device's motor temperatures: nothing but the continuous force keeps the motors from "
    "burning";
inline constexpr const char* kRateUnknown =
    "the driver does not report this device's update rate: a lost connection is noticed only if the driver reports it";
inline constexpr const char* kNoEnd =
    "the PHANToM's driver did not end as it should, and its process was ended: if the device still pushes, switch it off";
inline constexpr const char* kNoStart = "the driver's scheduler does not start: check cable and power, then start again";
inline constexpr const char* kNoAnswer =
    "the PHANToM no longer answers its driver (its update rate has fallen): check cable and power, then start again";
inline constexpr const char* kNotFinite = "the PHANToM's position is not finite";
inline constexpr const char* kStalled =
    "the servo loop stalled while a force was held: the force was switched off and stays off until the next start";
inline constexpr const char* kOutputStaysOff =
    "the PHANToM's force output was switched on and is still off: check its power supply and emergency switch";
inline constexpr const char* kForcesOff =
    "the driver's force output is off, or the safety switch has changed: check the power supply and the emergency switch";
inline constexpr const char* kNoFrames =
    "the driver's scheduler runs no frames: check the PHANToM's connection, and whether another program holds the device";
inline constexpr const char* kSilent =
    "the driver's scheduler stopped running frames: communication with the PHANToM is lost. If the device still "
    "pushes, switch it off";

}  // namespace forceshade::device::hdapi
