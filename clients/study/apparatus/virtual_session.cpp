// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/virtual_session.h"

#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <numbers>

#include "device/simulated/steering.h"
#include "forceshade/checks.h"
#include "forceshade/device.h"
#include "study/apparatus/recorded_loop.h"
#include "study/apparatus/session_run.h"
#include "study/experiments/random.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/virtual_participant.h"

namespace forceshade::apparatus {
namespace {

using experiments::RecordedSession;
using experiments::Session;

// A simulated PHANToM for which aim() is called before every reading, in the loop's own thread; where it returns false, the
// data end. It may take its time, because such a loop is not paced.
class SteeredDevice final : public device::Device {
 public:
  SteeredDevice(std::unique_ptr<device::Device> device, std::function<bool()> aim)
      : device_(std::move(device)), aim_(std::move(aim)) {}

  device::Capabilities capabilities() const noexcept override { return device_->capabilities(); }
  std::optional<device::Fault> start(double rate) noexcept override { return device_->start(rate); }
  device::ReadResult read() noexcept override {
    try {
      if (!aim_()) return device::EndOfData{};
    } catch (...) {
      thrown_ = std::current_exception();
      return device::EndOfData{};
    }
    return device_->read();
  }
  void allow(const device::Allowance& allowance) noexcept override { device_->allow(allowance); }
  std::optional<device::Fault> command(const Eigen::Vector3f& force) noexcept override { return device_->command(force); }
  device::State state() const noexcept override { return device_->state(); }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::unique_ptr<device::Device> device_;
  std::function<bool()> aim_;
  std::exception_ptr thrown_;
};

struct SteeringOnly final : device::Attendant {
  device::Steering* steering() noexcept override { return &hand; }
  device::Steering hand;
};

// Steers the hand, tick by tick: a stroke across all bumps and back, and a moment in the air after each press.
class Hand {
 public:
  Hand(device::Steering& steering, double reach) : steering_(steering), reach_(reach) {}

  void begin_stroke() { tick_ = 0; }
  // False once the hand has nothing to do but to rest in the air.
  bool goes_on() {
    if (tick_ > kStroke + kRise) return false;
    const double share = std::min(1.0, static_cast<double>(tick_) / kStroke);
    // Down beside the bumps, across them, and up where it began.
    const double x = -reach_ * std::cos(2 * std::numbers::pi * share);
    steering_.aim({x, 0, tick_ < kDescent || tick_ > kStroke ? kAir : kDepth});
    ++tick_;
    return true;
  }
  // So many ticks in the air.
  void rest() { tick_ = kStroke + kRise - kBetweenPresses; }

 private:
  static constexpr int kStroke = 900, kDescent = 100, kRise = 60, kBetweenPresses = 8;  // ticks
  static constexpr double kAir = 8, kDepth = -3;                                        // mm
  device::Steering& steering_;
  double reach_;
  int tick_ = kStroke + kRise;
};

}  // namespace

std::size_t run_virtual_session(const VirtualPlan& plan, int number, const std::atomic<bool>& stop) {
  const std::string id = "V" + std::to_string(number);
  const std::uint64_t seed = experiments::Random(plan.seed, static_cast<std::uint64_t>(number)).next();
  const std::string name = "simulated:" + plan.model + ":mouse";
  RecordedSession recorded =
      RecordedSession::start(plan.out / id, plan.protocol, id, seed, {}, experiments::Sync::never,
                             origin_of(experiments::AnsweredBy::model, name, !plan.certificates.empty()));
  Session& session = recorded.session();
  const experiments::Protocol& protocol = session.protocol();
  Bumps bumps(protocol, read_until(stop));
  experiments::VirtualParticipant participant(protocol, experiments::fitted_observer(), experiments::feel_of_laws(protocol),
                                              seed + 1);
  SteeringOnly steered;
  Hand hand(steered.hand, (0.5 * protocol.spacing + protocol.width) * experiments::kMillimetresPerMil);
  std::unique_ptr<RecordedLoop> loop;
  int trial = 0;  // that the stroke was of
  const auto aim = [&] {
    if (stop) return false;
    if (hand.goes_on()) return true;
    if (session.is_over()) return false;
    const auto response = participant.next(session.screen(), session.scene());
    session.press(response.press, loop->seconds());
    loop->follow(session);
    const auto current = session.current();
    const int now = current ? 1000 * current->block + current->index : 0;
    if (current && now != trial)
      hand.begin_stroke();
    else
      hand.rest();
    trial = now;
    return true;
  };
  SteeredDevice device(device::open_device(name, steered), aim);
  loop = std::make_unique<RecordedLoop>(device, bumps,
                                        LoopPlan{.device = name,
                                                 .folder = recorded.ticks(),
                                                 .certificates = plan.certificates,
                                                 .origin = {0, 0, 0},
                                                 .metadata = {{"participant", id}, {"run", "1"}, {"virtual", "yes"}},
                                                 .servo = {.paced = false}},
                                        stop);
  loop->follow(session);
  loop->start();
  const device::ServoResult result = loop->stop_at_the_end();
  session.close(loop->seconds());
  device.rethrow();
  if (result.trip)
    throw std::runtime_error(id + ": the supervisor stopped the run: " + std::string(name_of(result.trip->rule)));
  if (!session.is_over() && stop) throw Interrupted("the sessions so far are in " + plan.out.string());
  return result.ticks;
}

}  // namespace forceshade::apparatus
