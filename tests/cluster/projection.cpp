// SPDX-License-Identifier: BSD-3-Clause
// The measurements behind docs/cluster.md.
//
// projection units DIR UNITS PROCESSES: so many simulated units, which cost no computation, are claimed, kept and read again.
// projection rates: the processor time of the full sweep of all laws, from a sample of one in 37.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <map>
#include <string>

#include "certificate/plan_folder.h"
#include "certificate/sweep_unit.h"
#include "certificate/unit_result.h"
#include "certificate/worker.h"
#include "report/thesis.h"

namespace forceshade::properties {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int units(const std::string& path, std::uint64_t count, int processes) {
  const std::string plan(64, '0');
  const Units units({{ItemKind::points, 0, count}}, 1);
  Found found;
  found.tally.points = 4194304;
  found.tally.aims.fill(466034);
  found.tally.stages = {4194000, 300, 4};
  found.tally.call({1.25F, 3.5F, -0.3F, 1e-9});
  PlanFolder::create(path, plan);
  const PlanFolder folder(path, count);
  const std::atomic<bool> stop = false;
  auto start = Clock::now();
  for (int i = 0; i < processes; ++i) {
    if (::fork() != 0) continue;
    {
      Claims claims(folder, 300, "simulated");
      work_through(
          folder, claims, {1}, [&](std::uint64_t unit) { return text_of_unit(plan, unit, units, found); }, [](const Worked&) {},
          stop);
    }
    ::_exit(0);
  }
  while (::wait(nullptr) > 0) {
  }
  std::printf("%d processes do %llu units: %.0f units/s\n", processes, static_cast<unsigned long long>(count),
              static_cast<double>(count) / seconds_since(start));
  start = Clock::now();
  for (std::uint64_t i = 0; i < folder.folders(); ++i) folder.done(i);
  std::printf("status: %.2f s\n", seconds_since(start));
  start = Clock::now();
  Found sum;
  for (std::uint64_t unit = 0; unit < count; ++unit)
    sum.add(unit_from_text(folder.kept(unit), plan, unit, units, folder.result_file(unit)));
  std::printf("merge: %.1f s\n", seconds_since(start));
  return sum.tally.points == count * found.tally.points ? 0 : 1;
}

int rates() {
  SweepPlan plan{{}, {15.24F, 25.4F, 0.5F}, {}};
  for (const LawName& law : kLaws) plan.laws.push_back(law.id);
  for (const ThesisRadius& radius : kThesisRadii) plan.radii.push_back(radius.mm);
  const Sweeps sweeps = planned(plan);
  struct Kind {
    std::uint64_t sweeps = 0;
    double seconds = 0;  // of a sweep
  };
  std::map<std::pair<LawId, SweepKind>, Kind> kinds;
  for (const SweepResult& result : sweeps.results) {
    Kind& kind = kinds[{result.sweep.law, result.sweep.kind}];
    if (kind.sweeps++ > 0) continue;
    const std::clock_t start = std::clock();
    std::uint64_t sampled = 0;
    for (std::uint32_t unit = 1; unit < kUnitsPerSweep; unit += 37, ++sampled) check_unit(result.sweep, unit);
    kind.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(sampled) *
                   static_cast<double>(kUnitsPerSweep);
  }
  double total = 0;
  for (const auto& [of, kind] : kinds) {
    std::printf("%-15s %-9s %4llu sweeps of %6.0f s\n", name_of(of.first).data(),
                kSweepKinds[static_cast<std::size_t>(of.second)].data(), static_cast<unsigned long long>(kind.sweeps),
                kind.seconds);
    total += static_cast<double>(kind.sweeps) * kind.seconds;
  }
  std::printf("all: %zu sweeps, %.0f core hours\n", sweeps.results.size(), total / 3600);
  return 0;
}

}  // namespace
}  // namespace forceshade::properties

int main(int count, char** words) {
  if (count == 5 && std::strcmp(words[1], "units") == 0)
    return forceshade::properties::units(words[2], std::strtoull(words[3], nullptr, 10), std::atoi(words[4]));
  if (count == 2 && std::strcmp(words[1], "rates") == 0) return forceshade::properties::rates();
  std::fprintf(stderr, "projection units DIR UNITS PROCESSES, or projection rates\n");
  return 2;
}
