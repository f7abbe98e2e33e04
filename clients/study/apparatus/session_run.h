// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// run_session() of the public header, of a session and of bumps that the caller has opened.

#include <atomic>
#include <functional>
#include <string>

#include "study/apparatus/apparatus.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/recorded_loop.h"
#include "study/experiments/session_folder.h"

namespace forceshade::apparatus {

// The origin of the answers of a run. device: the name with which it was opened.
experiments::Origin origin_of(experiments::AnsweredBy who, const std::string& device, bool is_certified);

// Called with words for the experimenter.
using Tell = std::function<void(const std::string& words)>;

// plan: without folder and metadata, which follow from the session. tell: what failed beside what is thrown.
Outcome run_session(experiments::RecordedSession& recorded, Bumps& bumps, device::Device& device, Front& front, LoopPlan plan,
                    const Tell& tell, const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
