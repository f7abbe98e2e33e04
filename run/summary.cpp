// SPDX-License-Identifier: BSD-3-Clause
#include "run/summary.h"

#include <nlohmann/json.hpp>

#include "rendering/identity/identity_json.h"
#include "run/rule_names.h"
#include "run/words.h"

namespace forceshade::run {
namespace {

using device::kRules;
using device::Rule;
using device::Sample;
using device::ServoResult;
using nlohmann::ordered_json;

template <class Named>
const char* words(Named named) {
  return name_of(named).data();
}

ordered_json times(const device::Durations& us) {
  ordered_json json{{"p50", us.p50}, {"p99", us.p99}, {"p999", us.p999}, {"p9999", us.p9999}, {"max", us.max}};
  json["histogram"] = ordered_json::array();
  for (const auto& [up_to, count] : us.histogram) json["histogram"].push_back({up_to, count});
  return json;
}

// JSON has no NaN; null stands for it.
ordered_json array(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

const char* pacer_of(const ServoResult& run) {
  if (run.wakeup_us.histogram.empty()) return nullptr;
  return run.followed_device ? "device" : "clock";
}

ordered_json summary_of(const Identity& identity) {
  ordered_json json{{key_of_kind(identity), identity.name}};
  if (!identity.digest.empty()) json["digest"] = identity.digest;
  json["parameters"] = parameters_json(identity);
  return json;
}

ordered_json to_json(const ServoResult& run) {
  ordered_json limited = ordered_json::object();
  for (std::size_t rule = 0; rule < kRules; ++rule) limited[words(static_cast<Rule>(rule))] = run.limited_ticks[rule];
  ordered_json trip = nullptr;
  if (run.trip) trip = {{"rule", words(run.trip->rule)}, {"tick", run.trip->tick}};
  const device::PassivityAccount& account = run.account;
  const char* pacer = pacer_of(run);
  return {{"end_reason", words(run.end_reason)},
          {"ticks", run.ticks},
          {"missed_deadlines", run.missed_deadlines},
          {"overruns", run.overruns},
          {"worst_delay",
           {{"tick", run.worst_delay.tick},
            {"late_ms", run.worst_delay.late_ms},
            {"tick_before_ms", run.worst_delay.before_ms},
            {"computed_before_ms", run.worst_delay.computed_ms}}},
          {"invalid_positions", run.invalid_positions},
          {"unfinished_ticks", run.unfinished_ticks},
          {"rate_hz", run.achieved_rate_hz},
          {"paced_by", pacer ? ordered_json(pacer) : ordered_json(nullptr)},
          {"compute_us", times(run.compute_us)},
          {"tick_us", times(run.tick_us)},
          {"wakeup_us", times(run.wakeup_us)},
          {"peak_force_N", run.peak_force_N},
          {"energy_given_mJ", run.energy_given_mJ()},
          {"energy_taken_mJ", run.energy_taken_mJ()},
          {"supervisor",
           {{"supervised", run.supervised},
            {"acts_on_lateness", run.acts_on_lateness},
            {"trip", trip},
            {"limited_ticks", limited},
            {"forces_off_ticks", run.forces_off_ticks},
            {"forces_off", run.forces_off ? ordered_json(run.forces_off) : ordered_json(nullptr)},
            {"fades", run.fades},
            {"faded_s", run.faded}}},
          {"passivity",
           {{"controller", words(run.passivity)},
            {"epsilon_mJ", run.passivity_settings.epsilon},
            {"friction_N", run.passivity_settings.friction},
            {"latency", run.passivity_settings.latency},
            {"balance_mJ", account.balance},
            {"lowest_balance_mJ", account.lowest_balance},
            {"dissipated_by_friction_mJ", account.dissipated},
            {"forgiven_mJ", account.forgiven},
            {"withheld_mJ", account.withheld},
            {"altered_ticks", account.altered},
            {"largest_change_N", account.largest_change},
            {"longest_step_mm", account.longest_step}}},
          {"realtime_scheduling", run.privileges.scheduling},
          {"memory_locked", run.privileges.memory_locked},
          {"cpu", run.privileges.cpu ? ordered_json(*run.privileges.cpu) : ordered_json(nullptr)}};
}

ordered_json damping_json(const ServoResult& run) {
  const damping::Parameters& p = run.damping;
  const device::DampedEnergy& energy = run.damped_energy;
  return {{"rate_hz", p.rate},
          {"share", p.share},
          {"damping_N_s_per_mm", p.damping},
          {"most", p.most},
          {"drag_N_s_per_mm", p.drag},
          {"full_at_N", p.full_at},
          {"spring_mJ", energy.spring},
          {"damper_mJ", energy.damper},
          {"sampling_mJ", energy.sampling},
          {"most_given_mJ", energy.most}};
}

ordered_json last_ticks_json(const std::vector<Sample>& samples) {
  ordered_json all = ordered_json::array();
  for (const Sample& sample : samples) {
    ordered_json tripped = nullptr;
    if (sample.tripped != 0) tripped = name_of(static_cast<device::Rule>(sample.tripped - 1));
    all.push_back({{"tick", sample.tick},
                   {"t_s", static_cast<double>(sample.wall_ns) / 1e9},
                   {"position_mm", array(sample.position)},
                   {"law_force_N", array(sample.law_force)},
                   {"force_N", array(sample.force)},
                   {"limited", rule_names(sample.limited)},
                   {"tripped", tripped}});
  }
  return all;
}

}  // namespace forceshade::run
