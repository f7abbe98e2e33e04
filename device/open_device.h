// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Devices by name, as the command line gives them.

#include <memory>
#include <stdexcept>
#include <string>

#include "device/attendant.h"
#include "device/device.h"

namespace forceshade::device {

// what() lists the kinds there are.
struct UnknownDevice : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The device, or the vendor's software for it, cannot be used. what() says why and what to check.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Whether a device may ever give a force. Where it is `never`, a real device's force output is never switched on.
enum class Forces { as_commanded, never };

// `name` is KIND or KIND:REST, for instance "replay:strokes.csv". No device moves by being opened. The attendant, who lives as
// long as the device, prepares one that cannot prepare itself; without one it is nobody. Throws UnknownDevice, or what the
// kind's own opener throws.
std::unique_ptr<Device> open_device(const std::string& name, Attendant& attendant, Forces forces = Forces::as_commanded);
std::unique_ptr<Device> open_device(const std::string& name);

}  // namespace forceshade::device
