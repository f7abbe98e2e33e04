// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/arms.h"

#include "device/frames/framed_device.h"

namespace forceshade::world {
namespace {

constexpr Ns kMillisecond = 1'000'000;

// A link that has no protocol.
class PlainLink final : public device::FrameLink {
 public:
  explicit PlainLink(Arm& arm) : arm_(arm) {}
  device::FrameState exchange(const Eigen::Vector3d& force) override { return arm_.frame(force); }
  void close() noexcept override {
    arm_.push({0, 0, 0});
    arm_.close();
  }

 private:
  Arm& arm_;
};

std::unique_ptr<device::Device> open_framed(Arm& arm) {
  static device::Attendant nobody;
  device::FramedDescription description{.name = "the arm", .partner = "the arm"};
  description.capabilities = {.workspace_low = Eigen::Vector3f::Constant(-100),
                              .workspace_high = Eigen::Vector3f::Constant(100),
                              .resolution = 0.05F,
                              .peak_force = 3,
                              .continuous_force = 1,
                              .buttons = 1};
  return std::make_unique<device::FramedDevice>(std::make_unique<PlainLink>(arm), description, kOptions, nobody);
}

Fault stands_still(Ns time, bool clock_goes_on) {
  return {std::string("the machine ") + (clock_goes_on ? "stands" : "and its clock stand") + " still for " +
              std::to_string(time / kMillisecond) + " ms",
          [=](World& world, Arm&) { world.stand_still(time, clock_goes_on); }};
}

Fault holds_thread(const char* name, const char* words, Ns time) {
  return {std::string(words) + " for " + std::to_string(time / kMillisecond) + " ms", [=](World& world, Arm&) {
            if (const int thread = world.thread(name); thread >= 0) world.hold(thread, time);
          }};
}

}  // namespace

ArmKind framed_arm() {
  return {"frames",
          open_framed,
          50 * kMillisecond,
          {{"the arm leaps by 10 mm", [](World&, Arm& arm) { arm.jump(); }, {"tripped: jump"}},
           {"it is not calibrated any more", [](World&, Arm& arm) { arm.is_calibrated = false; }, {"tripped: uncalibrated"}},
           {"its power is lost", [](World&, Arm& arm) { arm.has_forces_on = false; }}}};
}

std::vector<ArmKind> arms() {
  return {framed_arm(), dhd_arm(), command_arm(), haply_arm()};
}

std::vector<Fault> faults_of_the_machine() {
  std::vector<Fault> all;
  for (const Ns time : {1, 10, 60, 1000, 10'000})
    for (const bool clock_goes_on : {true, false}) all.push_back(stands_still(time * kMillisecond, clock_goes_on));
  for (const auto& [name, words] :
       {std::pair{"first", "the loop stands still"}, std::pair{"frames", "the thread of the frames stands still"},
        std::pair{"calls", "a call of the library stands still"}, std::pair{kPartner, "the partner stands still"}})
    all.push_back(holds_thread(name, words, 60 * kMillisecond));
  all.push_back(holds_thread("first", "the loop stands still", 14 * kMillisecond));
  all.push_back({"the loop dies", [](World& world, Arm&) { world.kill(kLoop); }});
  all.push_back({"the process dies", [](World& world, Arm& arm) {
                   if (world.processes() > 1) return world.kill_process(0);
                   for (int thread = 0; thread < world.threads(); ++thread)
                     if (world.name(thread) != kPartner) world.kill(thread);
                   arm.lose_client();
                 }});
  return all;
}

const std::vector<Part>& parts() {
  static const std::vector<Part> all{
      {"start", 495 * kMillisecond, 0.06},
      {"contact", 900 * kMillisecond, 0.45},
      {"trip", 899 * kMillisecond, 0.45, {{.frame = 900, .kind = Event::Kind::jump}}},
      {"end", 1099 * kMillisecond, 0.6},
  };
  return all;
}

Plan plan_for(const Part& part, const ArmKind& arm) {
  return {.seconds = part.seconds,
          .events = part.events,
          .own_watchdog = arm.own_watchdog,
          .may_be_lost = arm.may_be_lost,
          .longest_force = arm.longest_force};
}

}  // namespace forceshade::world
