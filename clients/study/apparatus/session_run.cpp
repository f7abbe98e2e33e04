// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/session_run.h"

#include <exception>
#include <utility>
#include <vector>

#include "device/kinds.h"
#include "study/apparatus/certificates.h"

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

// On a full disk more than one thing fails: the first is thrown, and the experimenter reads of the others.
template <class Work>
void tell_what_fails(const Tell& tell, const Work& work) {
  try {
    work();
  } catch (const std::exception& also) {
    tell(also.what());
  }
}

RecordedSession opened(const SessionPlan& plan) {
  using experiments::AnsweredBy;
  using experiments::Sync;
  const experiments::Origin origin =
      origin_of(plan.is_virtual ? AnsweredBy::model : AnsweredBy::person, plan.device, !plan.certificates.empty());
  if (plan.protocol.empty()) return RecordedSession::resume(plan.session, {}, Sync::each_event, origin);
  return RecordedSession::start(plan.session, plan.protocol, plan.participant, plan.seed, {}, Sync::each_event, origin);
}

}  // namespace

experiments::Origin origin_of(experiments::AnsweredBy who, const std::string& device, bool is_certified) {
  const bool is_said = device.starts_with("simulated") || !device::is_simulated(device);
  return {who, is_said ? device : device + " (simulated)", is_certified};
}

Outcome run_session(RecordedSession& recorded, Bumps& bumps, device::Device& device, Front& front, LoopPlan plan,
                    const Tell& tell, const std::atomic<bool>& stop) {
  plan.folder = recorded.ticks();
  plan.metadata = {{"participant", recorded.participant()}, {"run", std::to_string(recorded.run())}};
  RecordedLoop loop(device, bumps, std::move(plan), stop);
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
    if (!was_stopped) tell_what_fails(tell, [&] { loop.stop(); });
    tell_what_fails(tell, [&] { session.close(loop.seconds()); });
    throw;
  }
  session.close(loop.seconds());
  outcome.is_over = session.is_over();
  return outcome;
}

Outcome run_session(const SessionPlan& plan, device::Device& device, Front& front, const std::atomic<bool>& stop) {
  Bumps bumps(
      plan.protocol.empty() ? experiments::read_session(plan.session).protocol : experiments::read_protocol(plan.protocol),
      read_until(stop));
  LoopPlan loop{.device = plan.device, .folder = {}, .certificates = {}, .origin = plan.origin, .servo = plan.servo};
  if (!plan.certificates.empty()) loop.certificates = certificates_of(bumps, plan.certificates);
  RecordedSession recorded = opened(plan);
  if (!recorded.note().empty()) plan.tell(recorded.note());
  return run_session(recorded, bumps, device, front, std::move(loop), plan.tell, stop);
}

}  // namespace forceshade::apparatus
