// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The folder in which the vendor's driver keeps a file for each device that was set up, named as the device.

#include <filesystem>
#include <string>
#include <vector>

namespace forceshade::device {

struct DriverFolder {
  std::filesystem::path path;      // empty where no variable says where it is
  std::string problem;             // the reason why no names can be read; empty where they can
  std::vector<std::string> names;  // sorted, as hdInitDevice takes them: without the ending .config
};

// $GTDD_HOME/config or, where GTDD_HOME is not set, ~/.3dsystems/config, as the driver does (seen with its versions 3.0 and
// 3.4). Makes nothing.
DriverFolder driver_folder();

// The files in /dev through which a PHANToM is reached: /dev/ttyACM* and /dev/hidraw* over USB, /dev/fw* over FireWire.

struct DeviceNode {
  std::string path;  // in /dev
  bool accessible;   // this process may read and write it
  std::string group;
  bool vendors;  // USB identifies it as the vendor's
};

// Sorted by path. `root` is where /dev and /sys are.
std::vector<DeviceNode> device_nodes(const std::filesystem::path& root = "/");

}  // namespace forceshade::device
