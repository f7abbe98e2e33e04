// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/hdapi_words.h"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace forceshade::device::hdapi {
namespace {

// The amplifiers toggle and ramp up again after an exceeded limit, so that forces are low for a while.
constexpr const char* kAfterALimit =
    "the driver cut the force; let it recover for a few seconds, then use a softer surface or slower strokes";
constexpr const char* kOurs = "this is a mistake in forceshade: please report it";

constexpr std::array kMeanings{
    Meaning{kWarmMotors, "the motors are too warm",
            "let them cool for some minutes, then use a softer surface or lighter strokes"},
    Meaning{kExceededForce, "the highest force was exceeded", kAfterALimit},
    Meaning{kExceededImpulse, "the highest change of force was exceeded", kAfterALimit},
    Meaning{kExceededVelocity, "the highest velocity was exceeded", kAfterALimit},
    Meaning{kForceError, "the force could not be sent", kAfterALimit},
    Meaning{kDeviceFault, "the device reports a fault", "check its power supply, cable and emergency switch"},
    Meaning{kAlreadyInitiated, "the device is in use", "close the program that has it open"},
    Meaning{kCommunication, "communication with the device failed",
            "check cable and power; over Ethernet, connect it directly and not through a switch"},
    Meaning{kCommunicationConfiguration, "the device's connection is not set up",
            "pair or configure the device with the vendor's set-up program"},
    Meaning{kTimer, "the driver has no timer", "check that no other program runs the driver's scheduler"},
    Meaning{kNoLicence, "the vendor's licence is missing",
            "install the licence that came with OpenHaptics; the hardware is not the cause"},
    Meaning{kInvalidEnum, "the driver does not have this property", "check that driver and library are of one version"},
    Meaning{kInvalidValue, "the driver refuses this value", "check it against what the device's manual allows"},
    Meaning{kInvalidOperation, "the driver refuses this now", kOurs},
    Meaning{kInvalidInputType, "the driver expects another type", kOurs},
    Meaning{kBadHandle, "the driver does not recognise the device", "check that no other part of this program disabled it"},
    Meaning{kIllegalBegin, "a frame was begun twice", kOurs},
    Meaning{kIllegalEnd, "a frame was ended twice", kOurs},
    Meaning{kFrame, "the frame failed", "check cable and power"},
    Meaning{kInvalidPriority, "the scheduler refuses the priority", kOurs},
    Meaning{kSchedulerFull, "the scheduler is full", "check what else this program has scheduled"},
    Meaning{0, "the driver reports an error", "look the number up in the vendor's reference"},
};

}  // namespace

const Meaning& meaning_of(HDerror code) noexcept {
  for (const Meaning& meaning : kMeanings)
    if (meaning.code == code) return meaning;
  return kMeanings.back();
}

const char* sentence(const Trouble& trouble, std::span<char> room) noexcept {
  if (trouble.error.code == kSuccess) return trouble.words;
  const Meaning& meaning = meaning_of(trouble.error.code);
  std::snprintf(room.data(), room.size(), "%s: %s (error 0x%04x, internal %d, the vendor says \"%s\"): %s", trouble.words,
                meaning.name, trouble.error.code, trouble.error.internal, trouble.vendors_words ? trouble.vendors_words : "",
                meaning.advice);
  return room.data();
}

std::string initialisation_advice(const std::string& name, const Trouble& trouble) {
  std::array<char, 512> room{};
  std::string advice = sentence(trouble, room);
  if (trouble.error.code == kNoLicence || trouble.error.code == kAlreadyInitiated) return advice;
  const char* home = std::getenv("GTDD_HOME");
  return advice + "\nThe driver often gives one error for many causes; check in turn:\n  name: " +
         (name.empty()
              ? "the default device was asked for; try phantom:NAME with \"Default PHANToM\", \"Default Device\" or a name"
              : "\"" + name + "\" must be written as") +
         " in the vendor's set-up program, which keeps them in " + (home ? home : "~/.3dsystems, or where GTDD_HOME says") +
         ", or for FireWire in /etc/SensAble/PHANToMDeviceDrivers" +
         (trouble.error.code == kInvalidValue ? "; this error is what version 3.0 says of a name that it does not find there"
                                              : "") +
         "\n  permission: you must be able to read and write the device's port (USB: /dev/ttyACM* or /dev/hidraw*, FireWire: "
         "/dev/fw*)"
         "\n  licence: the vendor's own examples must start\n  power and cable: the vendor's diagnostic program must see the "
         "device move";
}

}  // namespace forceshade::device::hdapi
