// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// run_session() of the public header, of a session and of bumps that the caller has opened.

#include <atomic>
#include <functional>
#include <map>
#include <string>

#include "forceshade/apparatus.h"
#include "study/apparatus/bumps.h"
#include "study/experiments/session_folder.h"

namespace forceshade::apparatus {

struct RunPlan {
  std::string device;                               // its name, for the record
  std::map<std::string, std::string> certificates;  // certificates_of(); empty: uncertified
  Eigen::Vector3f origin{0, 0, 0};                  // mm
  device::ServoOptions servo = {};
  std::function<void(const std::string& words)> tell;  // what failed beside what is thrown
};

Outcome run_session(experiments::RecordedSession& recorded, Bumps& bumps, device::Device& device, Front& front,
                    const RunPlan& plan, const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
