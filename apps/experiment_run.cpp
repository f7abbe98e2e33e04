// SPDX-License-Identifier: BSD-3-Clause
#include "apps/experiment_run.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/command.h"
#include "apps/device_run.h"
#include "apps/experiment_certificates.h"
#include "apps/live_line.h"
#include "apps/signals.h"
#include "apps/trip_words.h"
#include "device/run/rule_names.h"
#include "files/printable.h"

namespace forceshade::apps {
namespace {

using experiments::Session;

// Prepares the device as another one does, and steers a simulated hand besides.
class SteeringAttendant final : public device::Attendant {
 public:
  SteeringAttendant(bool in_reset_pose, bool with_buttons, device::Steering& steering)
      : person_(attendant(in_reset_pose, with_buttons)), steering_(steering) {}

  void report(const std::string& words) noexcept override { person_->report(words); }
  bool did(const std::string& words) noexcept override { return person_->did(words); }
  bool has_left() const noexcept override { return person_->has_left(); }
  const std::atomic<std::uint16_t>* buttons() noexcept override { return person_->buttons(); }
  device::Steering* steering() noexcept override { return &steering_; }

 private:
  std::unique_ptr<device::Attendant> person_;
  device::Steering& steering_;
};

// The experimenter's line in the terminal: trial, time, force, safety.
class Watch {
 public:
  explicit Watch(double full_force) : full_force_(full_force), is_watched_(isatty(STDERR_FILENO) != 0) {}
  ~Watch() {
    if (is_watched_) std::fprintf(stderr, "\r\033[K");
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void draw(const Session& session, const std::optional<device::Sample>& latest) {
    const auto now = std::chrono::steady_clock::now();
    if (!is_watched_ || !latest || now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    const experiments::Screen screen = session.screen();
    std::string place = "between trials";
    if (const auto current = session.current())
      place = (current->is_practice ? "practice" : "block " + std::to_string(current->block)) + ", trial " +
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

 private:
  double full_force_;
  bool is_watched_;
  std::chrono::steady_clock::time_point next_;
  device::Sample before_;
  double before_seconds_ = 0;
};

void press_all(Session& session, Apparatus& apparatus, const std::vector<experiments::Press>& presses) {
  for (const experiments::Press& press : presses) {
    session.press(press, apparatus.seconds());
    apparatus.follow(session);
  }
}

// Until the session is over and left, the front is closed, a signal came or the loop has ended.
void go_through(Session& session, Apparatus& apparatus, Front& front, double full_force) {
  Watch watch(full_force);
  apparatus.follow(session);
  apparatus.start();
  while (!interrupted() && !apparatus.has_ended()) {
    const auto latest = apparatus.latest();
    const bool is_open = front.show(session, latest, latest ? apparatus.felt(*latest) : experiments::Scene{});
    const std::vector<experiments::Press> presses = front.presses();
    if (session.is_over() && (!presses.empty() || !front.waits_at_the_end())) return;
    press_all(session, apparatus, presses);
    if (!is_open) return;
    apparatus.follow(session);
    watch.draw(session, latest);
  }
}

void tell_experimenter(const std::string& words) {
  std::fprintf(stderr, "forceshade: %s\n", files::printable(words).c_str());
}

std::string words_of_resume(const experiments::RecordedSession& recorded) {
  return "the session is kept; 'forceshade experiment resume " + recorded.folder().string() + "' goes on with it";
}

// On a full disk more than one thing fails: what fails later is said, and what failed first is thrown.
template <class Work>
void say_what_fails(const Work& work) {
  try {
    work();
  } catch (const std::exception& also) {
    tell_experimenter(also.what());
  }
}

int code_of(const device::ServoResult& result, const experiments::RecordedSession& recorded) {
  const std::string resume = words_of_resume(recorded);
  if (result.trip || result.end_reason == device::EndReason::device_fault) {
    tell_experimenter(result.trip ? "the supervisor stopped the run: " + words_of_trip(result)
                                  : "device fault: " + std::string(result.fault));
    tell_experimenter(resume);
    return kDeviceFault;
  }
  if (recorded.session().is_over()) return kHeld;
  if (result.end_reason == device::EndReason::end_of_data) tell_experimenter("the device has no more readings");
  if (const std::string signal = interrupting_signal(); !signal.empty()) tell_experimenter(signal + " ended the run");
  tell_experimenter(resume);
  return kHeld;
}

}  // namespace

int run_session(const experiments::Protocol& protocol, const SessionOptions& options, const OpenFront& open_front,
                const OpenSession& open_session) {
  Bumps bumps(protocol);
  ApparatusPlan plan{.device = options.device,
                     .folder = {},
                     .certificates = {},
                     .origin = options.origin,
                     .metadata = {},
                     .servo = options.servo};
  if (!options.certificates.empty())
    plan.certificates = certificates_of(bumps, options.certificates);
  else
    tell_experimenter("*** DRIVING UNCERTIFIED, because of --uncertified ***");

  end_runs_in_order();
  device::Steering steering({static_cast<double>(options.origin.x()), static_cast<double>(options.origin.y()),
                             static_cast<double>(options.origin.z()) + 20});
  SteeringAttendant person(options.in_reset_pose, options.servo.dead_man_button.has_value(), steering);
  const std::unique_ptr<device::Device> device = open_for_a_run(options.device, person);
  const std::unique_ptr<Front> front = open_front(bumps, steering);
  experiments::RecordedSession recorded = open_session();
  if (!recorded.note().empty()) tell_experimenter(recorded.note());
  plan.folder = recorded.ticks();
  plan.metadata = {{"participant", recorded.participant()}, {"run", std::to_string(recorded.run())}};
  const double peak = static_cast<double>(device->capabilities().peak_force);
  Apparatus apparatus(*device, bumps, std::move(plan));
  Session& session = recorded.session();
  device::ServoResult result;
  bool was_stopped = false;
  try {
    go_through(session, apparatus, *front, std::isfinite(peak) ? peak : 5);
    was_stopped = true;
    result = apparatus.stop();
  } catch (...) {
    // Zero force first, then the log.
    if (!was_stopped) say_what_fails([&] { apparatus.stop(); });
    say_what_fails([&] { session.close(apparatus.seconds()); });
    if (!session.is_over()) tell_experimenter(words_of_resume(recorded));
    throw;
  }
  session.close(apparatus.seconds());
  std::printf("run %d of %s: %zu ticks (%s), %zu late\n", recorded.run(), recorded.participant().c_str(), result.ticks,
              name_of(result.end_reason).data(), result.missed_deadlines);
  return code_of(result, recorded);
}

}  // namespace forceshade::apps
