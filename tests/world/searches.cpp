// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/searches.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace forceshade::world {
namespace {

std::string words_of(const Violation& violation) {
  return "rule " + std::to_string(violation.rule) + ": " + violation.words;
}

// The findings of the processes of a search, in memory that all of them map.
struct Shared {
  long tried = 0, broken = 0;
  double longest = 0, without_watchdog = 0;
  long go_on = 0, stay = 0;
  std::array<char, 1024> first{};

  // when: by the arm's clock, when the last fault was placed.
  void add(const std::string& name, const Outcome& outcome, Ns when) {
    ++tried;
    const bool goes_on = outcome.end == World::End::over && outcome.result.end_reason == device::EndReason::time_up;
    go_on += goes_on ? 1 : 0;
    if (!goes_on) longest = std::max(longest, static_cast<double>(outcome.felt_until - when) * 1e-6);
    without_watchdog = std::max(without_watchdog, outcome.without_watchdog);
    stay += outcome.stays ? 1 : 0;
    if (outcome.violations.empty() || ++broken > 1) return;
    std::snprintf(first.data(), first.size(), "%s: %s; %s", name.c_str(), words_of(outcome.violations.front()).c_str(),
                  outcome.words().c_str());
  }
};

class SharedMemory {
 public:
  SharedMemory() : memory_(::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    new (memory_) Shared;
  }
  ~SharedMemory() { ::munmap(memory_, sizeof(Shared)); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  Shared& operator*() const noexcept { return *static_cast<Shared*>(memory_); }
  Shared* operator->() const noexcept { return static_cast<Shared*>(memory_); }

 private:
  void* memory_;
};

struct Stage {
  const std::vector<Fault>* faults;
  Window window;
};

// Sessions are run by this process without a fault, and by those that it forks with one more each. Each waits for those that it
// has made, so that they run one after another.
class Placing {
 public:
  Placing(std::vector<Stage> stages, Shared& shared) : stages_(std::move(stages)), shared_(shared) {}

  Found found(Plan plan, const Open& open) {
    plan.at_step = [this](Arm& arm) { at_step(arm); };
    Outcome outcome = session(plan, open);
    if (depth_ > 0) {
      if (stages_.size() == 1 && !has_right_words(outcome))
        outcome.violations.push_back({8, "the words of the end are not those of the fault"});
      if (depth_ == stages_.size()) shared_.add(name_, outcome, when_);
      std::fflush(stdout);
      ::_exit(0);
    }
    Found found;
    found.tried = shared_.tried;
    found.broken = shared_.broken + (outcome.violations.empty() ? 0 : 1);
    found.longest = shared_.longest;
    found.without_watchdog = shared_.without_watchdog;
    found.go_on = shared_.go_on;
    found.stay = shared_.stay;
    found.first = shared_.first.data();
    if (!outcome.violations.empty()) found.first = "without a fault: " + words_of(outcome.violations.front());
    return found;
  }

 private:
  bool has_right_words(const Outcome& outcome) const {
    const std::string words = outcome.words();
    return words_.empty() || std::ranges::any_of(words_, [&](const std::string& its) { return words.find(its) != words.npos; });
  }

  void at_step(Arm& arm) {
    if (depth_ == stages_.size()) return;
    World& world = *current();
    const auto& [faults, window] = stages_[depth_];
    if (begin_ < 0) begin_ = world.now() - (depth_ == 0 ? 0 : window.from);
    if (world.now() - begin_ < window.from) return;
    const long step = step_++;
    if (step >= window.steps * window.stride || step % window.stride != 0) return;
    for (const Fault& fault : *faults) {
      std::fflush(stdout);
      const pid_t process = ::fork();
      if (process < 0) std::abort();
      if (process == 0) {
        ++depth_;
        begin_ = -1;
        step_ = 0;
        name_ += (name_.empty() ? "" : ", then ") + fault.name + " at step " + std::to_string(world.steps());
        words_ = fault.words;
        when_ = world.outside_now();
        return fault.happens(world, arm);
      }
      int status = 0;
      ::waitpid(process, &status, 0);
      if (status == 0) continue;
      ++shared_.tried;
      if (++shared_.broken == 1)
        std::snprintf(shared_.first.data(), shared_.first.size(), "%s at step %ld: the process ended with status %d",
                      fault.name.c_str(), world.steps(), status);
    }
  }

  std::vector<Stage> stages_;
  Shared& shared_;
  std::size_t depth_ = 0;
  Ns begin_ = -1, when_ = 0;
  long step_ = 0;
  std::string name_;
  std::vector<std::string> words_;
};

}  // namespace

Found random_sessions(int count, const Plan& plan, const Session& its) {
  Found found;
  for (int seed = 1; seed <= count; ++seed) {
    Plan seeded = plan;
    seeded.schedule = {
        .seed = static_cast<std::uint64_t>(seed), .holds = plan.schedule.holds, .changes = plan.schedule.changes};
    const Outcome outcome = its(seeded);
    ++found.tried;
    found.seconds += static_cast<double>(outcome.lasted) * 1e-9;
    found.digest = found.digest * 31 + outcome.digest;
    found.without_watchdog = std::max(found.without_watchdog, outcome.without_watchdog);
    found.stay += outcome.stays ? 1 : 0;
    if (outcome.violations.empty() || ++found.broken > 1) continue;
    found.first = "seed " + std::to_string(seed) + ": " + words_of(outcome.violations.front()) + "; " + outcome.words();
    for (const Entry& entry : shrunk(seeded, its, outcome.decisions)) found.first += "\n  " + entry.words();
  }
  return found;
}

std::vector<Entry> shrunk(Plan plan, const Session& its, std::vector<Entry> decisions) {
  const auto breaks = [&](const std::vector<Entry>& list) {
    plan.schedule.list = list;
    return !its(plan).violations.empty();
  };
  if (!breaks(decisions)) return decisions;
  for (std::size_t part = std::max<std::size_t>(1, decisions.size() / 2);;) {
    bool is_less = false;
    for (std::size_t from = 0; from < decisions.size();) {
      std::vector<Entry> without = decisions;
      without.erase(without.begin() + static_cast<long>(from),
                    without.begin() + static_cast<long>(std::min(decisions.size(), from + part)));
      if (breaks(without)) {
        decisions = std::move(without);
        is_less = true;
      } else {
        from += part;
      }
    }
    if (part == 1 && !is_less) break;
    part = std::max<std::size_t>(1, part / 2);
  }
  for (Entry& entry : decisions)
    for (bool is_less = entry.kind == Entry::Kind::hold; is_less && entry.value > 1;) {
      entry.value /= 2;
      is_less = breaks(decisions);
      if (!is_less) entry.value *= 2;
    }
  return decisions;
}

Found placed(const std::vector<Fault>& faults, const Window& window, const Plan& plan, const Open& open) {
  const SharedMemory shared;
  return Placing({{&faults, window}}, *shared).found(plan, open);
}

Found placed_anew(const std::vector<Fault>& faults, const Window& window, const Plan& plan, const Session& its) {
  Shared shared;
  for (const Fault& fault : faults)
    for (long place = 0; place < window.steps; ++place) {
      Plan with = plan;
      long steps = 0;
      Ns begin = -1;
      with.at_step = [&](Arm& arm) {
        World& world = *current();
        if (begin < 0) begin = world.now();
        if (plan.at_step) plan.at_step(arm);
        if (world.now() - begin >= window.from && steps++ == place * window.stride) fault.happens(world, arm);
      };
      const Outcome outcome = its(with);
      if (place > 0 && steps <= place * window.stride) break;  // it was over before
      shared.add(fault.name + " at step " + std::to_string(place * window.stride), outcome, 0);
    }
  return {.tried = shared.tried, .broken = shared.broken, .first = shared.first.data()};
}

Found placed_pairs(const std::vector<Fault>& firsts, const Window& window, const std::vector<Fault>& seconds,
                   const Window& second, const Plan& plan, const Open& open) {
  const SharedMemory shared;
  return Placing({{&firsts, window}, {&seconds, second}}, *shared).found(plan, open);
}

std::vector<Fault> holds(long most) {
  std::vector<Fault> all;
  for (long steps = 1; steps <= most; ++steps)
    all.push_back({"whoever makes the step waits for " + std::to_string(steps) + " steps of the others",
                   [steps](World& world, Arm&) { world.hold_for_steps(world.running(), steps); }});
  return all;
}

}  // namespace forceshade::world
