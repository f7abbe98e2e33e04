// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The files in /dev through which a PHANToM is reached: /dev/ttyACM* and /dev/hidraw* over USB, /dev/fw* over FireWire.

#include <filesystem>
#include <string>
#include <vector>

namespace forceshade::device {

struct DeviceNode {
  std::string path;  // in /dev
  bool accessible;   // this process may read and write it
  std::string group;
  bool vendors;  // USB identifies it as the vendor's
};

// Sorted by path. `root` is where /dev and /sys are.
std::vector<DeviceNode> device_nodes(const std::filesystem::path& root = "/");

}  // namespace forceshade::device
