// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session with a participant: their screen and keys, the device, the log and the recording, until it is over or interrupted.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment_apparatus.h"
#include "device/simulated/steering.h"
#include "study/experiments/session_folder.h"

namespace forceshade::apps {

// What the participant looks at and types into, in the main thread.
class Front {
 public:
  virtual ~Front() = default;

  // Shows what the session shows and where the tip is, at the latest tick, with what was felt there; waits a sixtieth of a
  // second or less. False once it was closed.
  virtual bool show(const experiments::Session& session, const std::optional<device::Sample>& latest,
                    const experiments::Scene& felt) = 0;

  // Since the last call, in their order.
  virtual std::vector<experiments::Press> presses() = 0;

  // Whether the last screen stays until a key is pressed.
  virtual bool waits_at_the_end() const { return true; }
};

struct SessionOptions {
  std::string device;
  std::filesystem::path certificates;  // empty: uncertified
  Eigen::Vector3f origin{0, 0, 0};     // mm
  bool in_reset_pose = false;
  device::ServoOptions servo = {};
};

// Opens the device, then the front (with bumps and, for a device that a mouse moves, where it steers), then the session: what
// fails before the session is there leaves no folder behind. Returns the exit code. Throws as they do.
using OpenFront = std::function<std::unique_ptr<Front>(Bumps& bumps, device::Steering& steering)>;
using OpenSession = std::function<experiments::RecordedSession()>;
int run_session(const experiments::Protocol& protocol, const SessionOptions& options, const OpenFront& open_front,
                const OpenSession& open_session);

}  // namespace forceshade::apps
