// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/open_device.h"

#include <string_view>

#include "forceshade/device/null.h"
#include "forceshade/device/replay.h"

namespace forceshade::device {

std::unique_ptr<Device> open_device(const std::string& name) {
  if (name == "null") return std::make_unique<Null>();
  constexpr std::string_view kReplay = "replay:";
  if (name.starts_with(kReplay) && name.size() > kReplay.size())
    return std::make_unique<Replay>(Replay::load(name.substr(kReplay.size())));
  throw UnknownDevice("unknown device \"" + name + "\": expected null or replay:FILE.csv");
}

}  // namespace forceshade::device
