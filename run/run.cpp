// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/run.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "certificate/build.h"
#include "device/passive_rate.h"
#include "forceshade/checks.h"
#include "forceshade/servo_loop.h"
#include "run/record.h"
#include "run/summary.h"
#include "run/words.h"
#include "text/number_text.h"

namespace forceshade::run {
namespace {

constexpr double kKeptBeforeTheEnd = 0.2;  // s

recorder::Metadata metadata(const Plan& plan, const device::ServoOptions& servo, const Identity& identity,
                            const device::Capabilities& capabilities) {
  recorder::Metadata metadata = metadata_of_run(plan.device, capabilities, servo);
  metadata.insert({{"certificate_digest", plan.digest.value_or("none")},
                   {"origin_mm", origin_words(plan.servo.placement)},
                   {"axes", axes_words(plan.servo.placement)}});
  metadata.merge(metadata_of(identity));
  return metadata;
}

void expect_rate_of(const Rendering& what, double rate_hz) {
  if (!what.rate_hz || *what.rate_hz == rate_hz) return;
  throw std::runtime_error("the rate of the loop: expected " + digits(*what.rate_hz, 9) + " Hz, for which the motions of " +
                           what.identity.name + " are made, got " + digits(rate_hz, 9));
}

}  // namespace

damping::Parameters damping_of(const Rendering& what, const device::ServoOptions& servo) {
  return what.damping.parameters.is_off() ? servo.damping_at_rate() : what.damping.at(servo.rate_hz);
}

bool has_failed(const device::ServoResult& result) {
  return result.trip || result.end_reason == device::EndReason::device_fault;
}

Outcome run(device::Device& device, const Rendering& what, const Plan& plan, const std::atomic<bool>& stop) {
  expect_rate_of(what, plan.servo.rate_hz);
  device::ServoOptions servo = plan.servo;
  servo.damping = damping_of(what, plan.servo);
  std::optional<Record> record;
  if (!plan.record.empty())
    record.emplace(plan.record, metadata(plan, servo, what.identity, device.capabilities()), plan.servo.paced, plan.overwrite);
  device::LastSamples last(kKeptBeforeTheEnd, plan.servo.rate_hz);
  servo.sinks.push_back(&last);
  if (record) servo.sinks.push_back(&record->sink());
  if (stop) throw Interrupted("the run had not begun");
  const std::unique_ptr<fast::Session> session = what.renderer.open();
  Outcome outcome{device::run_servo_loop(device, *session, servo, stop), {}, {}};
  if (record) outcome.record_faults = record->close(std::string(name_of(outcome.result.end_reason)));
  if (has_failed(outcome.result)) outcome.last_ticks = last.samples();
  return outcome;
}

nlohmann::ordered_json summary(const Outcome& outcome, const Rendering& what, const Plan& plan,
                               const device::Capabilities& capabilities, const std::string& signal) {
  nlohmann::ordered_json json = summary_of(what.identity);
  json["certificate_digest"] = plan.digest ? nlohmann::ordered_json(*plan.digest) : nlohmann::ordered_json(nullptr);
  json["library_digest"] = properties::current_build().library_digest;
  const Eigen::Vector3d origin = plan.servo.placement.origin().cast<double>();
  json["placement"] = {{"origin_mm", {origin.x(), origin.y(), origin.z()}}, {"axes", axes_words(plan.servo.placement)}};
  json["device"] = {{"name", plan.device}};
  for (const auto& [what_it_is, words] : words_of(capabilities)) json["device"][what_it_is] = words;
  const std::string warning = device::words_if_active(static_cast<double>(what.stiffness), capabilities, plan.servo.rate_hz,
                                                      damping_of(what, plan.servo));
  json["warning"] = warning.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(warning);
  json.update(to_json(outcome.result));
  if (!outcome.result.damping.is_off()) json["damping"] = damping_json(outcome.result);
  json["signal"] = signal.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(signal);
  json["last_ticks"] = last_ticks_json(outcome.last_ticks);
  return json;
}

std::string summary_text(const Outcome& outcome, const Rendering& what, const Plan& plan,
                         const device::Capabilities& capabilities, const std::string& signal) {
  return summary(outcome, what, plan, capabilities, signal).dump(2);
}

}  // namespace forceshade::run
