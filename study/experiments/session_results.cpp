// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/session_results.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

#include "study/experiments/error.h"

namespace forceshade::experiments {
namespace {

// One trial from its start on, until it is answered or an interruption ends it.
struct Going {
  Event start;
  int steps = 0;
  std::vector<RadiusChange> changes;
};

// The finished trials of one block, which a repetition of the block replaces.
struct BlockResults {
  int block = 0;
  Results results;
};

void append(Results& all, const Results& more) {
  all.matching.insert(all.matching.end(), more.matching.begin(), more.matching.end());
  all.classification.insert(all.classification.end(), more.classification.begin(), more.classification.end());
  all.radius_changes.insert(all.radius_changes.end(), more.radius_changes.begin(), more.radius_changes.end());
}

}  // namespace

Results results_of(const SavedSession& session) {
  std::vector<BlockResults> blocks;
  bool vision = true;
  Going going;
  const std::vector<Block> planned = order(session.protocol, session.seed);
  for (const Event& event : session.events) {
    const Trial& trial = going.start.trial;
    const double seconds = event.time - going.start.time;
    const auto radius_change = [&](double at, Mil radius) {
      going.changes.push_back({session.participant, trial.number, going.steps, at, static_cast<double>(radius)});
    };
    switch (event.kind) {
      case EventKind::block_started: {
        std::erase_if(blocks, [&](const BlockResults& one) { return one.block == event.block; });
        blocks.push_back({event.block, {}});
        const auto its = std::ranges::find(planned, event.block, &Block::number);
        vision = its->vision;
        break;
      }
      case EventKind::trial_started:
        going = {event, 0, {}};
        if (session.protocol.experiment == Experiment::matching) radius_change(0, event.trial.initial_radius);
        break;
      case EventKind::radius_changed:
        ++going.steps;
        radius_change(seconds, event.radius);
        break;
      case EventKind::answered: {
        if (event.block == 0) break;
        Results& results = blocks.back().results;
        if (session.protocol.experiment == Experiment::matching) {
          results.matching.push_back({session.participant, trial.number, vision, trial.stimulus, trial.initial,
                                      trial.repetition, static_cast<double>(trial.radius),
                                      static_cast<double>(trial.initial_radius), static_cast<double>(event.radius),
                                      event.answer, going.steps, seconds});
          results.radius_changes.insert(results.radius_changes.end(), going.changes.begin(), going.changes.end());
        } else {
          results.classification.push_back({session.participant, trial.number, trial.stimulus,
                                            static_cast<double>(trial.radius), trial.repetition, event.answer, seconds});
        }
        break;
      }
      default: break;
    }
  }
  Results all;
  for (const BlockResults& one : blocks) append(all, one.results);
  return all;
}

Results results_of(std::span<const std::filesystem::path> folders) {
  Results all;
  std::set<std::tuple<std::string, int, bool>> seen;
  for (const std::filesystem::path& folder : folders) {
    const Results results = results_of(read_session(folder));
    const auto expect_new = [&](const auto& trials, bool is_matching) {
      for (const auto& one : trials)
        if (!seen.insert({one.participant, one.trial, is_matching}).second)
          throw Error(folder, "trial " + std::to_string(one.trial) + " of participant " + one.participant +
                                  " is in an earlier session, too: each participant does an experiment once");
    };
    expect_new(results.matching, true);
    expect_new(results.classification, false);
    append(all, results);
  }
  return all;
}

}  // namespace forceshade::experiments
