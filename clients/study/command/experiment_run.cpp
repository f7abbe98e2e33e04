// SPDX-License-Identifier: BSD-3-Clause
#include "study/command/experiment_run.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/command.h"
#include "apps/device_run.h"
#include "apps/live_line.h"
#include "apps/signals.h"
#include "apps/steering_attendant.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "apps/trip_words.h"
#include "run/rule_names.h"
#include "study/apparatus/certificates.h"
#include "study/apparatus/session_run.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

// Draws the experimenter's line in the terminal beside what the participant sees: trial, time, force, safety.
class WatchedFront final : public apparatus::Front {
 public:
  WatchedFront(Front& participants, double full_force)
      : participants_(participants), full_force_(full_force), is_watched_(isatty(STDERR_FILENO) != 0) {}
  ~WatchedFront() override {
    if (is_watched_) std::fprintf(stderr, "\r\033[K");
  }
  WatchedFront(const WatchedFront&) = delete;
  WatchedFront& operator=(const WatchedFront&) = delete;

  bool show(const experiments::Screen& screen, const std::optional<device::Sample>& latest,
            const experiments::Scene& felt) override {
    draw(screen, latest);
    return participants_.show(screen, latest, felt);
  }
  std::vector<experiments::Press> presses() override { return participants_.presses(); }
  bool waits_at_the_end() const override { return participants_.waits_at_the_end(); }

 private:
  void draw(const experiments::Screen& screen, const std::optional<device::Sample>& latest) {
    const std::int64_t now = system::now();
    if (!is_watched_ || !latest || now < next_) return;
    next_ = now + system::in_ns(std::chrono::milliseconds(100));
    std::string place = "between trials";
    if (screen.trial > 0)
      place = (screen.is_practice ? "practice" : "block " + std::to_string(screen.block)) + ", trial " +
              std::to_string(screen.trial) + " of " + std::to_string(screen.trials);
    const double seconds = static_cast<double>(latest->wall_ns) / 1e9,
                 rate = static_cast<double>(latest->tick - before_.tick) / std::max(seconds - before_seconds_, 1e-9);
    before_ = *latest;
    before_seconds_ = seconds;
    const double force = std::hypot(static_cast<double>(latest->force[0]), static_cast<double>(latest->force[1]),
                                    static_cast<double>(latest->force[2]));
    place += "  ";
    draw_line(place + live_line({seconds, rate, static_cast<double>(latest->wakeup_ns) / 1e3, force, full_force_,
                                 latest->energy, run::joined_rule_names(latest->limited)},
                                room_for_a_line() - static_cast<int>(place.size())));
  }

  Front& participants_;
  double full_force_;
  bool is_watched_;
  std::int64_t next_ = 0;
  device::Sample before_;
  double before_seconds_ = 0;
};

std::string words_of_resume(const experiments::RecordedSession& recorded) {
  return "the session is kept; 'forceshade-study experiment resume " + recorded.folder().string() + "' goes on with it";
}

int code_of(const apparatus::Outcome& outcome, const experiments::RecordedSession& recorded) {
  const device::ServoResult& result = outcome.result;
  const std::string resume = words_of_resume(recorded);
  if (result.trip || result.end_reason == device::EndReason::device_fault) {
    tell(result.trip ? "the supervisor stopped the run: " + words_of_trip(result)
                     : "device fault: " + std::string(result.fault));
    tell(resume);
    return kDeviceFault;
  }
  if (outcome.is_over) return kHeld;
  if (result.end_reason == device::EndReason::end_of_data) tell("the device has no more readings");
  if (const std::string signal = interrupting_signal(); !signal.empty()) tell(signal + " ended the run");
  tell(resume);
  return kHeld;
}

}  // namespace

int run_session(const experiments::Protocol& protocol, const SessionOptions& options, const OpenFront& open_front,
                const OpenSession& open_session) {
  apparatus::Bumps bumps(protocol, read_with_progress);
  apparatus::LoopPlan plan{
      .device = options.device, .folder = {}, .certificates = {}, .origin = options.origin, .servo = options.servo};
  if (!options.certificates.empty())
    plan.certificates = apparatus::certificates_of(bumps, options.certificates);
  else
    tell("*** DRIVING UNCERTIFIED, because of --certificates none ***");

  end_runs_in_order();
  SteeringAttendant person(options.in_reset_pose, options.servo.dead_man_button.has_value(),
                           [&] { return Eigen::Vector3d(options.origin.cast<double>() + Eigen::Vector3d(0, 0, 20)); });
  const std::unique_ptr<device::Device> device = open_for_a_run(options.device, person);
  warn_if_active(static_cast<double>(protocol.stiffness), device->capabilities(), options.servo.rate_hz,
                 bumps.damping(options.servo.rate_hz));
  const std::unique_ptr<apparatus::Front> front = open_front(bumps, person.steered());
  experiments::RecordedSession recorded = open_session();
  if (!recorded.note().empty()) tell(recorded.note());
  const double peak = static_cast<double>(device->capabilities().peak_force);
  apparatus::Outcome outcome;
  try {
    WatchedFront watched(*front, std::isfinite(peak) ? peak : 5);
    outcome = apparatus::run_session(recorded, bumps, *device, watched, std::move(plan), tell, interrupted());
  } catch (...) {
    if (!recorded.session().is_over()) tell(words_of_resume(recorded));
    throw;
  }
  std::printf("run %d of %s: %zu ticks (%s), %zu late\n", outcome.run, recorded.participant().c_str(), outcome.result.ticks,
              name_of(outcome.result.end_reason).data(), outcome.result.missed_deadlines);
  return code_of(outcome, recorded);
}

}  // namespace forceshade::apps
