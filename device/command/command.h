// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device that a third-party program drives: it answers each force with a position, in lines of JSON. The protocol is
// docs/command-device.md.

#include <memory>
#include <string>

#include "device/frames/link.h"
#include "forceshade/device.h"

namespace forceshade::files {
class LineProgram;
struct ProcessLimits;
}  // namespace forceshade::files

namespace forceshade::device::command {

// It drives hardware for as long as a run lasts, so that only what is not needed is limited.
files::ProcessLimits limits_of(const FramedOptions& options);

// open_command() with a program that was started. Throws files::ProcessFailed.
std::unique_ptr<Device> open(std::unique_ptr<files::LineProgram> program, const FramedOptions& options, Attendant& attendant);

}  // namespace forceshade::device::command

namespace forceshade::device {

// The program has to answer each force within 10 ms.
inline constexpr FramedOptions kCommandOptions{.answer = std::chrono::milliseconds(10)};

// `command`: how the shell starts the program. Starts it and waits for its hello; sends nothing. The attendant lives as long as
// the device. Throws DeviceError, with what the program did.
std::unique_ptr<Device> open_command(const std::string& command, const FramedOptions& options, Attendant& attendant);
std::unique_ptr<Device> open_command(const std::string& command, Attendant& attendant, Forces forces);

}  // namespace forceshade::device
