// SPDX-License-Identifier: BSD-3-Clause
#include "apps/trip_words.h"

#include <cmath>

#include "files/csv.h"

namespace forceshade::apps {
namespace {

std::string milliseconds(double ms) {
  return shortest(std::round(10 * ms) / 10) + " ms";
}

std::string cause_and_help(const device::ServoResult& run) {
  const device::Delay& delay = run.worst_delay;
  const std::string before = "the tick before took " + milliseconds(delay.before_ms) + ", of which " +
                             milliseconds(delay.computed_ms) + " were computing";
  if (delay.computed_ms > delay.late_ms / 2)
    return before + ". A lower --rate helps, or a surface of fewer parts or triangles.";
  const std::string cause = delay.before_ms > delay.late_ms / 2 ? before : "the system woke the loop late";
  const std::string rarer = "fewer other programs, or a machine that is not virtual.";
  if (run.privileges.scheduling) return cause + ". What helps: another processor for the loop (taskset), " + rarer;
  return cause +
         ", and it grants the loop no real-time scheduling. What helps: the right to it ('ulimit -r 90', or a line with rtprio "
         "in "
         "/etc/security/limits.conf), " +
         rarer;
}

}  // namespace

std::string words_of_trip(const device::ServoResult& run) {
  const std::string rule(name_of(run.trip->rule));
  if (run.trip->rule != device::Rule::watchdog && run.trip->rule != device::Rule::missed_deadlines) return rule;
  return rule + ": tick " + std::to_string(run.worst_delay.tick) + " began " + milliseconds(run.worst_delay.late_ms) +
         " after it was due, and --watchdog-timeout " + shortest(run.watchdog_timeout) + " allows " +
         milliseconds(1e3 * run.watchdog_timeout) + ": " + cause_and_help(run);
}

}  // namespace forceshade::apps
