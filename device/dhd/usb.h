// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The devices of Force Dimension and Novint on the USB, without the vendor's library.

#include <filesystem>
#include <string>
#include <vector>

namespace forceshade::device::dhd {

struct UsbDevice {
  std::string id;           // "1451:0402"
  std::string node;         // "/dev/bus/usb/001/005"
  bool accessible = false;  // this user may read and write the node, which the library has to
};

// root: of a file system, for tests.
std::vector<UsbDevice> usb_devices(const std::filesystem::path& root = "/");

}  // namespace forceshade::device::dhd
