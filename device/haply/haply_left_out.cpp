// SPDX-License-Identifier: BSD-3-Clause
// In place of the Inverse3 where the build has neither Boost nor a JSON library (FORCESHADE_FAST_ONLY).
#include "device/haply/haply.h"

namespace forceshade::device {
namespace {

constexpr const char* kLeftOut = "this build has no Inverse3: it was configured with FORCESHADE_FAST_ONLY";

}  // namespace

std::unique_ptr<Device> open_haply(const std::string&, Attendant&, Forces) {
  throw DeviceError(kLeftOut);
}

std::vector<Check> haply_checks(const std::string&) {
  return {{"service", Grade::unknown, kLeftOut}};
}

}  // namespace forceshade::device
