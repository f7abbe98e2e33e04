// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A PHANToM driven by the command, with a watchdog of 10 s.

#include <string>

#include "tests/device/stand_in_hd/phantom_fixture.h"
#include "tests/support/command_run.h"

namespace forceshade::device {

// Far from the surface, so that no force has to be held.
inline const Eigen::Vector3d kFree{0, 50, 0};

inline tests::CommandRun drive(const std::string& options) {
  const tests::TemporaryDirectory here;
  return tests::run_command(
      here, tests::words_of("drive --law wall --uncertified --device phantom --watchdog-timeout 10 --seconds 0.2 " + options));
}

}  // namespace forceshade::device
