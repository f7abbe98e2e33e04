// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the table of kinds has of the Inverse3, in every build.

#include <memory>
#include <string>
#include <vector>

#include "device/check.h"
#include "forceshade/device.h"

namespace forceshade::device {

// `name` as in Haply. Throws DeviceError.
std::unique_ptr<Device> open_haply(const std::string& name, Attendant& attendant, Forces forces);

// Whether a service answers, and its version.
std::vector<Check> haply_checks(const std::string& name);

}  // namespace forceshade::device
