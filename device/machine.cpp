// SPDX-License-Identifier: BSD-3-Clause
#include "device/machine.h"

#include <sys/resource.h>

#include <fstream>
#include <set>
#include <system_error>

#include "text/formatted.h"
#include "text/joined.h"

namespace forceshade::device {
namespace {

constexpr const char* kAllow =
    "printf '@realtime - rtprio 90\\n@realtime - memlock unlimited\\n' | sudo tee /etc/security/limits.d/realtime.conf; "
    "sudo groupadd --force realtime; sudo adduser \"$USER\" realtime; then log in again";

std::string first_word_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

Check check_waking(const Observed& seen, double rate) {
  if (!seen.latest_waking) return {"waking", Grade::unknown, "the device's frames wake the loop"};
  const double period = 1e3 / rate;  // ms
  const std::string words = formatted("the system woke the loop at most %.3f ms late", *seen.latest_waking);
  if (*seen.latest_waking < period) return {"waking", Grade::ok, words};
  return {"waking", Grade::lacking, words + formatted("; expected less than its period, %.3g ms", period)};
}

Check check_scheduling(const Machine& machine, bool granted) {
  if (granted) return {"scheduling", Grade::ok, "real-time (SCHED_FIFO)"};
  if (machine.priority_limit < system::RealTime::kPriority)
    return {"scheduling", Grade::lacking,
            "ordinary, since ulimit -r is " + std::to_string(machine.priority_limit) + " and not " +
                std::to_string(system::RealTime::kPriority) + " or more: " + kAllow};
  return {
      "scheduling", Grade::lacking,
      "ordinary, since a container or a control group refuses what ulimit -r allows: give the container --cap-add SYS_NICE, "
      "or write 950000 into cpu.rt_runtime_us of the group that /proc/self/cgroup names"};
}

Check check_governor(const std::vector<std::string>& governors) {
  if (governors.empty()) return {"governor", Grade::unknown, "the system shows none, as most virtual machines do"};
  const std::string words = joined(governors, ", ");
  if (words == "performance") return {"governor", Grade::ok, words};
  return {"governor", Grade::lacking, words + ": sudo cpupower frequency-set --governor performance"};
}

}  // namespace

Machine this_machine(const std::filesystem::path& root) {
  Machine machine;
  machine.real_time_kernel = first_word_of(root / "sys/kernel/realtime") == "1";
  rlimit limit{};
  if (::getrlimit(RLIMIT_RTPRIO, &limit) == 0) machine.priority_limit = limit.rlim_cur;
  std::set<std::string> governors;
  std::error_code error;
  const std::filesystem::path processors = root / "sys/devices/system/cpu";
  for (std::filesystem::directory_iterator entry(processors, error), end; !error && entry != end; entry.increment(error))
    if (std::string word = first_word_of(entry->path() / "cpufreq/scaling_governor"); !word.empty()) governors.insert(word);
  machine.governors.assign(governors.begin(), governors.end());
  return machine;
}

std::vector<Check> machine_checks(const Machine& machine, const Observed& seen, double rate) {
  return {check_waking(seen, rate),
          machine.real_time_kernel
              ? Check{"kernel", Grade::ok, "real-time"}
              : Check{"kernel", Grade::lacking, "ordinary: sudo apt-get install linux-image-rt-amd64, then sudo reboot"},
          check_scheduling(machine, seen.granted.scheduling),
          seen.granted.memory_locked ? Check{"memory", Grade::ok, "locked"}
                                     : Check{"memory", Grade::lacking, std::string("not locked: ") + kAllow},
          check_governor(machine.governors)};
}

}  // namespace forceshade::device
