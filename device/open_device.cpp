// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "device/null.h"
#include "device/phantom/phantom.h"
#include "device/simulated/simulated.h"
#include "forceshade/device.h"

namespace forceshade::device {

std::unique_ptr<Device> open_device(const std::string& name, Attendant& attendant, Forces forces) {
  if (name == "null") return std::make_unique<Null>();
  constexpr std::string_view kReplay = "replay:";
  if (name.starts_with(kReplay) && name.size() > kReplay.size())
    return std::make_unique<Replay>(Replay::load(name.substr(kReplay.size())));
  constexpr std::string_view kSimulated = "simulated";
  if (name == kSimulated) return open_simulated("", attendant);
  if (name.starts_with(kSimulated) && name[kSimulated.size()] == ':')
    return open_simulated(name.substr(kSimulated.size() + 1), attendant);
  constexpr std::string_view kPhantom = "phantom";
  if (name == kPhantom) return open_phantom("", attendant, forces);
  if (name.starts_with(kPhantom) && name[kPhantom.size()] == ':' && name.size() > kPhantom.size() + 1)
    return open_phantom(name.substr(kPhantom.size() + 1), attendant, forces);
  throw UnknownDevice("unknown device \"" + name +
                      "\": expected null, replay:FILE.csv, simulated[:MODEL[:RECORDING.csv or :mouse]] or phantom[:NAME]");
}

std::unique_ptr<Device> open_device(const std::string& name) {
  static Attendant nobody;
  return open_device(name, nobody);
}

}  // namespace forceshade::device
