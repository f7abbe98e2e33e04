// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/dhd_words.h"

#include <array>

#include "files/printable.h"

namespace forceshade::device::dhd {
namespace {

constexpr const char* kOurs = "this is a mistake in forceshade: please report it";
constexpr const char* kCable = "check cable and power, then start again";
constexpr const char* kVersions = "check that the library and the device's firmware are of one age";

constexpr std::array kErrors{
    Meaning{1, "an error without a name", kCable},
    Meaning{2, "communication with the device failed", kCable},
    Meaning{3, "the device's controller is busy", "wait a moment, then start again"},
    Meaning{4, "there is no driver for the device", "install the vendor's driver and its udev rule"},
    Meaning{5, "there is no such device",
            "check its cable and power, the serial number, and the udev rule for USB vendor 1451 (Falcon 0403:cb48)"},
    Meaning{6, "the device is not available", "end the program that uses it"},
    Meaning{7, "the device did not answer in time", kCable},
    Meaning{8, "the device's geometry cannot be computed", "move the arm away from the end of its workspace"},
    Meaning{9, "the expert mode is off", kOurs},
    Meaning{10, "the device does not have this function", kVersions},
    Meaning{11, "there is not enough memory", "end other programs"},
    Meaning{12, "the device is not ready", "calibrate it, and check its power and emergency switch"},
    Meaning{13, "a file is missing", "install the vendor's SDK again"},
    Meaning{14, "the device's configuration cannot be read", kVersions},
    Meaning{15, "there is no device of this number", "check which devices are connected"},
    Meaning{16, "the function is no longer there", kVersions},
    Meaning{17, "a null pointer was given", kOurs},
    Meaning{18, "two measurements of one joint disagree", "calibrate the device, and have it repaired if this comes again"},
    Meaning{19, "the forces are off", "check the force button and the emergency switch, then start again"},
    Meaning{20, "the device is in use", "end the program that uses it"},
    Meaning{21, "an argument is not allowed", kOurs},
    Meaning{22, "there is no regulation", kOurs},
    Meaning{0, "an error that is not known here", "look its number up in the vendor's reference"},
};

constexpr std::array kCauses{
    Meaning{1, "its force button was pressed", "press it again, then start again"},
    Meaning{2, "its arm was too fast", "hold it with a firmer hand, and use a softer surface or slower strokes"},
    Meaning{3, "its watchdog got no force in time", "check what else this machine computes"},
    Meaning{4, "a program switched them off", "end other programs that use the device"},
    Meaning{5, "its USB connection is bad", "connect it directly and not through a hub"},
    Meaning{6, "its dead-man switch was released", "hold the switch, then start again"},
    Meaning{0, "it says no cause", "check its power and emergency switch"},
};

template <class Table>
const Meaning& meaning_in(const Table& table, int code) noexcept {
  for (const Meaning& meaning : table)
    if (meaning.code == code) return meaning;
  return table.back();
}

}  // namespace

const Meaning& meaning_of_error(int code) noexcept {
  return meaning_in(kErrors, code);
}

const Meaning& meaning_of_cause(int cause) noexcept {
  return meaning_in(kCauses, cause);
}

std::string sentence(const char* what, int error, const char* vendors_words) {
  const Meaning& meaning = meaning_of_error(error);
  return std::string(what) + ": " + meaning.name + " (DHD error " + std::to_string(error) + ", the vendor says \"" +
         files::printable(vendors_words ? vendors_words : "") + "\"): " + meaning.advice;
}

std::string forces_are_off(int cause) {
  const Meaning& meaning = meaning_of_cause(cause);
  return std::string("the device has switched its forces off: ") + meaning.name + ": " + meaning.advice;
}

}  // namespace forceshade::device::dhd
