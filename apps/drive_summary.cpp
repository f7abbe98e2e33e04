// SPDX-License-Identifier: BSD-3-Clause
#include "apps/drive_summary.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace forceshade::apps {
namespace {

using device::kRules;
using device::Rule;
using device::ServoResult;
using nlohmann::ordered_json;

template <class Named>
const char* words(Named named) {
  return name_of(named).data();
}

void print_times(const char* what, const device::Durations& us) {
  std::printf("%-17s worst %.1f us, 99.99 %% %.1f us, 99.9 %% %.1f us, 99 %% %.1f us, median %.1f us\n", what, us.max, us.p9999,
              us.p999, us.p99, us.p50);
}

ordered_json times(const device::Durations& us) {
  ordered_json json{{"p50", us.p50}, {"p99", us.p99}, {"p999", us.p999}, {"p9999", us.p9999}, {"max", us.max}};
  json["histogram"] = ordered_json::array();
  for (const auto& [up_to, count] : us.histogram) json["histogram"].push_back({up_to, count});
  return json;
}

// What each tick followed; none where they followed one another.
const char* pacer_of(const ServoResult& run) {
  if (run.wakeup_us.histogram.empty()) return nullptr;
  return run.followed_device ? "device" : "clock";
}

void print_safety(const ServoResult& run) {
  if (!run.supervised) {
    std::printf("safety            a device that gives no force: not supervised\n");
    return;
  }
  std::printf("safety            ");
  if (run.trip) std::printf("TRIPPED: %s at tick %zu; ", words(run.trip->rule), run.trip->tick);
  std::string limited;
  for (std::size_t rule = 0; rule < kRules; ++rule)
    if (run.limited_ticks[rule] > 0)
      limited += (limited.empty() ? "limited by " : ", ") + std::string(words(static_cast<Rule>(rule))) + " in " +
                 std::to_string(run.limited_ticks[rule]) + " ticks";
  std::printf("%s\n", limited.empty() ? "nothing limited" : limited.c_str());
}

void print_lateness(const ServoResult& run) {
  std::printf("                  tick %zu began %.1f ms late, the longest", run.worst_delay.tick, run.worst_delay.late_ms);
  if (run.supervised && !run.acts_on_lateness)
    std::printf("; late ticks are only counted, because the device moves no arm (unless --watchdog-timeout is given)");
  std::printf("\n");
}

}  // namespace

void print(const ServoResult& run) {
  std::printf("ticks             %zu (%s)\n", run.ticks, words(run.end_reason));
  const char* pacer = pacer_of(run);
  std::printf("rate              %.1f Hz%s%s\n", run.achieved_rate_hz, pacer ? ", paced by the " : "", pacer ? pacer : "");
  std::printf("missed deadlines  %zu, of them %zu by our own computing\n", run.missed_deadlines, run.overruns);
  if (run.missed_deadlines > 0) print_lateness(run);
  print_times("compute time", run.compute_us);
  print_times("with the device", run.tick_us);
  if (!run.wakeup_us.histogram.empty()) print_times("wake-up latency", run.wakeup_us);
  std::printf("peak force        %.3f N\n", run.peak_force_N);
  std::printf("energy            %.3f mJ given to the hand, %.3f mJ taken from it\n", run.energy_given_mJ(),
              run.energy_taken_mJ());
  print_safety(run);
  const device::PassivityAccount& account = run.account;
  if (run.supervised)
    std::printf("passivity         %s: account %.3f mJ, lowest %.3f (bound %.3f); %zu ticks altered, by at most %.3f N\n",
                words(run.passivity), account.balance, account.lowest_balance, -run.passivity_settings.epsilon, account.altered,
                account.largest_change);
  if (account.forgiven > 0)
    std::printf("                  %.3f mJ were forgiven: late ticks let the hand take more than the bound\n",
                account.forgiven);
  if (run.unfinished_ticks > 0) std::printf("unfinished ticks  %zu (the god-object used up its moves)\n", run.unfinished_ticks);
  if (run.invalid_positions > 0) std::printf("invalid positions %zu (zero force)\n", run.invalid_positions);
  const auto& [scheduling, memory_locked, cpu] = run.privileges;
  std::printf("scheduling        %s, memory %s, %s\n", scheduling ? "real-time (SCHED_FIFO)" : "ordinary",
              memory_locked ? "locked" : "not locked",
              cpu ? ("on processor " + std::to_string(*cpu)).c_str() : "on any processor");
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
            {"limited_ticks", limited}}},
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

}  // namespace forceshade::apps
