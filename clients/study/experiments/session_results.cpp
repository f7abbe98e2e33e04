// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/session_results.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "files/input_file.h"
#include "files/output_file.h"
#include "files/printable.h"

namespace forceshade::experiments {
namespace {

// One trial from its start on, until it is answered or an interruption ends it.
struct Going {
  Event start;
  int steps = 0;
  std::vector<RadiusChange> changes;
};

}  // namespace

std::string_view name_of(AnsweredBy who) {
  return who == AnsweredBy::person ? "person" : who == AnsweredBy::model ? "virtual participant" : "";
}

std::vector<TrialUse> uses_of(const SavedSession& session) {
  std::vector<TrialUse> uses(session.events.size(), TrialUse::no_trial);
  const std::size_t none = uses.size();
  std::size_t started = none;
  std::map<int, std::vector<std::size_t>> answered;  // events of answered trials by block
  const auto end_trial = [&](std::size_t end, TrialUse use) {
    for (std::size_t i = std::exchange(started, none); i < end; ++i)
      if (session.events[i].attempt > 0) uses[i] = use;
  };
  for (std::size_t i = 0; i < session.events.size(); ++i) {
    const Event& event = session.events[i];
    if (event.kind == EventKind::run_started) end_trial(i, TrialUse::interrupted);
    if (event.kind == EventKind::block_started) {
      for (const std::size_t earlier : answered[event.block]) uses[earlier] = TrialUse::abandoned;
      answered[event.block].clear();
    }
    if (event.kind == EventKind::trial_started) started = i;
    if (event.kind == EventKind::answered && started != none) {
      for (std::size_t its = started; its <= i; ++its) answered[event.block].push_back(its);
      end_trial(i + 1, event.block == 0 ? TrialUse::practice : TrialUse::result);
    }
  }
  end_trial(uses.size(), TrialUse::interrupted);
  return uses;
}

Origin origin_of(const SavedSession& session, int run) {
  const auto is_start = [&](const Event& event) { return event.kind == EventKind::run_started && event.run == run; };
  const auto start = std::ranges::find_if(session.events, is_start);
  if (start == session.events.end()) return {session.answered_by, {}, {}};
  return {session.answered_by, start->device, start->certified};
}

Results results_of(const SavedSession& session) {
  bool vision = true;
  Going going;
  Results all;
  const std::vector<TrialUse> uses = uses_of(session);
  const std::vector<Block> planned = order(session.protocol, session.seed);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Event& event = session.events[i];
    if (event.kind == EventKind::block_started) vision = std::ranges::find(planned, event.block, &Block::number)->vision;
    if (uses[i] != TrialUse::result) continue;
    const Trial& trial = going.start.trial;
    const double seconds = event.time - going.start.time;
    const auto radius_change = [&](double at, Mil radius) {
      going.changes.push_back({session.participant, going.start.trial.number, going.steps, at, static_cast<double>(radius)});
    };
    switch (event.kind) {
      case EventKind::trial_started:
        going = {event, 0, {}};
        if (session.protocol.experiment == Experiment::matching) radius_change(0, event.trial.initial_radius);
        break;
      case EventKind::radius_changed:
        ++going.steps;
        radius_change(seconds, event.radius);
        break;
      case EventKind::answered: {
        const Origin origin = origin_of(session, event.run);
        if (session.protocol.experiment == Experiment::matching) {
          all.matching.push_back({session.participant, trial.number, vision, trial.stimulus, trial.initial, trial.repetition,
                                  static_cast<double>(trial.radius), static_cast<double>(trial.initial_radius),
                                  static_cast<double>(event.radius), event.answer, going.steps, seconds, origin});
          all.radius_changes.insert(all.radius_changes.end(), going.changes.begin(), going.changes.end());
        } else {
          all.classification.push_back({session.participant, trial.number, trial.stimulus, static_cast<double>(trial.radius),
                                        trial.repetition, event.answer, seconds, origin});
        }
        break;
      }
      default: break;
    }
  }
  return all;
}

void GatheredResults::add(const Results& more, const std::filesystem::path& folder) {
  const auto expect_new = [&](const auto& trials, bool is_matching) {
    for (const auto& one : trials)
      if (!seen_.emplace(one.participant, one.trial, is_matching).second)
        throw Error(folder, "trial " + std::to_string(one.trial) + " of participant " + files::printable(one.participant) +
                                " is in an earlier folder, too: each participant does an experiment once");
  };
  expect_new(more.matching, true);
  expect_new(more.classification, false);
  all.matching.insert(all.matching.end(), more.matching.begin(), more.matching.end());
  all.classification.insert(all.classification.end(), more.classification.begin(), more.classification.end());
  all.radius_changes.insert(all.radius_changes.end(), more.radius_changes.begin(), more.radius_changes.end());
}

Results results_of(std::span<const std::filesystem::path> folders) {
  GatheredResults gathered;
  std::map<std::string, std::string> by_folded;
  for (const std::filesystem::path& folder : folders) {
    const SavedSession session = read_session(folder);
    const std::string& name = session.participant;
    if (const auto at = by_folded.try_emplace(files::folded_name(name), name).first; at->second != name)
      throw Error(folder,
                  "participants " + at->second + " and " + name +
                      " differ in capital letters alone, which many programs and file systems do not tell apart: rename one");
    gathered.add(results_of(session), folder);
  }
  return std::move(gathered.all);
}

}  // namespace forceshade::experiments
