// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one place that decides what each signal does to a command. The table for users: docs/device.md, "Signals".

#include <atomic>
#include <string>

namespace forceshade::apps {

// True once a signal came that is to end the work.
const std::atomic<bool>& interrupted();

// The first such signal, for instance "SIGINT"; empty where none came.
std::string interrupting_signal();

// For a computation: SIGINT, SIGTERM and, unless it was ignored as by nohup, SIGHUP interrupt it. A second one ends the program
// at once, because nothing is lost by it.
void watch_for_interrupt();

// For a run on a device, called before the device is opened. Every signal that would stop or end the process by default ends
// the run in order: zero force, the recording closed, the summary written. Those that report a failed write are ignored, and
// the write says why it failed. Faults of the program (SIGSEGV, SIGABRT and the like) keep the system's reaction.
// A second signal does not disturb the end; docs/device.md says when a third one ends the program at once.
void end_runs_in_order();

}  // namespace forceshade::apps
