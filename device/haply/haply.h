// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A Haply Inverse3 through Haply's Inverse Service, a program that runs beside this one. docs/haply.md says what was taken from
// its documents, and what is assumed.

#include <memory>
#include <string>
#include <vector>

#include "device/check.h"
#include "device/frames/link.h"
#include "forceshade/device.h"

namespace forceshade::device::haply {

class Conversation;
struct Version;

// open_haply() over a connection that is open, to a service of this version. Throws DeviceError and std::runtime_error.
std::unique_ptr<Device> open(std::unique_ptr<Conversation> service, const Version& version, const std::string& name,
                             const FramedOptions& options, Attendant& attendant);

}  // namespace forceshade::device::haply

namespace forceshade::device {

// `name`: an id or a serial number that the service lists; empty: the only one. Connects and reads what the device is; commands
// nothing. The session is not begun again once it has ended. The attendant lives as long as the device. Throws DeviceError,
// with what to check.
std::unique_ptr<Device> open_haply(const std::string& name, const FramedOptions& options, Attendant& attendant);
std::unique_ptr<Device> open_haply(const std::string& name, Attendant& attendant, Forces forces);

// Checks that a service answers, and its version.
std::vector<Check> haply_checks(const std::string& name);

}  // namespace forceshade::device
