// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session of an experiment with a participant, on a device: screens and keys, the servo loop, the log of the trials and every
// tick recorded. Nothing of the exact side is linked.
//
//   const auto device = device::open_device("phantom");
//   struct Keys : apparatus::Front {
//     using Tick = std::optional<device::Sample>;
//     bool show(const experiments::Screen&, const Tick&, const experiments::Scene&) override { return true; }
//     std::vector<experiments::Press> presses() override { return {}; }
//   } front;
//   const std::atomic<bool> stop = false;
//   const apparatus::SessionPlan plan{
//       .session = "P01", .protocol = "mine.toml", .participant = "P01", .certificates = "certificates", .device = "phantom"};
//   const apparatus::Outcome outcome = apparatus::run_session(plan, *device, front, stop);
//
// Lengths are in mm, forces in N, times in s; those of an experiment's stimuli in mil. A session is a folder, which the log
// keeps whole through a crash (clients/study/README.md).
//
// Errors: run_session() throws std::runtime_error, and leaves no folder behind where it throws before the session is there.
// A run that the supervisor or the device ended is no exception: Outcome says it.
//
// Threads: the front is called in the thread that called run_session(), the device in one that it starts. `stop` may be set by
// any thread or a signal handler.
//
// Not promised: that run_session() demands certificates. Without SessionPlan::certificates it drives all the same, and every
// recording of the session says so.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "forceshade/device.h"
#include "forceshade/servo_loop.h"
#include "study/experiments/participant.h"

namespace forceshade::apparatus {

// The participant's screen and keys.
class Front {
 public:
  virtual ~Front() = default;

  // Shows the screen and where the tip is, at the latest tick, with what was felt there; waits a sixtieth of a second or less.
  // False once it was closed, which ends the run and keeps the session.
  virtual bool show(const experiments::Screen& screen, const std::optional<device::Sample>& latest,
                    const experiments::Scene& felt) = 0;

  // Since the last call, in their order.
  virtual std::vector<experiments::Press> presses() = 0;

  // True if the last screen stays until a key is pressed.
  virtual bool waits_at_the_end() const { return true; }
};

struct SessionPlan {
  std::filesystem::path session;            // the folder that a new session makes, or that of the session that goes on
  std::filesystem::path protocol = {};      // of a new session, a TOML file; empty: the session goes on that is in the folder
  std::string participant = {};             // of a new session: a pseudonym of 1 to 32 letters, digits and dashes
  std::uint64_t seed = 1;                   // of a new session's order of trials
  std::filesystem::path certificates = {};  // the folder of prepare(); empty: uncertified
  std::string device;                       // its name, for the record
  Eigen::Vector3f origin{0, 0, 0};          // mm: the middle of the scene in the device's workspace
  device::ServoOptions servo = {};          // its placement stays as it is
  bool is_virtual = false;                  // a model answers, and no person: the session says so, and all that is made of it

  // Called with words for the experimenter: what was repaired in the log, or failed beside what is thrown.
  std::function<void(const std::string& words)> tell = [](const std::string&) {};
};

struct Outcome {
  device::ServoResult result;
  int run = 1;           // of the session, from 1: how often it was begun or went on
  bool is_over = false;  // every trial is done; otherwise the session can go on
};

// Blocks until the session is over and left, the front is closed, stop is set or the device has ended. Throws
// std::runtime_error: a protocol, a session or a certificate that is refused, a folder that is there already, a disk that
// refuses the ticks.
Outcome run_session(const SessionPlan& plan, device::Device& device, Front& front, const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
