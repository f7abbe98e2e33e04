// SPDX-License-Identifier: BSD-3-Clause
#include "apps/drive_summary.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <string>

#include "run/rule_names.h"
#include "run/summary.h"
#include "run/words.h"
#include "text/formatted.h"

namespace forceshade::apps {
namespace {

using device::kRules;
using device::Rule;
using device::Sample;
using device::ServoResult;

template <class Named>
const char* words(Named named) {
  return name_of(named).data();
}

void print_times(const char* what, const device::Durations& us) {
  std::printf("%-17s worst %.1f us, 99.99 %% %.1f us, 99.9 %% %.1f us, 99 %% %.1f us, median %.1f us\n", what, us.max, us.p9999,
              us.p999, us.p99, us.p50);
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
  const auto add = [&](const std::string& words) { limited += (limited.empty() ? "" : "; ") + words; };
  if (run.forces_off_ticks > 0) {
    add("the device's own forces were off in " + std::to_string(run.forces_off_ticks) + " ticks");
    if (run.forces_off) limited += ", the last among them" + (*run.forces_off ? std::string(": ") + run.forces_off : "");
  }
  if (run.fades > 0)
    add(formatted("faded %d time%s by the device's frames, for %.2f s in all", run.fades, run.fades == 1 ? "" : "s",
                  run.faded));
  std::printf("%s\n", limited.empty() ? "nothing limited" : limited.c_str());
}

void print_lateness(const ServoResult& run) {
  std::printf("                  tick %zu began %.1f ms late, the longest", run.worst_delay.tick, run.worst_delay.late_ms);
  if (run.supervised && !run.acts_on_lateness)
    std::printf("; late ticks are only counted, because the device moves no real arm (unless --watchdog-timeout is given)");
  std::printf("\n");
}

Eigen::Vector3d vector(const std::array<float, 3>& v) {
  return Eigen::Map<const Eigen::Vector3f>(v.data()).cast<double>();
}

// mm/s, by the device's own clock, or by ours where the device's stands still.
double speed(const Sample& before, const Sample& last) {
  double seconds = last.device_time - before.device_time;
  if (!(seconds > 0)) seconds = static_cast<double>(last.wall_ns - before.wall_ns) / 1e9;
  return (vector(last.position) - vector(before.position)).norm() / seconds;
}

}  // namespace

void print(const ServoResult& result) {
  std::printf("ticks             %zu (%s)\n", result.ticks, words(result.end_reason));
  const char* pacer = run::pacer_of(result);
  std::printf("rate              %.1f Hz%s%s\n", result.achieved_rate_hz, pacer ? ", paced by the " : "", pacer ? pacer : "");
  std::printf("missed deadlines  %zu, of them %zu by our own computing\n", result.missed_deadlines, result.overruns);
  if (result.missed_deadlines > 0) print_lateness(result);
  print_times("compute time", result.compute_us);
  print_times("with the device", result.tick_us);
  if (!result.wakeup_us.histogram.empty()) print_times("wake-up latency", result.wakeup_us);
  std::printf("peak force        %.3f N\n", result.peak_force_N);
  const device::PassivityAccount& account = result.account;
  std::printf("energy            %.3f mJ given to the hand, %.3f mJ taken from it", result.energy_given_mJ(),
              result.energy_taken_mJ());
  if (account.dissipated > 0) std::printf("; the arm's friction took at least %.3f mJ of what was given", account.dissipated);
  std::printf("\n");
  if (!result.damping.is_off()) {
    const device::DampedEnergy& its = result.damped_energy;
    std::printf("damping           %s (certified with the build; no certificate names it)\n",
                run::words_of(result.damping).c_str());
    std::printf("                  the renderer's force gave %.3f mJ by its spring, %.3f by the damper, %.3f by its sampling\n",
                its.spring, its.damper, its.sampling);
  }
  print_safety(result);
  if (result.supervised)
    std::printf("passivity         %s: account %.3f mJ, lowest %.3f (bound %.3f); %zu ticks altered, by at most %.3f N\n",
                words(result.passivity), account.balance, account.lowest_balance, -result.passivity_settings.epsilon,
                account.altered, account.largest_change);
  if (account.forgiven > 0)
    std::printf("                  %.3f mJ were forgiven: late ticks let the hand take more than the bound\n",
                account.forgiven);
  if (result.unfinished_ticks > 0)
    std::printf("unfinished ticks  %zu (the god-object used up its moves or looks)\n", result.unfinished_ticks);
  if (result.invalid_positions > 0) std::printf("invalid positions %zu (zero force)\n", result.invalid_positions);
  const auto& [scheduling, memory_locked, cpu] = result.privileges;
  std::printf("scheduling        %s, memory %s, %s\n", scheduling ? "real-time (SCHED_FIFO)" : "ordinary",
              memory_locked ? "locked" : "not locked",
              cpu ? ("on processor " + std::to_string(*cpu)).c_str() : "on any processor");
}

void print_last_ticks(const std::vector<Sample>& samples) {
  if (samples.empty()) return;
  const Sample& last = samples.back();
  const Eigen::Vector3d at = vector(last.position);
  std::printf("last tick         %llu: at (%.3f, %.3f, %.3f) mm", static_cast<unsigned long long>(last.tick), at.x(), at.y(),
              at.z());
  if (samples.size() > 1) {
    const Sample& before = samples[samples.size() - 2];
    std::printf(", %.0f mm/s; force %.3f N, one tick before %.3f N", speed(before, last), vector(last.force).norm(),
                vector(before.force).norm());
  }
  std::printf("; the law's %.3f N\n", vector(last.law_force).norm());
  std::uint16_t limited = 0;
  for (const Sample& sample : samples) limited = static_cast<std::uint16_t>(limited | sample.limited);
  std::printf("before the end    %zu ticks kept for --json; %s\n", samples.size(),
              limited == 0 ? "nothing limited in them" : ("limited by " + run::joined_rule_names(limited)).c_str());
}

}  // namespace forceshade::apps
