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
#include "files/input_file.h"
#include "files/output_file.h"
#include "files/output_folder.h"
#include "study/experiments/bids_events.h"
#include "study/experiments/session_folder.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;
using BidsJson = nlohmann::ordered_json;

constexpr const char* kTrackingSystem = "stylus";

void write_text(const fs::path& file, const std::string& text) {
  files::write_file(file.string(), text);
}

void write_json(const fs::path& file, const BidsJson& json) {
  write_text(file, json.dump(2) + '\n');
}

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
  json["stimulus"] = described("Rendering of the matching bump, or of the bump to classify");
  json["radius_mil"] = described(is_matching ? "Radius of the reference bump" : "Radius of the bump", "mil (0.0254 mm)");
  json["initial"] = with_levels("Initial radius of the matching bump", {{"large", "The large initial radius of the protocol"},
                                                                        {"same", "That of the reference bump"},
                                                                        {"small", "The small initial radius of the protocol"}});
  json["initial_radius_mil"] = described("Initial radius of the matching bump", "mil (0.0254 mm)");
  json["repetition"] = described("Number of the repetition of the condition, from 1");
  json["vision"] = with_levels("Visibility of the bumps on the screen", {{"yes", "Shown"}, {"no", "Hidden"}});
  json["matching_radius_mil"] = described("Radius of the matching bump after the event", "mil (0.0254 mm)");
  json["used"] = with_levels("Use of the event's trial in the results",
                             {{"yes", "Used"}, {"no", "Not used: practice, interrupted or abandoned"}});
  json["response"] = described(is_matching ? "Satisfaction index, 1 (entirely different) to 10 (no difference)"
                                           : "Number of the picture: 1 plane, 2 two polygons, 3 three polygons, 4 cylinder");
}

// Key by key what the kinds of trials are.
BidsJson kinds_of_trials() {
  return {
      {"matching", "A trial of the matching experiment"},
      {"classification", "A trial of the classification experiment"},
      {"practice", "A trial for practice, without use of its answer"},
      {"abandoned", "A trial that was answered, without use of its answer: after an interruption its block was begun again"}};
}

BidsJson events_sidecar(const SavedSession& session) {
  BidsJson json{{"StimulusPresentation", {{"SoftwareName", "forceshade"}}}};
  json["onset"] = described("Beginning of the event, from the first tick of the run", "s");
  json["duration"] = described("Until the answer was entered; n/a where the run ended before", "s");
  BidsJson kinds = kinds_of_trials();
  kinds["interrupted"] = "A trial that the end of the run interrupted; a later run begins it, or its block, again";
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
    out.stream() << shortest(sample->time);
    for (const double value : {sample->x, sample->y, sample->z, sample->fx, sample->fy, sample->fz})
      out.stream() << '\t' << shortest(value);
    out.stream() << '\n';
  }
  out.commit();
  std::string channels = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
  for (const Channel& channel : kChannels)
    channels += std::string(channel.name) + '\t' + channel.component + '\t' + channel.type + "\tstylus_tip\t" + channel.unit +
                "\tworkspace\n";
  write_text(base.string() + "_channels.tsv", channels);
  // The axes stand in the description alone: the specification names directions F/B, L/R and U/D in SpatialAxes, and its
  // validator (1.15.0) accepts only A/P, L/R and S/I. RotationOrder and RotationRule belong to orientations: not recorded.
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
  std::string text = header_of_events();
  for (const EventRow& row : rows) text += line_of(row);
  write_text(base.string() + "_events.tsv", text);
  write_json(base.string() + "_events.json", events_sidecar(session));
}

void write_behaviour(const fs::path& base, const SavedSession& session, const std::vector<EventRow>& rows) {
  std::string text = header_of_behaviour();
  for (const EventRow& row : rows)
    if (!row.response.empty()) text += behaviour_line_of(row);
  write_text(base.string() + "_beh.tsv", text);
  write_json(base.string() + "_beh.json", behaviour_sidecar(session));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(folder, "cannot be made: " + error.message());
}

// Letters and digits alone (BIDS, "Participant names and other labels"). Whoever knows BIDS calls participants sub-01.
std::string label_of(const std::string& participant) {
  const bool has_prefix = participant.size() > 4 && files::folded_name(participant.substr(0, 4)) == "sub-";
  std::string label = participant.substr(has_prefix ? 4 : 0);
  std::erase(label, '-');
  return label.empty() ? "sub" : label;
}

void export_session(const fs::path& from, const SavedSession& session, const fs::path& folder, const MotionOf& motion_of) {
  const std::string subject = "sub-" + label_of(session.participant);
  const std::string prefix = subject + "_task-" + std::string(name_of(session.protocol.experiment));
  make_folder(folder / subject / "beh");
  for (const auto& [run, its_rows] : event_rows(session)) {
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

// A participant's sessions together.
struct Participant {
  std::string pseudonym;
  std::vector<std::string> answered_by, devices, certified;

  static void add(std::vector<std::string>& words, const std::string& more) {
    const std::string known = more.empty() ? kMissing : more;
    if (std::ranges::find(words, known) == words.end()) words.push_back(known);
  }

  void add(const SavedSession& session) {
    add(answered_by, std::string(name_of(session.answered_by)));
    for (const Event& event : session.events) {
      if (event.kind != EventKind::run_started) continue;
      add(devices, event.device);
      add(certified, !event.certified ? "" : *event.certified ? "yes" : "no");
    }
  }
};

std::string joined(const std::vector<std::string>& words, const char* between = "; ") {
  std::string all;
  for (const std::string& one : words) all += (all.empty() ? "" : between) + one;
  return all;
}

// "sub-V1, sub-V2": the participants that have this word.
std::string subjects_with(const std::map<std::string, Participant>& participants, std::vector<std::string> Participant::*words,
                          const std::string& word) {
  std::vector<std::string> subjects;
  for (const auto& [label, participant] : participants)
    if (std::ranges::find(participant.*words, word) != (participant.*words).end()) subjects.push_back("sub-" + label);
  return joined(subjects, ", ");
}

std::string readme_of(const std::map<std::string, Participant>& participants) {
  std::string text =
      "Haptic shape perception: sessions of forceshade's matching and classification experiments, after Morgenbesser and\n"
      "Srinivasan, Force Shading for Shape Perception in Haptic Virtual Environments (RLE Technical Report 606, MIT, 1996).\n"
      "Trials, answers and changes of the radius: sub-*/beh. Positions and forces of the stylus: sub-*/motion.\n";
  const std::string model(name_of(AnsweredBy::model));
  if (const std::string subjects = subjects_with(participants, &Participant::answered_by, model); !subjects.empty())
    text += "No person answered for " + subjects + ": it is a virtual participant, a model on a simulated device.\n";
  if (const std::string subjects = subjects_with(participants, &Participant::certified, "no"); !subjects.empty())
    text += "The forces were not certified for " + subjects + ".\n";
  return text + "Answers, devices and the certification of forces: participants.tsv.\nExported by forceshade.\n";
}

BidsJson participants_sidecar() {
  return {{"pseudonym", described("Identifier in the session; nothing else about participants was recorded")},
          {"answered_by",
           with_levels("Source of the answers", {{"person", "A person"}, {"virtual participant", "A model of a person"}})},
          {"device", described("The devices that gave the forces, as forceshade names them; simulated: no real device")},
          {"certified", with_levels("Certification of the forces", {{"yes", "Certified"},
                                                                    {"no", "Not certified"},
                                                                    {"yes; no", "Not in every run"},
                                                                    {"no; yes", "Not in every run"}})}};
}

// Words of what was exported of each participant, by label. All that can be refused is refused before anything is written.
std::map<std::string, Participant> participants_of(std::span<const fs::path> folders,
                                                   const std::vector<SavedSession>& sessions) {
  std::map<std::string, Participant> participants;
  std::map<std::string, std::string> by_folded;
  std::set<std::pair<std::string, Experiment>> done;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const SavedSession& session = sessions[i];
    const std::string& name = session.participant;
    const auto [at, is_new] = by_folded.try_emplace(files::folded_name(label_of(name)), name);
    if (at->second != name)
      throw Error(folders[i],
                  "participants " + at->second + " and " + name +
                      " become one in BIDS, where labels have no dashes and no \"sub-\" of their own, and where file "
                      "systems may take capital letters for small ones: rename one");
    if (!done.insert({name, session.protocol.experiment}).second)
      throw Error(folders[i], "participant " + name + " did the same experiment in an earlier session");
    Participant& its = participants[label_of(name)];
    its.pseudonym = name;
    its.add(session);
  }
  return participants;
}

}  // namespace

void export_bids(std::span<const fs::path> sessions, files::OutputFolder& whole, const MotionOf& motion_of,
                 const std::vector<std::string>& authors) {
  if (!whole.is_for_an_empty_path()) throw Error(whole.path(), "expected no file of this name, or an empty folder");
  std::vector<SavedSession> all;
  for (const fs::path& from : sessions) all.push_back(read_session(from));
  const std::map<std::string, Participant> participants = participants_of(sessions, all);
  for (std::size_t i = 0; i < all.size(); ++i) export_session(sessions[i], all[i], whole.so_far(), motion_of);
  std::string rows = "participant_id\tpseudonym\tanswered_by\tdevice\tcertified\n";
  for (const auto& [label, its] : participants)
    rows += "sub-" + label + '\t' + its.pseudonym + '\t' + joined(its.answered_by) + '\t' + joined(its.devices) + '\t' +
            joined(its.certified) + '\n';
  write_text(whole.so_far() / "participants.tsv", rows);
  write_json(whole.so_far() / "participants.json", participants_sidecar());
  write_text(whole.so_far() / "README", readme_of(participants));
  const bool is_virtual =
      !all.empty() && std::ranges::all_of(all, [](const SavedSession& one) { return one.answered_by == AnsweredBy::model; });
  BidsJson about{{"Name", std::string("Force shading for shape perception") + (is_virtual ? ", virtual participants" : "")},
                 {"BIDSVersion", "1.9.0"},
                 {"DatasetType", "raw"}};
  if (!authors.empty()) about["Authors"] = authors;
  about["GeneratedBy"] = BidsJson::array({{{"Name", "forceshade"}}});
  write_json(whole.so_far() / "dataset_description.json", about);
}

void export_bids(std::span<const fs::path> sessions, const fs::path& folder, const MotionOf& motion_of,
                 const std::vector<std::string>& authors) {
  files::OutputFolder whole(folder);
  export_bids(sessions, whole, motion_of, authors);
  whole.commit();
}

}  // namespace forceshade::experiments
