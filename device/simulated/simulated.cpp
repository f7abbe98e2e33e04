// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/simulated.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forceshade/device.h"
#include "text/joined.h"

namespace forceshade::device {
namespace {

Eigen::Vector3d metres(const Eigen::Vector3d& millimetres_in_law) noexcept {
  return kMillimetre * turned_to_arm(millimetres_in_law);
}

// The first one where no name is given. Throws Error.
Model simulated_model(const std::string& name) {
  for (const auto& make : kModels)
    if (const Model model = make(); name.empty() || name == model.name) return model;
  throw Error("unknown model \"" + name + "\" to simulate: expected one of " +
              joined(kModels, ", ", [](const auto& make) { return make().name; }));
}

// N·s/m at the tip, in the reset pose, in which the Jacobian is diagonal.
double least_damping(const Model& model) noexcept {
  const Eigen::Array3d levers(model.arm.upper_length, model.arm.upper_length, model.arm.fore_length);
  return (model.viscous.array() / levers.square()).minCoeff();
}

}  // namespace

Simulated::Simulated(const Model& model, std::optional<Operator> hand, const Options& options)
    : model_(model), hand_(std::move(hand)), options_(options), plant_{model.arm, model.coulomb, model.viscous, std::nullopt} {
  if (hand_) plant_.grip = hand_->grip;
  motion_.angles = options_.start;
}

Capabilities Simulated::capabilities() const noexcept {
  const Sheet& sheet = model_.sheet;
  const Eigen::Vector3f corner = 0.5F * sheet.workspace.cast<float>();
  return {.model = model_.name,
          .workspace_low = -corner,
          .workspace_high = corner,
          .resolution = static_cast<float>(sheet.resolution),
          .peak_force = static_cast<float>(sheet.peak_force),
          .continuous_force = static_cast<float>(sheet.continuous_force),
          .moves_an_arm = false,
          .latency = options_.latency,
          .friction = static_cast<float>(sheet.friction),
          .damping = static_cast<float>(least_damping(model_)),
          .buttons = options_.buttons != nullptr ? Attendant::kButtons : 0};
}

// At the reading that comes next.
Target Simulated::next_meant() noexcept {
  const double time = static_cast<double>(readings_) * period_;
  const Target meant = options_.steering != nullptr ? options_.steering->next(period_) : hand_->intention.at(time);
  const Target shake = hand_->tremor.at(time);
  return {meant.position + shake.position, meant.velocity + shake.velocity};
}

std::optional<Fault> Simulated::start(double rate) noexcept {
  period_ = 1 / rate;
  if (!hand_) return std::nullopt;
  if (options_.steering != nullptr) options_.steering->stay_within(0.5 * model_.sheet.workspace);
  meant_ = next_meant();
  motion_.hand = metres(meant_.position);
  motion_.hand_velocity.setZero();
  const auto angles = model_.arm.inverse(motion_.hand);
  if (!angles) return Fault{"the simulated hand starts where the arm does not reach"};
  motion_.angles = *angles;
  return std::nullopt;
}

ReadResult Simulated::read() noexcept {
  if (period_ == 0) return Fault{"the simulated device was not started"};
  if (hand_ && hand_->ends && static_cast<double>(readings_) * period_ > hand_->intention.end()) return EndOfData{};
  if (readings_ > 0) {
    HermiteStep way;
    if (hand_) {
      const Target from = std::exchange(meant_, next_meant()), &to = meant_;
      way = {metres(from.position), metres(from.velocity), metres(to.position), metres(to.velocity)};
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(options_.step_rate * period_ - 1e-9)));
    motion_ = plant_.advanced(motion_, torque_, way, period_, steps);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      heat_[i] = heated(model_.motor, heat_[i], torque_[joint] / model_.gears[joint], period_);
    }
  }
  if (!motion_.angles.allFinite()) return Fault{"the simulated arm's position is no longer finite"};
  std::array<std::int64_t, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    const double q = model_.quantum[joint];
    measured_[joint] = motion_.angles[joint];
    if (q == 0) continue;
    counts[i] = std::llround(motion_.angles[joint] / q);
    measured_[joint] = static_cast<double>(counts[i]) * q;
  }
  const Eigen::Vector3d position = turned_to_law(model_.arm.forward(measured_)) / kMillimetre;
  Reading reading{.position = position.cast<float>(), .time = static_cast<double>(readings_++) * period_};
  if (!model_.quantum.isZero(0)) reading.encoder = counts;
  if (options_.buttons != nullptr) reading.buttons = options_.buttons->load(std::memory_order_relaxed);
  reading.joints = {measured_[0], measured_[1], measured_[2]};
  sent_.arrived(reading.position.cast<double>());
  torque_.setZero();
  if (options_.latency) send(commanded_);
  reading.sent = sent_.report();
  return reading;
}

void Simulated::send(const Eigen::Vector3d& force) noexcept {
  Eigen::Vector3d limits;
  for (std::size_t i = 0; i < 3; ++i) limits[static_cast<Eigen::Index>(i)] = torque_limit(model_.motor, heat_[i]);
  const Joints torque = model_.arm.jacobian(measured_).transpose() * turned_to_arm(sent_.send(force));
  torque_ = delivered(model_.motor, model_.gears, limits, torque);
}

std::optional<Fault> Simulated::command(const Eigen::Vector3f& force) noexcept {
  const bool finite = force.allFinite();
  commanded_.setZero();
  if (finite) commanded_ = force.cast<double>();
  if (!options_.latency) send(commanded_);
  if (!finite) return Fault{"a force that is not finite was commanded"};
  return std::nullopt;
}

State Simulated::state() const noexcept {
  double hottest = 0;
  for (const Heat& heat : heat_) hottest = std::max(hottest, heat.total());
  return {.forces_on = period_ > 0, .temperature = static_cast<float>(hottest)};
}

Eigen::Vector3d Simulated::tip() const noexcept {
  return turned_to_law(model_.arm.forward(motion_.angles)) / kMillimetre;
}

std::unique_ptr<Device> open_simulated(const std::string& rest, Attendant& attendant) {
  const std::size_t colon = std::min(rest.find(':'), rest.size());
  const std::string name = rest.substr(0, colon);
  if (colon != rest.size() && rest.substr(colon + 1) == "mouse") return open_mouse(name, attendant);
  const Model model = simulated_model(name);
  const Simulated::Options options{.buttons = attendant.buttons()};
  if (colon == rest.size())
    return std::make_unique<Simulated>(model, Operator{Grip{}, strokes(), Tremor(1, 0.03), false}, options);
  std::vector<Intention::Point> points;
  // A recorded hand trembles already.
  const Replay replay = Replay::load(rest.substr(colon + 1));
  for (const Reading& reading : replay.recording())
    points.push_back({reading.time - replay.recording().front().time, reading.position.cast<double>()});
  return std::make_unique<Simulated>(
      model, Operator{Grip{}, Intention(std::move(points), Intention::Between::straight), Tremor(1, 0), true}, options);
}

std::unique_ptr<Device> open_mouse(const std::string& model, Attendant& attendant) {
  const Model its = simulated_model(model);
  Steering* const steering = attendant.steering();
  if (steering == nullptr)
    throw Error("the mouse as a device: expected a window in which it steers a hand, as 'forceshade drive' has; got none");
  return std::make_unique<Simulated>(
      its, Operator{Grip{}, Intention({{0, Eigen::Vector3d::Zero()}}, Intention::Between::straight), Tremor(1, 0), false},
      Simulated::Options{.buttons = attendant.buttons(), .steering = steering});
}

}  // namespace forceshade::device
