// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session with a participant at the command line: the device, the participant's screen and keys, the experimenter's line.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "device/simulated/steering.h"
#include "study/apparatus/apparatus.h"
#include "study/apparatus/bumps.h"
#include "study/experiments/session_folder.h"

namespace forceshade::apps {

struct SessionOptions {
  std::string device;
  std::filesystem::path certificates;  // empty: uncertified
  Eigen::Vector3f origin{0, 0, 0};     // mm
  bool in_reset_pose = false;
  device::ServoOptions servo = {};
};

// Opens the device, then the front (with bumps and, for a device that a mouse moves, where it steers, else null), then the
// session: what fails before the session is there leaves no folder behind. Returns the exit code. Throws as they do.
using OpenFront = std::function<std::unique_ptr<apparatus::Front>(apparatus::Bumps& bumps, device::Steering* steering)>;
using OpenSession = std::function<experiments::RecordedSession()>;
int run_session(const experiments::Protocol& protocol, const SessionOptions& options, const OpenFront& open_front,
                const OpenSession& open_session);

}  // namespace forceshade::apps
