// SPDX-License-Identifier: BSD-3-Clause
// In place of the devices that speak JSON, in a build without the exact side, which needs neither Boost nor a JSON library.
#include "device/command/command.h"
#include "device/haply/haply.h"

namespace forceshade::device {
namespace {

std::string left_out(const char* kind) {
  return std::string("this build has no device ") + kind + ": it was configured without the feature exact-side";
}

}  // namespace

std::unique_ptr<Device> open_command(const std::string&, Attendant&, Forces) {
  throw DeviceError(left_out("command"));
}

std::unique_ptr<Device> open_haply(const std::string&, Attendant&, Forces) {
  throw DeviceError(left_out("haply"));
}

std::vector<Check> haply_checks(const std::string&) {
  return {{"service", Grade::unknown, left_out("haply")}};
}

}  // namespace forceshade::device
