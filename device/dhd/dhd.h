// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device of Force Dimension (omega, delta, sigma, lambda) or a Novint Falcon, through the vendor's library DHD. docs/dhd.md
// says what was taken from its documents, and what is assumed.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "device/check.h"
#include "device/frames/link.h"
#include "forceshade/device.h"

namespace forceshade::device::dhd {

struct Functions;

// A device of Force Dimension or Novint on the USB, found without the vendor's library.
struct UsbDevice {
  std::string id;           // "1451:0402"
  std::string node;         // "/dev/bus/usb/001/005"
  bool accessible = false;  // this user may read and write the node, which the library has to
};

// root: of a file system, for tests.
std::vector<UsbDevice> usb_devices(const std::filesystem::path& root = "/");

// open_dhd() with these functions. Throws DeviceError.
std::unique_ptr<Device> open(const Functions& functions, const std::string& name, const FramedOptions& options,
                             Attendant& attendant);

}  // namespace forceshade::device::dhd

namespace forceshade::device {

// `name`: a serial number; "#" and an index from 0; empty: the only device. Opens it and reads what it is; its forces are
// switched on once it runs frames and is calibrated. The attendant lives as long as the device. Throws DeviceError, with what
// to check.
std::unique_ptr<Device> open_dhd(const std::string& name, const FramedOptions& options, Attendant& attendant);
std::unique_ptr<Device> open_dhd(const std::string& name, Attendant& attendant, Forces forces);

// The vendor's library, what is connected on the USB and whether this user may use it, and which devices the library sees.
std::vector<Check> dhd_checks(const std::string& name);

// The second of these.
Check check_usb(const std::vector<dhd::UsbDevice>& devices);

}  // namespace forceshade::device
