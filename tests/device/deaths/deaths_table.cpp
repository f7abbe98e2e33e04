// SPDX-License-Identifier: BSD-3-Clause
// Tries every death at every phase and prints docs/tables/deaths.md. Exit code 1 if the arm feels what it should not.

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/device/deaths/deaths.h"

namespace {

using namespace forceshade::deaths;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t kAtOnce = 1;  // a run alone keeps one of two processors busy
#else
constexpr std::size_t kAtOnce = 12;
#endif

bool is_as_expected(const Death& death, Moment phase, const Outcome& outcome) {
  if (!outcome.took_effect) return false;
  const bool was_stopped = death.to_driver && death.signal == SIGSTOP;
  if (outcome.driver_is_left && !was_stopped) return false;
  if (outcome.seen == death.expected) return true;
  // It would have ended at that moment anyway; or there was no force that could stay.
  return outcome.seen == Expected::lets_go &&
         (death.expected == Expected::stays_on || phase == Moment::tripping || phase == Moment::stopping);
}

std::string cell(const Outcome& outcome) {
  char text[64];
  if (!outcome.took_effect) return "did not happen";
  switch (outcome.seen) {
    case Expected::goes_on: return "goes on";
    case Expected::stays_on: std::snprintf(text, sizeof text, "**%.2g N stay**", outcome.force); break;
    case Expected::lets_go:
      if (outcome.to_zero <= 0) return "0";
      std::snprintf(text, sizeof text, "%.1f", outcome.to_zero);
  }
  return text;
}

struct Result {
  bool good;
  char cell[64], end[96];
};

Result result_of(const Death& death, Moment phase) {
  const Outcome outcome = tried(death, phase);
  Result result{.good = is_as_expected(death, phase, outcome), .cell = "", .end = ""};
  std::snprintf(result.cell, sizeof result.cell, "%s", cell(outcome).c_str());
  std::snprintf(result.end, sizeof result.end, "%s%s", outcome.end.c_str(),
                outcome.driver_is_left ? ", and the driver's process is left" : "");
  return result;
}

struct Worker {
  std::size_t death, phase;
  int result;  // to be read from
};

}  // namespace

// All of them, or those of the phases and deaths that the arguments name.
int main(int count, char** words) {
  std::set<std::string> named(words + 1, words + count);
  std::vector<Moment> phases;
  for (const Moment phase : kPhases)
    if (named.erase(name_of(phase)) > 0) phases.push_back(phase);
  if (phases.empty()) phases.assign(kPhases.begin(), kPhases.end());
  std::vector<Death> deaths;
  const bool every_death = named.empty();
  for (const Death& death : catalogue())
    if (every_death || named.erase(death.what) > 0) deaths.push_back(death);
  if (!named.empty()) {
    std::fprintf(stderr, "expected phases such as \"in contact\", and of these:\n");
    for (const Death& death : catalogue()) std::fprintf(stderr, "  %s\n", death.what.c_str());
    return 2;
  }

  // Each in a process of its own, with a stand-in of its own.
  std::vector<std::vector<Result>> results(deaths.size(), std::vector<Result>(phases.size()));
  std::map<pid_t, Worker> workers;
  const auto gather = [&] {
    const pid_t process = wait(nullptr);
    const auto worker = workers.find(process);
    if (worker == workers.end()) return;
    const auto& [death, phase, end] = worker->second;
    if (read(end, &results[death][phase], sizeof(Result)) != sizeof(Result)) results[death][phase] = {false, "no result", ""};
    close(end);
    workers.erase(worker);
  };
  for (std::size_t death = 0; death < deaths.size(); ++death)
    for (std::size_t phase = 0; phase < phases.size(); ++phase) {
      while (workers.size() >= kAtOnce) gather();
      int ends[2];
      if (pipe(ends) != 0) return 2;
      const pid_t process = fork();
      if (process == 0) {
        const Result result = result_of(deaths[death], phases[phase]);
        _exit(write(ends[1], &result, sizeof result) == sizeof result ? 0 : 1);
      }
      close(ends[1]);
      workers[process] = {death, phase, ends[0]};
    }
  while (!workers.empty()) gather();

  std::printf("| death |");
  for (const Moment phase : phases) std::printf(" %s |", name_of(phase));
  std::printf("\n|---|");
  for (std::size_t phase = 0; phase < phases.size(); ++phase) std::printf("---|");
  std::printf("\n");
  int wrong = 0;
  for (std::size_t death = 0; death < deaths.size(); ++death) {
    std::printf("| %s |", deaths[death].what.c_str());
    for (const Result& result : results[death]) std::printf(" %s |", result.cell);
    std::printf("\n");
    for (std::size_t phase = 0; phase < phases.size(); ++phase) {
      const Result& result = results[death][phase];
      if (result.good) continue;
      std::fprintf(stderr, "FAILED: %s, %s: %s (%s)\n", deaths[death].what.c_str(), name_of(phases[phase]), result.cell,
                   result.end);
      wrong = 1;
    }
  }
  return wrong;
}
