// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/session_run.h"

#include <exception>
#include <vector>

#include "forceshade/checks.h"
#include "rendering/subjects/read.h"
#include "study/apparatus/certificates.h"
#include "study/apparatus/recorded_loop.h"

namespace forceshade::apparatus {
namespace {

using experiments::RecordedSession;
using experiments::Session;

void press_all(Session& session, RecordedLoop& loop, const std::vector<experiments::Press>& presses) {
  for (const experiments::Press& press : presses) {
    session.press(press, loop.seconds());
    loop.follow(session);
  }
}

// Until the session is over and left, the front is closed, stop was set or the loop has ended.
void go_through(Session& session, RecordedLoop& loop, Front& front, const std::atomic<bool>& stop) {
  loop.follow(session);
  loop.start();
  while (!stop && !loop.has_ended()) {
    const auto latest = loop.latest();
    const bool is_open = front.show(session.screen(), latest, latest ? loop.felt(*latest) : experiments::Scene{});
    const std::vector<experiments::Press> presses = front.presses();
    if (session.is_over() && (!presses.empty() || !front.waits_at_the_end())) return;
    press_all(session, loop, presses);
    if (!is_open) return;
    loop.follow(session);
  }
}

// On a full disk more than one thing fails: what fails later is told, and what failed first is thrown.
template <class Work>
void tell_what_fails(const RunPlan& plan, const Work& work) {
  try {
    work();
  } catch (const std::exception& also) {
    plan.tell(also.what());
  }
}

RecordedSession opened(const SessionPlan& plan) {
  if (plan.protocol.empty()) return RecordedSession::resume(plan.session);
  return RecordedSession::start(plan.session, plan.protocol, plan.participant, plan.seed);
}

}  // namespace

Outcome run_session(RecordedSession& recorded, Bumps& bumps, device::Device& device, Front& front, const RunPlan& plan,
                    const std::atomic<bool>& stop) {
  RecordedLoop loop(device, bumps,
                    {.device = plan.device,
                     .folder = recorded.ticks(),
                     .certificates = plan.certificates,
                     .origin = plan.origin,
                     .metadata = {{"participant", recorded.participant()}, {"run", std::to_string(recorded.run())}},
                     .servo = plan.servo},
                    stop);
  Session& session = recorded.session();
  Outcome outcome;
  outcome.run = recorded.run();
  bool was_stopped = false;
  try {
    go_through(session, loop, front, stop);
    was_stopped = true;
    outcome.result = loop.stop();
  } catch (...) {
    // Zero force first, then the log.
    if (!was_stopped) tell_what_fails(plan, [&] { loop.stop(); });
    tell_what_fails(plan, [&] { session.close(loop.seconds()); });
    throw;
  }
  session.close(loop.seconds());
  outcome.is_over = session.is_over();
  return outcome;
}

Outcome run_session(const SessionPlan& plan, device::Device& device, Front& front, const std::atomic<bool>& stop) {
  const Monitor monitor([](double) {}, stop);
  Bumps bumps(
      plan.protocol.empty() ? experiments::read_session(plan.session).protocol : experiments::read_protocol(plan.protocol),
      [&](const auto& words) { return subjects::read_one(words, monitor); });
  RunPlan run{.device = plan.device, .certificates = {}, .origin = plan.origin, .servo = plan.servo, .tell = plan.tell};
  if (!plan.certificates.empty()) run.certificates = certificates_of(bumps, plan.certificates);
  RecordedSession recorded = opened(plan);
  if (!recorded.note().empty()) plan.tell(recorded.note());
  return run_session(recorded, bumps, device, front, run, stop);
}

}  // namespace forceshade::apparatus
