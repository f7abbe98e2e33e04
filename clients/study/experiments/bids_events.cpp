// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/bids_events.h"

#include <algorithm>
#include <utility>

#include "files/csv.h"

namespace forceshade::experiments {
namespace {

constexpr const char* kColumns =
    "trial_type\ttrial\tstimulus\tradius_mil\tinitial\tinitial_radius_mil\trepetition\tvision\tmatching_radius_mil\t"
    "response\tused";

std::string cells_of(const EventRow& row) {
  std::string cells;
  for (const std::string* field : {&row.type, &row.trial, &row.stimulus, &row.radius, &row.initial, &row.initial_radius,
                                   &row.repetition, &row.vision, &row.matching_radius, &row.response, &row.used})
    cells += (cells.empty() ? "" : "\t") + (field->empty() ? kMissing : *field);
  return cells;
}

// The rows of each run. A trial's row is written when the trial ends, so rows are sorted by onset afterwards.
class Rows {
 public:
  explicit Rows(const SavedSession& session) : session_(session), blocks_(order(session.protocol, session.seed)) {
    const std::vector<TrialUse> uses = uses_of(session);
    for (std::size_t i = 0; i < uses.size(); ++i) add(session.events[i], uses[i]);
    interrupt();
    for (auto& [run, rows] : rows_)
      std::ranges::stable_sort(rows, [](const EventRow& a, const EventRow& b) { return a.onset < b.onset; });
  }

  const std::map<int, std::vector<EventRow>>& by_run() const { return rows_; }

 private:
  void add(const Event& event, TrialUse use) {
    switch (event.kind) {
      case EventKind::run_started:
        interrupt();
        run_ = event.run;
        rows_[run_];
        break;
      case EventKind::run_ended: interrupt(); break;
      case EventKind::block_started: vision_ = std::ranges::find(blocks_, event.block, &Block::number)->vision; break;
      case EventKind::trial_started: {
        const Trial& trial = event.trial;
        const bool is_matching = session_.protocol.experiment == Experiment::matching;
        EventRow row;
        row.onset = event.time;
        row.type = type_of(use);
        row.used = words_of(use);
        if (trial.number > 0) row.trial = std::to_string(trial.number);
        row.stimulus = trial.stimulus;
        row.radius = std::to_string(trial.radius);
        row.repetition = std::to_string(trial.repetition);
        row.vision = vision_ ? "yes" : "no";
        if (is_matching) {
          row.initial = trial.initial == InitialRadius::large   ? "large"
                        : trial.initial == InitialRadius::small ? "small"
                                                                : "same";
          row.initial_radius = row.matching_radius = std::to_string(trial.initial_radius);
        }
        trial_ = row;
        break;
      }
      case EventKind::radius_changed: {
        EventRow row;
        row.onset = event.time;
        row.duration = 0;
        row.type = "radius_change";
        if (trial_) {
          row.trial = trial_->trial;
          row.used = trial_->used;
          trial_->matching_radius = std::to_string(event.radius);
        }
        row.matching_radius = std::to_string(event.radius);
        rows_[run_].push_back(row);
        break;
      }
      case EventKind::answered:
        trial_->duration = event.time - trial_->onset;
        trial_->response = std::to_string(event.answer);
        rows_[run_].push_back(*std::exchange(trial_, std::nullopt));
        break;
      case EventKind::break_started:
        pause_ = EventRow();
        pause_->onset = event.time;
        pause_->type = "break";
        break;
      case EventKind::break_ended:
        pause_->duration = event.time - pause_->onset;
        rows_[run_].push_back(*std::exchange(pause_, std::nullopt));
        break;
      case EventKind::match_done:
      case EventKind::question_answered:
      case EventKind::session_ended: break;
    }
  }

  std::string type_of(TrialUse use) const {
    switch (use) {
      case TrialUse::practice: return "practice";
      case TrialUse::interrupted: return "interrupted";
      case TrialUse::abandoned: return "abandoned";
      case TrialUse::no_trial:
      case TrialUse::result: break;
    }
    return std::string(name_of(session_.protocol.experiment));
  }

  static const char* words_of(TrialUse use) { return use == TrialUse::result ? "yes" : "no"; }

  // Adds the rows that an end of the run left unfinished, of unknown duration.
  void interrupt() {
    if (trial_) rows_[run_].push_back(*std::exchange(trial_, std::nullopt));
    if (pause_) rows_[run_].push_back(*std::exchange(pause_, std::nullopt));
  }

  const SavedSession& session_;
  std::vector<Block> blocks_;
  std::map<int, std::vector<EventRow>> rows_;
  std::optional<EventRow> trial_, pause_;
  bool vision_ = true;
  int run_ = 0;
};

}  // namespace

std::string header_of_events() {
  return std::string("onset\tduration\t") + kColumns + '\n';
}

std::string line_of(const EventRow& row) {
  return shortest(row.onset) + '\t' + (row.duration ? shortest(*row.duration) : kMissing) + '\t' + cells_of(row) + '\n';
}

std::string header_of_behaviour() {
  return std::string(kColumns) + "\tresponse_time\n";
}

std::string behaviour_line_of(const EventRow& row) {
  return cells_of(row) + '\t' + shortest(*row.duration) + '\n';
}

std::map<int, std::vector<EventRow>> event_rows(const SavedSession& session) {
  return Rows(session).by_run();
}

}  // namespace forceshade::experiments
