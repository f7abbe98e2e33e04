// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// forceshade-study experiment virtual: several virtual participants at a time.

#include <filesystem>

#include "study/apparatus/virtual_session.h"

namespace forceshade::apps {

struct VirtualOptions {
  apparatus::VirtualPlan plan;         // without its certificates
  std::filesystem::path certificates;  // their folder; empty: uncertified
  int participants = 5;
  unsigned threads = 1;
};

// Says each session on standard output. Returns the exit code. Throws Interrupted.
int run_virtual(const VirtualOptions& options);

}  // namespace forceshade::apps
