// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device that renders what a session shows, in a thread of its own, with every tick recorded.

#include <atomic>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "device/latest_tick.h"
#include "forceshade/servo_loop.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/parts.h"
#include "study/apparatus/stage.h"
#include "study/experiments/session.h"
#include "system/system.h"

namespace forceshade::apparatus {

struct LoopPlan {
  std::string device;                               // its name, for the record
  std::filesystem::path folder;                     // of this run's ticks; it does not exist yet
  std::map<std::string, std::string> certificates;  // digests by certificate_name(); empty: uncertified
  Eigen::Vector3f origin{0, 0, 0};                  // mm, of the scene in the device's frame
  recorder::Metadata metadata = {};                 // of each part, beside what the loop adds
  device::ServoOptions servo = {};                  // its placement stays as it is: the stage places the bumps
};

// Two kinds of file are in the folder. NUMBER-PLACE.fsr are the parts of the run, one for each trial and one for each time
// between trials; together they hold every tick once. stimuli.jsonl has a line for each stimulus that the stage was offered,
// written before the offer: what `shown` in the ticks means.
class RecordedLoop {
 public:
  // Makes the folder. Device, bumps and stop live longer; stop ends the loop, whatever the calling thread does. Throws Error
  // or Error.
  RecordedLoop(device::Device& device, Bumps& bumps, LoopPlan plan, const std::atomic<bool>& stop);
  // Stops where stop() was not called.
  ~RecordedLoop();
  RecordedLoop(const RecordedLoop&) = delete;
  RecordedLoop& operator=(const RecordedLoop&) = delete;

  // The loop begins, in its own thread.
  void start();

  // Offers the session's present scene to the loop, and begins the part of a new trial. Call after every press, and often
  // meanwhile. Throws Error where the disk has refused.
  void follow(const experiments::Session& session);

  // s since the first tick: by this machine's clock, and by the device's where the run is not paced.
  double seconds();
  // The latest tick; none before the first.
  std::optional<device::Sample> latest() { return latest_.latest(); }
  // The scene that was felt at the tick; call it by rising ticks. A bump that was changed under the tip is exchanged later
  // (stage.h): until then this is what the session showed before.
  experiments::Scene felt(const device::Sample& tick);

  bool has_ended() const noexcept { return ended_; }

  // The loop ends with zero force, and the recording with it. Throws what the loop threw, and Error for ticks that
  // were lost.
  device::ServoResult stop();
  // The same, once the device has ended the loop.
  device::ServoResult stop_at_the_end();

 private:
  void begin_part(const experiments::Session& session);
  void offer(const experiments::Scene& scene);

  device::Device& device_;
  Bumps& bumps_;
  LoopPlan plan_;
  Stage stage_;
  Parts parts_;
  std::atomic<bool> stop_ = false, ended_ = false;
  device::LatestTick latest_;
  std::ofstream stimuli_;
  system::Thread loop_;
  device::ServoResult result_;
  std::exception_ptr thrown_;

  std::optional<experiments::Scene> offered_;
  std::map<std::uint32_t, experiments::Scene> scenes_;  // by number: what is felt, and what was offered since
  std::uint32_t number_ = 0;
  int part_ = 0;
  std::string place_;  // of the part: "block-1-trial-7-1", "between"
};

}  // namespace forceshade::apparatus
