// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/bids.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "files/csv.h"
#include "files/output_file.h"
#include "files/output_folder.h"
#include "study/experiments/error.h"
#include "study/experiments/session_folder.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;
using BidsJson = nlohmann::ordered_json;

constexpr const char* kTrackingSystem = "stylus";
constexpr const char* kMissing = "n/a";

void write_text(const fs::path& file, const std::string& text) {
  files::OutputFile out(file.string());
  out.stream() << text;
  out.commit();
}

void write_json(const fs::path& file, const BidsJson& json) {
  write_text(file, json.dump(2) + '\n');
}

// One row of an events file; what is empty becomes n/a.
struct EventRow {
  double onset = 0;
  std::optional<double> duration;
  std::string type;
  std::string trial, stimulus, radius, initial, initial_radius, repetition, vision, matching_radius, response;
};

constexpr const char* kEventColumns =
    "onset\tduration\ttrial_type\ttrial\tstimulus\tradius_mil\tinitial\tinitial_radius_mil\trepetition\tvision\tmatching_"
    "radius_mil\t"
    "response\n";

// The trials that were answered, without onset and duration, which BIDS keeps out of a file of behaviour.
constexpr const char* kBehaviourColumns =
    "trial_type\ttrial\tstimulus\tradius_mil\tinitial\tinitial_radius_mil\trepetition\tvision\tmatching_radius_mil\t"
    "response\tresponse_time\n";

std::string cells_of(const EventRow& row) {
  std::string cells;
  for (const std::string* field : {&row.type, &row.trial, &row.stimulus, &row.radius, &row.initial, &row.initial_radius,
                                   &row.repetition, &row.vision, &row.matching_radius, &row.response})
    cells += (cells.empty() ? "" : "\t") + (field->empty() ? kMissing : *field);
  return cells;
}

std::string line_of(const EventRow& row) {
  return files::shortest(row.onset) + '\t' + (row.duration ? files::shortest(*row.duration) : kMissing) + '\t' + cells_of(row) +
         '\n';
}

// The rows of each run. A trial's row is written when the trial ends, so rows are sorted by onset afterwards.
class Rows {
 public:
  explicit Rows(const SavedSession& session) : session_(session), blocks_(order(session.protocol, session.seed)) {
    for (const Event& event : session.events) add(event);
    interrupt();
    for (auto& [run, rows] : rows_)
      std::ranges::stable_sort(rows, [](const EventRow& a, const EventRow& b) { return a.onset < b.onset; });
  }

  const std::map<int, std::vector<EventRow>>& by_run() const { return rows_; }

 private:
  void add(const Event& event) {
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
        row.type = event.block == 0 ? "practice" : std::string(name_of(session_.protocol.experiment));
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

  // What an end of the run left unfinished, of unknown duration.
  void interrupt() {
    if (trial_) {
      trial_->type = "interrupted";
      rows_[run_].push_back(*std::exchange(trial_, std::nullopt));
    }
    if (pause_) rows_[run_].push_back(*std::exchange(pause_, std::nullopt));
  }

  const SavedSession& session_;
  std::vector<Block> blocks_;
  std::map<int, std::vector<EventRow>> rows_;
  std::optional<EventRow> trial_, pause_;
  bool vision_ = true;
  int run_ = 0;
};

BidsJson described(const std::string& description, const char* unit = nullptr) {
  BidsJson column{{"Description", description}};
  if (unit != nullptr) column["Units"] = unit;
  return column;
}

BidsJson with_levels(const std::string& description, const BidsJson& levels) {
  return {{"Description", description}, {"Levels", levels}};
}

const Heading& instructions_of(const SavedSession& session) {
  return session.protocol.experiment == Experiment::matching ? session.language.matching : session.language.classification;
}

std::string task_description(const SavedSession& session) {
  return session.protocol.experiment == Experiment::matching
             ? "The participant changes the radius of the right bump until it feels like the left one."
             : "The participant feels a bump and chooses the most similar of four pictures.";
}

// The task, in the sidecars of behaviour and motion. Sidecars of events describe columns, and hold none of these keys.
BidsJson task_of(const SavedSession& session) {
  return {{"TaskName", name_of(session.protocol.experiment)},
          {"TaskDescription", task_description(session)},
          {"Instructions", instructions_of(session).text}};
}

// The columns that trials of events and of behaviour have in common, but for the kind.
void describe_trials(BidsJson& json, const SavedSession& session) {
  const bool is_matching = session.protocol.experiment == Experiment::matching;
  json["trial"] = described("Number of the trial in the session, from 1");
  json["stimulus"] = described("How the matching bump, or the bump to classify, was rendered");
  json["radius_mil"] = described(is_matching ? "Radius of the reference bump" : "Radius of the bump", "mil (0.0254 mm)");
  json["initial"] = with_levels("Initial radius of the matching bump", {{"large", "The large initial radius of the protocol"},
                                                                        {"same", "That of the reference bump"},
                                                                        {"small", "The small initial radius of the protocol"}});
  json["initial_radius_mil"] = described("Initial radius of the matching bump", "mil (0.0254 mm)");
  json["repetition"] = described("Number of the repetition of the condition, from 1");
  json["vision"] = with_levels("Whether the bumps were shown on the screen", {{"yes", "Shown"}, {"no", "Hidden"}});
  json["matching_radius_mil"] = described("Radius of the matching bump after the event", "mil (0.0254 mm)");
  json["response"] = described(is_matching ? "Satisfaction index, 1 (entirely different) to 10 (no difference)"
                                           : "Number of the picture: 1 plane, 2 two polygons, 3 three polygons, 4 cylinder");
}

// Key by key what the kinds of trials are.
BidsJson kinds_of_trials() {
  return {{"matching", "A trial of the matching experiment"},
          {"classification", "A trial of the classification experiment"},
          {"practice", "A trial for practice, without use of its answer"}};
}

BidsJson events_sidecar(const SavedSession& session) {
  BidsJson json{{"StimulusPresentation", {{"SoftwareName", "forceshade"}}}};
  json["onset"] = described("Beginning of the event, from the first tick of the run", "s");
  json["duration"] = described("Until the answer was entered; n/a where the run ended before", "s");
  BidsJson kinds = kinds_of_trials();
  kinds["interrupted"] = "A trial that the end of the run interrupted; it was begun again in a later run";
  kinds["radius_change"] = "The participant changed the radius of the matching bump";
  kinds["break"] = "A break between trials";
  json["trial_type"] = with_levels("Kind of the event", kinds);
  describe_trials(json, session);
  return json;
}

BidsJson behaviour_sidecar(const SavedSession& session) {
  BidsJson json = task_of(session);
  json["trial_type"] = with_levels("Kind of the trial", kinds_of_trials());
  describe_trials(json, session);
  json["response_time"] = described("From the press that began the trial to the one that entered the answer", "s");
  return json;
}

struct Channel {
  const char *name, *component, *type, *unit;
};
constexpr std::array<Channel, 7> kChannels{{{"latency", "n/a", "LATENCY", "s"},
                                            {"position_x", "x", "POS", "mm"},
                                            {"position_y", "y", "POS", "mm"},
                                            {"position_z", "z", "POS", "mm"},
                                            {"force_x", "x", "MISC", "N"},
                                            {"force_y", "y", "MISC", "N"},
                                            {"force_z", "z", "MISC", "N"}}};

// `first`: the first tick of the run, which motion.next() has already given.
void write_motion(const fs::path& base, const SavedSession& session, const Motion& motion, const MotionSample& first) {
  files::OutputFile out(base.string() + "_motion.tsv");
  double last = first.time;
  std::size_t ticks = 0;
  for (std::optional<MotionSample> sample = first; sample; sample = motion.next()) {
    ++ticks;
    last = sample->time;
    out.stream() << files::shortest(sample->time);
    for (const double value : {sample->x, sample->y, sample->z, sample->fx, sample->fy, sample->fz})
      out.stream() << '\t' << files::shortest(value);
    out.stream() << '\n';
  }
  out.commit();
  std::string channels = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
  for (const Channel& channel : kChannels)
    channels += std::string(channel.name) + '\t' + channel.component + '\t' + channel.type + "\tstylus_tip\t" + channel.unit +
                "\tworkspace\n";
  write_text(base.string() + "_channels.tsv", channels);
  // The axes stand in the description alone: the specification names directions F/B, L/R and U/D in SpatialAxes, and its
  // validator (1.15.0) accepts only A/P, L/R and S/I. RotationOrder and RotationRule belong to orientations; there are none.
  BidsJson levels;
  levels["workspace"] = described("x to the right, y away from the participant, z up; the plane of the bumps is z = 0");
  BidsJson channels_json;
  channels_json["reference_frame"] = with_levels("Frame of positions and forces", levels);
  write_json(base.string() + "_channels.json", channels_json);
  const double seconds = last - first.time;
  BidsJson json = task_of(session);
  json.update({{"SamplingFrequency", motion.ticks_per_second},
               {"SamplingFrequencyEffective",
                ticks > 1 && seconds > 0 ? static_cast<double>(ticks - 1) / seconds : motion.ticks_per_second},
               {"TrackingSystemName", kTrackingSystem},
               {"RecordingDuration", seconds},
               {"MotionChannelCount", kChannels.size()},
               {"POSChannelCount", 3},
               {"MISCChannelCount", 3},
               {"LATENCYChannelCount", 1},
               {"TrackedPointsCount", 1},
               {"MissingValues", kMissing}});
  if (!motion.manufacturer.empty()) json["Manufacturer"] = motion.manufacturer;
  if (!motion.model.empty()) json["ManufacturersModelName"] = motion.model;
  write_json(base.string() + "_motion.json", json);
}

void write_events(const fs::path& base, const SavedSession& session, const std::vector<EventRow>& rows) {
  std::string text = kEventColumns;
  for (const EventRow& row : rows) text += line_of(row);
  write_text(base.string() + "_events.tsv", text);
  write_json(base.string() + "_events.json", events_sidecar(session));
}

void write_behaviour(const fs::path& base, const SavedSession& session, const std::vector<EventRow>& rows) {
  std::string text = kBehaviourColumns;
  for (const EventRow& row : rows)
    if (!row.response.empty()) text += cells_of(row) + '\t' + files::shortest(*row.duration) + '\n';
  write_text(base.string() + "_beh.tsv", text);
  write_json(base.string() + "_beh.json", behaviour_sidecar(session));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(folder, "cannot be made: " + error.message());
}

// Letters and digits alone (BIDS, "Participant names and other labels").
std::string label_of(const std::string& participant) {
  std::string label = participant;
  std::erase(label, '-');
  return label;
}

void export_session(const fs::path& from, const SavedSession& session, const fs::path& folder, const MotionOf& motion_of) {
  const std::string subject = "sub-" + label_of(session.participant);
  const std::string prefix = subject + "_task-" + std::string(name_of(session.protocol.experiment));
  const Rows rows(session);
  make_folder(folder / subject / "beh");
  for (const auto& [run, its_rows] : rows.by_run()) {
    const std::string suffix = "_run-" + std::to_string(run);
    write_events(folder / subject / "beh" / (prefix + suffix), session, its_rows);
    write_behaviour(folder / subject / "beh" / (prefix + suffix), session, its_rows);
    const std::optional<Motion> motion = motion_of ? motion_of(from, run) : std::nullopt;
    // A run that ended before its first tick has no motion: BIDS allows no empty file.
    const std::optional<MotionSample> first = motion ? motion->next() : std::nullopt;
    if (!first) continue;
    make_folder(folder / subject / "motion");
    const fs::path base = folder / subject / "motion" / (prefix + "_tracksys-" + kTrackingSystem + suffix);
    write_motion(base, session, *motion, *first);
    write_events(base, session, its_rows);
  }
}

}  // namespace

void export_bids(std::span<const fs::path> sessions, const fs::path& folder, const MotionOf& motion_of,
                 const std::vector<std::string>& authors) {
  std::error_code ignored;
  if (fs::exists(folder, ignored) && (!fs::is_directory(folder, ignored) || !fs::is_empty(folder, ignored)))
    throw Error(folder, "expected no file of this name, or an empty folder");
  // All that can be refused is refused before anything is written.
  std::vector<SavedSession> all;
  std::map<std::string, std::string> participants;  // by label
  std::set<std::pair<std::string, Experiment>> done;
  for (const fs::path& from : sessions) {
    const SavedSession& session = all.emplace_back(read_session(from));
    const auto [at, is_new] = participants.try_emplace(label_of(session.participant), session.participant);
    if (at->second != session.participant)
      throw Error(from, "participants " + at->second + " and " + session.participant +
                            " become one in BIDS, where labels have no dashes: rename one");
    if (!done.insert({session.participant, session.protocol.experiment}).second)
      throw Error(from, "participant " + session.participant + " did the same experiment in an earlier session");
  }
  files::OutputFolder whole(folder);
  for (std::size_t i = 0; i < all.size(); ++i) export_session(sessions[i], all[i], whole.so_far(), motion_of);
  std::string rows = "participant_id\tpseudonym\n";
  for (const auto& [label, participant] : participants) rows += "sub-" + label + '\t' + participant + '\n';
  write_text(whole.so_far() / "participants.tsv", rows);
  write_json(whole.so_far() / "participants.json",
             {{"pseudonym", described("Identifier in the session; nothing else about participants was recorded")}});
  write_text(
      whole.so_far() / "README",
      "Haptic shape perception: sessions of forceshade's matching and classification experiments, after Morgenbesser and\n"
      "Srinivasan, Force Shading for Shape Perception in Haptic Virtual Environments (MIT, 1995).\n"
      "Trials, answers and changes of the radius: sub-*/beh. Positions and forces of the stylus: sub-*/motion.\n"
      "Exported by forceshade.\n");
  BidsJson about{{"Name", "Force shading for shape perception"}, {"BIDSVersion", "1.9.0"}, {"DatasetType", "raw"}};
  if (!authors.empty()) about["Authors"] = authors;
  about["GeneratedBy"] = BidsJson::array({{{"Name", "forceshade"}}});
  write_json(whole.so_far() / "dataset_description.json", about);
  whole.commit();
}

}  // namespace forceshade::experiments
