// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the vendor's driver keeps one file for each device that was set up: the file's name is the device's.

#include <filesystem>
#include <string>
#include <vector>

namespace forceshade::device {

struct DriverFolder {
  std::filesystem::path path;      // empty where no variable says where it is
  std::string problem;             // why no names can be read; empty where they can
  std::vector<std::string> names;  // sorted, as hdInitDevice takes them: without the ending .config
};

// $GTDD_HOME/config or, where GTDD_HOME is not set, ~/.3dsystems/config, as the driver does (seen with its versions 3.0 and
// 3.4). Makes nothing.
DriverFolder driver_folder();

}  // namespace forceshade::device
