// SPDX-License-Identifier: BSD-3-Clause
// The export of sessions to BIDS. tests/apps/bids_export_test.sh runs the community's validators on it, where they are
// installed.

#include "study/experiments/bids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "study/experiments/error.h"
#include "study/experiments/session_results.h"
#include "study/experiments/virtual_participant.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

const fs::path kExampleFiles = FORCESHADE_SOURCE_DIR "/examples/experiments";

// ---- The validator's rules that bear on such a data set, each with its source ----

std::string text_of(const fs::path& file) {
  return (std::ostringstream() << std::ifstream(file, std::ios::binary).rdbuf()).str();
}

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const fs::path& file) {
  Rows rows;
  std::istringstream in(text_of(file));
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream fields(line + '\t');
    for (std::string field; std::getline(fields, field, '\t');) row.push_back(field);
  }
  return rows;
}

nlohmann::json json_of(const fs::path& file) {
  return nlohmann::json::parse(text_of(file), nullptr, false);
}

bool is_number(const std::string& text) {
  static const std::regex number(R"([-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?)");  // schema: objects.formats.number
  return std::regex_match(text, number);
}

// What is wrong with the data set, one text for each broken rule. Numbers of sections are those of BIDS 1.9.0.
std::set<std::string> faults_of(const fs::path& folder) {
  std::set<std::string> faults;
  const auto require = [&](bool is_kept, const char* rule) {
    if (!is_kept) faults.insert(rule);
  };
  // Modality agnostic files, "Dataset description": Name and BIDSVersion are REQUIRED.
  const nlohmann::json about = json_of(folder / "dataset_description.json");
  require(about.is_object() && about.contains("Name") && about.contains("BIDSVersion"), "dataset_description");
  // The same, "README": a file README, README.md, README.rst or README.txt is REQUIRED.
  require(fs::exists(folder / "README"), "readme");
  // The same, "Participants file": participant_id is the first column; schema rules.checks.dataset.ParticipantIDMismatch.
  const Rows participants = rows_of(folder / "participants.tsv");
  std::set<std::string> listed, found;
  for (std::size_t i = 1; i < participants.size(); ++i) listed.insert(participants[i].front());
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory()) found.insert(entry.path().filename());
  require(!participants.empty() && participants[0].front() == "participant_id" && listed == found, "participants");
  // Schema rules.files.raw.task, .motion, .channels with objects.formats.label: entities in their order, labels of letters and
  // digits.
  static const std::regex behaviour(
      "sub-[0-9a-zA-Z]+/beh/sub-[0-9a-zA-Z]+_task-[0-9a-zA-Z]+(_run-[0-9]+)?_(events|beh)\\.(tsv|json)");
  static const std::regex motion(
      "sub-[0-9a-zA-Z]+/motion/sub-[0-9a-zA-Z]+_task-[0-9a-zA-Z]+_tracksys-[0-9a-zA-Z]+(_run-[0-9]+)?_(motion|events|channels)"
      "\\.(tsv|json)");
  static const std::set<std::string> at_top{"dataset_description.json", "README", "participants.tsv", "participants.json"};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const fs::path file = entry.path();
    const std::string relative = fs::relative(file, folder).string(), name = file.filename();
    require(at_top.contains(relative) || std::regex_match(relative, behaviour) || std::regex_match(relative, motion),
            "file_names");
    require(at_top.contains(relative) || name.starts_with(relative.substr(0, relative.find('/')) + '_'), "subject_in_name");
    if (file.extension() == ".json") require(json_of(file).is_object(), "json");
    if (file.extension() != ".tsv") continue;
    const Rows rows = rows_of(file);
    require(!rows.empty(), "empty_file");  // validator EMPTY_FILE
    if (rows.empty()) continue;
    const bool is_motion = name.ends_with("_motion.tsv");
    // Common principles, "Tabular files": each row as long as the header, n/a for what is missing, no name twice.
    for (const auto& row : rows) {
      require(row.size() == rows[0].size(), "row_length");
      for (const std::string& field : row) require(!field.empty(), "empty_cell");
    }
    if (!is_motion) require(std::set(rows[0].begin(), rows[0].end()).size() == rows[0].size(), "columns_once");
    fs::path sidecar = file;
    sidecar.replace_extension(".json");
    const nlohmann::json json = json_of(sidecar);
    require(json.is_object(), "sidecar");
    if (!json.is_object()) continue;
    // Validator warning TSV_ADDITIONAL_COLUMNS_UNDEFINED: columns beyond the defined ones are described.
    static const std::set<std::string> defined{"participant_id", "onset", "duration",      "trial_type", "name",
                                               "component",      "type",  "tracked_point", "units"};
    if (!is_motion)
      for (const std::string& column : rows[0])
        require(defined.contains(column) || (json.contains(column) && json[column].contains("Description")),
                "columns_described");
    // Legacy validator 1.15.0, validators/json/schemas/events.json: every key is an object, which describes a column or how
    // stimuli were presented. The schema, rules.checks.json: a column that is described is there.
    if (name.ends_with("_events.tsv"))
      for (const auto& [key, value] : json.items())
        require(value.is_object() &&
                    (key == "StimulusPresentation" || (std::ranges::count(rows[0], key) == 1 && value.contains("Description"))),
                "events_json");
    // Behavioural experiments: TaskName, TaskDescription and Instructions RECOMMENDED in *_beh.json, and in *_motion.json
    // (Motion).
    if (name.ends_with("_beh.tsv") || is_motion)
      for (const char* key : {"TaskName", "TaskDescription", "Instructions"})
        require(json.contains(key) && json[key].is_string() && !json[key].get<std::string>().empty(), "task");
    // Behavioural experiments, "_beh.tsv": onset and duration belong to events.
    if (name.ends_with("_beh.tsv"))
      for (const std::string& column : rows[0]) require(column != "onset" && column != "duration", "beh_columns");
    // Common principles, "task": the label is TaskName without what no label has.
    if (name.ends_with("_beh.tsv") || is_motion)
      require(name.find("_task-" + json.value("TaskName", "") + '_') != std::string::npos, "task_in_name");
    if (name.ends_with("_events.tsv")) {
      // Task events: onset and duration REQUIRED, first and second; schema rules.checks.events.SortedOnsets.
      require(rows[0].size() > 2 && rows[0][0] == "onset" && rows[0][1] == "duration", "onset_and_duration");
      double last = -1e300;
      for (std::size_t i = 1; i < rows.size(); ++i) {
        require(is_number(rows[i][0]) && (rows[i][1] == "n/a" || (is_number(rows[i][1]) && rows[i][1][0] != '-')),
                "event_numbers");
        if (!is_number(rows[i][0])) continue;
        require(std::stod(rows[i][0]) >= last, "sorted_onsets");
        last = std::stod(rows[i][0]);
        // Common principles, "Key-value files": levels that are described are those that occur.
        require(json["trial_type"]["Levels"].contains(rows[i][2]), "levels");
      }
    }
    const std::string base = name.substr(0, name.rfind('_'));
    if (is_motion) {
      // Motion: TaskName, SamplingFrequency, TrackingSystemName REQUIRED; schema rules.checks.motion.TrackSysParity.
      require(json.contains("TaskName") && json.contains("SamplingFrequency") && json.contains("TrackingSystemName"),
              "motion_json");
      // Legacy validator 1.15.0, validators/json/schemas/motion.json: no other keys than these, of those that the export knows.
      static const std::set<std::string> keys{
          "TaskName",           "TaskDescription",     "Instructions",          "SamplingFrequency",
          "TrackingSystemName", "MotionChannelCount",  "POSChannelCount",       "SamplingFrequencyEffective",
          "MISCChannelCount",   "LATENCYChannelCount", "TrackedPointsCount",    "RecordingDuration",
          "MissingValues",      "Manufacturer",        "ManufacturersModelName"};
      for (const auto& [key, value] : json.items()) require(keys.contains(key), "motion_keys");
      const std::size_t at = base.find("_tracksys-") + 10;
      require(json.value("TrackingSystemName", "") == base.substr(at, base.find('_', at) - at), "tracking_system");
      // Motion, "Motion recording data": no header, and as many columns as the channels file has rows.
      const fs::path channels = file.parent_path() / (base + "_channels.tsv");
      require(fs::exists(channels) && rows_of(channels).size() == rows[0].size() + 1, "channels");
      for (const std::string& field : rows[0]) require(is_number(field) || field == "n/a", "no_header");
      require(json.value("MotionChannelCount", 0U) == rows[0].size(), "channel_count");
      // Schema rules.checks.events.EventsMissing.
      require(fs::exists(file.parent_path() / (base + "_events.tsv")), "events_missing");
    }
    if (name.ends_with("_channels.tsv")) {
      // Schema rules.tabular_data.motion.motionChannels: these columns first; Motion: restricted keywords.
      static const std::vector<std::string> first{"name", "component", "type", "tracked_point", "units"};
      require(rows[0].size() >= 5 && std::equal(first.begin(), first.end(), rows[0].begin()), "channel_columns");
      static const std::set<std::string> components{"x", "y", "z", "quat_x", "quat_y", "quat_z", "quat_w", "n/a"},
          types{"ACCEL", "ANGACCEL", "GYRO", "JNTANG", "LATENCY", "MAGN", "MISC", "ORNT", "POS", "VEL"};
      // Motion: a channel's frame is described; legacy validator, schemas/channels.json: the values of its keys. The schema:
      // the counts of *_motion.json are those of the types.
      const nlohmann::json& frames = json["reference_frame"]["Levels"];
      const nlohmann::json motion_json = json_of(file.parent_path() / (base + "_motion.json"));
      std::map<std::string, unsigned> counts;
      std::set<std::string> points;
      for (std::size_t i = 1; i < rows.size(); ++i) {
        require(components.contains(rows[i][1]) && types.contains(rows[i][2]), "channel_keywords");
        require(rows[i].size() == 6 && frames.contains(rows[i][5]), "frames");
        ++counts[rows[i][2]];
        points.insert(rows[i][3]);
      }
      for (const auto& [type, count] : counts) require(motion_json.value(type + "ChannelCount", 0U) == count, "type_counts");
      require(motion_json.value("TrackedPointsCount", 0U) == points.size(), "tracked_points");
      static const std::set<std::string> orders{"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}, hands{"left-hand", "right-hand"};
      static const std::regex axes("[APLRSI_]{3}");
      for (const auto& [frame, of_it] : frames.items()) {
        require(of_it.contains("Description"), "frames");
        require(!of_it.contains("RotationOrder") || orders.contains(of_it["RotationOrder"].get<std::string>()),
                "rotation_order");
        require(!of_it.contains("RotationRule") || hands.contains(of_it["RotationRule"].get<std::string>()), "rotation_rule");
        require(!of_it.contains("SpatialAxes") || std::regex_match(of_it["SpatialAxes"].get<std::string>(), axes), "axes");
      }
    }
  }
  return faults;
}

// Two sessions: one finished by a virtual participant, one interrupted in a trial and in a break, with made ticks.
class Bids : public testing::Test {
 protected:
  void SetUp() override {
    Protocol protocol = read_protocol(kExampleFiles / "matching.toml");
    std::ifstream in(kExampleFiles / "matching.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("[600, 800, 1000, 1200, 1400]", "[1000]");
    replace("repetitions = 4", "repetitions = 1");
    replace("trials_before_break = 20", "trials_before_break = 2");
    replace("\"english.toml\"", '"' + (kExampleFiles / "english.toml").string() + '"');
    const std::string file = directory.write("p.toml", text);
    sessions = run_virtual_study(directory.file("study"), file, 1, 3);
    const fs::path second = directory.file("second");
    for (int run = 1; run <= 2; ++run) {
      RecordedSession recorded = run == 1 ? RecordedSession::start(second, file, "B-2", 1, {}, Sync::never)
                                          : RecordedSession::resume(second, {}, Sync::never);
      VirtualParticipant participant(protocol, fitted_observer(), feel_of_laws(protocol), 5);
      double time = 0;
      const auto has_run = [&] {
        return run == 1 ? recorded.session().current() && !recorded.session().current()->is_practice
                        : recorded.session().screen().title == "A break";
      };
      while (!has_run()) {
        const Response response = participant.next(recorded.session().screen(), recorded.session().scene());
        recorded.session().press(response.press, time += response.seconds);
      }
    }
    sessions.push_back(second);
    export_bids(sessions, out(), [&](const fs::path& session, int run) -> std::optional<Motion> {
      if (session != second || run != 2) return std::nullopt;
      return Motion{1000, "maker", "model", [i = 0]() mutable -> std::optional<MotionSample> {
                      if (++i > 5) return std::nullopt;
                      return MotionSample{0.001 * i, 1e-7, 0, -2.5, 0, 0, 1};
                    }};
    });
  }

  fs::path out() const { return directory.file("bids"); }

  tests::TemporaryDirectory directory;
  std::vector<fs::path> sessions;
};

TEST_F(Bids, the_export_keeps_the_rules) {
  EXPECT_EQ(faults_of(out()), std::set<std::string>());
  EXPECT_TRUE(fs::exists(out() / "sub-B2/motion/sub-B2_task-matching_tracksys-stylus_run-2_motion.tsv"));
  EXPECT_FALSE(fs::exists(out() / "sub-V1/motion"));
  const std::string interrupted = text_of(out() / "sub-B2/beh/sub-B2_task-matching_run-1_events.tsv");
  EXPECT_NE(interrupted.find("\tinterrupted\t"), std::string::npos) << interrupted;
  EXPECT_NE(text_of(out() / "sub-B2/beh/sub-B2_task-matching_run-2_events.tsv").find("\tbreak\t"), std::string::npos);
  int trials = 0;
  for (const auto& row : rows_of(out() / "sub-V1/beh/sub-V1_task-matching_run-1_events.tsv"))
    trials += row[2] == "matching" ? 1 : 0;
  EXPECT_EQ(trials, 24);
}

// Each row of behaviour is a trial of the events that was answered, with its duration as response time.
TEST_F(Bids, behaviour_holds_the_answered_trials_of_the_events) {
  int compared = 0, interrupted = 0;
  for (const std::string base : {"sub-V1/beh/sub-V1_task-matching_run-1", "sub-B2/beh/sub-B2_task-matching_run-1",
                                 "sub-B2/beh/sub-B2_task-matching_run-2"}) {
    const Rows events = rows_of(out() / (base + "_events.tsv")), answers = rows_of(out() / (base + "_beh.tsv"));
    Rows expected;
    for (std::size_t i = 1; i < events.size(); ++i) {
      interrupted += events[i][2] == "interrupted" ? 1 : 0;
      if (events[i].back() == "n/a") continue;
      std::vector<std::string>& row = expected.emplace_back(events[i].begin() + 2, events[i].end());
      row.push_back(events[i][1]);
    }
    EXPECT_EQ(Rows(answers.begin() + 1, answers.end()), expected) << base;
    for (const auto& row : expected) EXPECT_TRUE(is_number(row.back()) && std::stod(row.back()) < 100) << row.back();
    compared += static_cast<int>(expected.size());
  }
  EXPECT_GT(compared, 24);
  EXPECT_GT(interrupted, 0);
}

TEST_F(Bids, names_the_authors_that_are_given_and_invents_none) {
  EXPECT_FALSE(json_of(out() / "dataset_description.json").contains("Authors"));
  const std::vector<std::string> authors{"Ada Lovelace", "Müller, Jörg"};
  const fs::path folder = directory.file("named");
  export_bids(sessions, folder, {}, authors);
  EXPECT_EQ(json_of(folder / "dataset_description.json").value("Authors", std::vector<std::string>()), authors);
}

// A run that ended before its first tick: BIDS allows no empty file.
TEST_F(Bids, a_run_without_a_tick_has_no_motion) {
  const fs::path folder = directory.file("still");
  export_bids(sessions, folder, [](const fs::path&, int) {
    return Motion{1000, "maker", "model", [] { return std::optional<MotionSample>(); }};
  });
  EXPECT_FALSE(fs::exists(folder / "sub-B2/motion"));
  EXPECT_EQ(faults_of(folder), std::set<std::string>());
}

// Of a run's ticks: how long they last, and how many there are in a second.
TEST_F(Bids, motion_says_how_long_it_lasts) {
  const nlohmann::json json = json_of(out() / "sub-B2/motion/sub-B2_task-matching_tracksys-stylus_run-2_motion.json");
  EXPECT_NEAR(json.value("RecordingDuration", 0.0), 0.004, 1e-12);
  EXPECT_NEAR(json.value("SamplingFrequencyEffective", 0.0), 1000, 1e-6);
  EXPECT_EQ(json.value("SamplingFrequency", 0.0), 1000);
  EXPECT_EQ(json.value("Manufacturer", ""), "maker");
  EXPECT_EQ(json.value("ManufacturersModelName", ""), "model");
}

TEST_F(Bids, each_rule_is_able_to_fail) {
  const fs::path behaviour = out() / "sub-B2/beh/sub-B2_task-matching_run-1_events",
                 answers = out() / "sub-B2/beh/sub-B2_task-matching_run-2_beh",
                 motion = out() / "sub-B2/motion/sub-B2_task-matching_tracksys-stylus_run-2";
  const auto with = [](const fs::path& base, const char* end) { return fs::path(base.string() + end); };
  struct Break {
    const char* rule;
    fs::path file;
    std::string from, to;  // an empty `from` removes the file
  };
  const std::vector<Break> breaks{
      {"dataset_description", out() / "dataset_description.json", "BIDSVersion", "Version"},
      {"readme", out() / "README", "", ""},
      {"participants", out() / "participants.tsv", "sub-B2", "sub-B3"},
      {"json", out() / "participants.json", "{", ""},
      {"row_length", with(behaviour, ".tsv"), "\tpractice\t", "\t"},
      {"empty_cell", with(behaviour, ".tsv"), "\tn/a", "\t"},
      {"columns_once", with(behaviour, ".tsv"), "\tinitial\t", "\tvision\t"},
      {"sidecar", with(behaviour, ".json"), "", ""},
      {"columns_described", with(behaviour, ".json"), "\"vision\"", "\"sight\""},
      {"events_json", with(behaviour, ".json"), "{", "{\"TaskName\": \"matching\","},
      {"events_json", with(behaviour, ".json"), "\"vision\": {", "\"sight\": {\"Description\": \"\"}, \"vision\": {"},
      {"task", with(answers, ".json"), "\"Instructions\"", "\"Words\""},
      {"task", with(motion, "_motion.json"), "\"TaskDescription\"", "\"Task\""},
      {"task_in_name", with(answers, ".json"), "\"TaskName\": \"matching\"", "\"TaskName\": \"other\""},
      {"beh_columns", with(answers, ".tsv"), "response_time", "duration"},
      {"motion_keys", with(motion, "_motion.json"), "{", "{\"SpatialAxes\": \"RAS\","},
      {"frames", with(motion, "_channels.json"), "\"workspace\"", "\"world\""},
      {"rotation_order", with(motion, "_channels.json"), "\"workspace\": {", "\"workspace\": {\"RotationOrder\": \"n/a\","},
      {"rotation_rule", with(motion, "_channels.json"), "\"workspace\": {", "\"workspace\": {\"RotationRule\": \"n/a\","},
      {"axes", with(motion, "_channels.json"), "\"workspace\": {", "\"workspace\": {\"SpatialAxes\": \"RFU\","},
      {"type_counts", with(motion, "_motion.json"), "\"POSChannelCount\": 3", "\"POSChannelCount\": 2"},
      {"tracked_points", with(motion, "_motion.json"), "\"TrackedPointsCount\": 1", "\"TrackedPointsCount\": 2"},
      {"onset_and_duration", with(behaviour, ".tsv"), "onset\tduration", "duration\tonset"},
      {"event_numbers", with(behaviour, ".tsv"), "\n", "\nx"},
      {"sorted_onsets", with(behaviour, ".tsv"), "\n", "\n9999"},
      {"levels", with(behaviour, ".json"), "\"practice\"", "\"exercise\""},
      {"motion_json", with(motion, "_motion.json"), "\"SamplingFrequency\"", "\"Frequency\""},
      {"tracking_system", with(motion, "_motion.json"), "\"stylus\"", "\"hand\""},
      {"channels", with(motion, "_channels.tsv"), "force_z\tz\tMISC\tstylus_tip\tN\tworkspace\n", ""},
      {"no_header", with(motion, "_motion.tsv"), "0.001\t", "latency\t"},
      {"channel_count", with(motion, "_motion.json"), "\"MotionChannelCount\": 7", "\"MotionChannelCount\": 6"},
      {"events_missing", with(motion, "_events.tsv"), "", ""},
      {"channel_columns", with(motion, "_channels.tsv"), "component\ttype", "type\tcomponent"},
      {"channel_keywords", with(motion, "_channels.tsv"), "\tPOS\t", "\tpos\t"},
  };
  for (const Break& one : breaks) {
    const std::string before = text_of(one.file);
    if (one.from.empty()) {
      fs::remove(one.file);
    } else {
      std::string text = before;
      ASSERT_NE(text.find(one.from), std::string::npos) << one.rule;
      std::ofstream(one.file) << text.replace(text.find(one.from), one.from.size(), one.to);
    }
    EXPECT_TRUE(faults_of(out()).contains(one.rule)) << one.rule;
    std::ofstream(one.file) << before;
  }
  std::ofstream(out() / "sub-B2/beh/sub-V1_task-match-ing_events.tsv") << "";
  EXPECT_TRUE(faults_of(out()).contains("file_names"));
  EXPECT_TRUE(faults_of(out()).contains("subject_in_name"));
  EXPECT_TRUE(faults_of(out()).contains("empty_file"));
}

TEST_F(Bids, what_cannot_be_exported_is_refused_before_anything_is_written) {
  sessions.push_back(sessions.front());
  EXPECT_THROW(export_bids(sessions, directory.file("twice")), Error);
  EXPECT_FALSE(fs::exists(directory.file("twice")));
  EXPECT_THROW(export_bids({}, out()), Error) << "the folder is not empty";
}

// The columns of an events file by the results of the session and by its log.
TEST_F(Bids, each_cell_is_that_of_the_session) {
  const SavedSession session = read_session(sessions.front());
  const Results results = results_of(session);
  const Rows rows = rows_of(out() / "sub-V1/beh/sub-V1_task-matching_run-1_events.tsv");
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"onset", "duration", "trial_type", "trial", "stimulus", "radius_mil", "initial",
                                      "initial_radius_mil", "repetition", "vision", "matching_radius_mil", "response"}));
  const auto whole = [](double number) { return std::to_string(static_cast<int>(number)); };
  const std::array<const char*, 3> initials{"large", "same", "small"};
  std::map<std::string, std::vector<Event>> breaks;
  std::vector<double> starts;  // of the trials that count
  for (const Event& event : session.events) {
    if (event.kind == EventKind::trial_started && event.block > 0) starts.push_back(event.time);
    if (event.kind == EventKind::break_started) breaks["begin"].push_back(event);
    if (event.kind == EventKind::break_ended) breaks["end"].push_back(event);
  }
  std::size_t trials = 0, changes = 0, pauses = 0, practice = 0;
  std::vector<RadiusChange> by_keys = results.radius_changes;
  std::erase_if(by_keys, [](const RadiusChange& change) { return change.step == 0; });
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::vector<std::string>& row = rows[i];
    if (row[2] == "matching") {
      const MatchingResult& trial = results.matching.at(trials);
      const std::vector<std::string> expected{whole(trial.trial),
                                              trial.stimulus,
                                              whole(trial.reference_radius),
                                              initials[static_cast<std::size_t>(trial.initial)],
                                              whole(trial.initial_radius),
                                              whole(trial.repetition),
                                              trial.vision ? "yes" : "no",
                                              whole(trial.final_radius),
                                              whole(trial.satisfaction)};
      EXPECT_EQ(std::vector(row.begin() + 3, row.end()), expected);
      EXPECT_EQ(std::stod(row[0]), starts.at(trials));
      EXPECT_NEAR(std::stod(row[1]), trial.seconds, 1e-9);
      ++trials;
    } else if (row[2] == "radius_change" && row[3] != "n/a") {
      const RadiusChange& change = by_keys.at(changes++);
      EXPECT_NEAR(std::stod(row[0]), starts.at(static_cast<std::size_t>(change.trial) - 1) + change.seconds, 1e-9);
      EXPECT_EQ(row[1], "0");
      EXPECT_EQ(row[3], whole(change.trial));
      EXPECT_EQ(row[10], whole(change.radius));
      for (const std::size_t empty : {4U, 5U, 6U, 7U, 8U, 9U, 11U}) EXPECT_EQ(row[empty], "n/a");
    } else if (row[2] == "break") {
      EXPECT_EQ(std::stod(row[0]), breaks["begin"].at(pauses).time);
      EXPECT_NEAR(std::stod(row[1]), breaks["end"].at(pauses).time - breaks["begin"].at(pauses).time, 1e-9);
      ++pauses;
    } else if (row[2] == "practice") {
      EXPECT_EQ(row[3], "n/a") << "it has no number";
      EXPECT_NE(row[11], "n/a");
      ++practice;
    }
  }
  EXPECT_EQ(trials, results.matching.size());
  EXPECT_EQ(changes, by_keys.size());
  EXPECT_GT(changes, 24U);
  EXPECT_EQ(pauses, breaks["begin"].size());
  EXPECT_GT(pauses, 4U);
  EXPECT_EQ(practice, 4U);
}

// What the end of a run left unfinished has no duration and no answer, and the radius that it had.
TEST_F(Bids, an_interrupted_trial_and_break_have_no_duration) {
  for (const auto& [run, type] : {std::pair{"1", "interrupted"}, {"2", "break"}}) {
    const Rows rows = rows_of(out() / (std::string("sub-B2/beh/sub-B2_task-matching_run-") + run + "_events.tsv"));
    const auto unfinished = [](const std::vector<std::string>& row) { return row[1] == "n/a"; };
    ASSERT_EQ(std::ranges::count_if(rows, unfinished), 1) << run;
    const std::vector<std::string>& row = *std::ranges::find_if(rows, unfinished);
    EXPECT_EQ(row[2], type);
    EXPECT_EQ(row[11], "n/a");
    EXPECT_EQ(row[3] != "n/a", type == std::string("interrupted"));
  }
}

TEST_F(Bids, motion_has_the_ticks_of_its_run) {
  const std::string base = out() / "sub-B2/motion/sub-B2_task-matching_tracksys-stylus_run-2";
  EXPECT_EQ(text_of(base + "_motion.tsv"),
            "0.001\t1e-07\t0\t-2.5\t0\t0\t1\n0.002\t1e-07\t0\t-2.5\t0\t0\t1\n0.003\t1e-07\t0\t-2.5\t0\t0\t1\n"
            "0.004\t1e-07\t0\t-2.5\t0\t0\t1\n0.005\t1e-07\t0\t-2.5\t0\t0\t1\n");
  EXPECT_EQ(text_of(base + "_channels.tsv"),
            "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n"
            "latency\tn/a\tLATENCY\tstylus_tip\ts\tworkspace\n"
            "position_x\tx\tPOS\tstylus_tip\tmm\tworkspace\nposition_y\ty\tPOS\tstylus_tip\tmm\tworkspace\n"
            "position_z\tz\tPOS\tstylus_tip\tmm\tworkspace\nforce_x\tx\tMISC\tstylus_tip\tN\tworkspace\n"
            "force_y\ty\tMISC\tstylus_tip\tN\tworkspace\nforce_z\tz\tMISC\tstylus_tip\tN\tworkspace\n");
  EXPECT_EQ(text_of(base + "_events.tsv"), text_of(out() / "sub-B2/beh/sub-B2_task-matching_run-2_events.tsv"));
  // Each component in a column of its own, a single tick, and a device without a name.
  const fs::path folder = directory.file("one");
  export_bids(sessions, folder, [](const fs::path&, int run) -> std::optional<Motion> {
    if (run != 1) return std::nullopt;
    return Motion{500, "", "", [left = 1]() mutable -> std::optional<MotionSample> {
                    if (left-- == 0) return std::nullopt;
                    return MotionSample{7, 1, 2, 3, 4, 5, 6};
                  }};
  });
  const std::string one = folder / "sub-V1/motion/sub-V1_task-matching_tracksys-stylus_run-1";
  EXPECT_EQ(text_of(one + "_motion.tsv"), "7\t1\t2\t3\t4\t5\t6\n");
  const nlohmann::json json = json_of(one + "_motion.json");
  EXPECT_EQ(json["SamplingFrequencyEffective"], 500);
  EXPECT_EQ(json["RecordingDuration"], 0);
  EXPECT_FALSE(json.contains("Manufacturer"));
  EXPECT_FALSE(json.contains("ManufacturersModelName"));
}

TEST_F(Bids, the_data_set_says_who_took_part_and_what_it_is) {
  EXPECT_EQ(text_of(out() / "participants.tsv"), "participant_id\tpseudonym\nsub-B2\tB-2\nsub-V1\tV1\n");
  const nlohmann::json about = json_of(out() / "dataset_description.json");
  EXPECT_EQ(about["Name"], "Force shading for shape perception");
  EXPECT_EQ(about["BIDSVersion"], "1.9.0");
  EXPECT_EQ(about["DatasetType"], "raw");
  EXPECT_EQ(about["GeneratedBy"][0]["Name"], "forceshade");
  const std::string base = out() / "sub-V1/beh/sub-V1_task-matching_run-1";
  const nlohmann::json answers = json_of(base + "_beh.json"), events = json_of(base + "_events.json");
  const SavedSession session = read_session(sessions.front());
  EXPECT_EQ(answers["TaskName"], "matching");
  EXPECT_EQ(answers["TaskDescription"],
            "The participant changes the radius of the right bump until it feels like the left one.");
  EXPECT_EQ(answers["Instructions"], session.language.matching.text);
  EXPECT_EQ(answers["radius_mil"]["Description"], "Radius of the reference bump");
  EXPECT_EQ(answers["radius_mil"]["Units"], "mil (0.0254 mm)");
  EXPECT_EQ(answers["response"]["Description"], "Satisfaction index, 1 (entirely different) to 10 (no difference)");
  EXPECT_EQ(answers["response_time"]["Units"], "s");
  EXPECT_FALSE(answers["trial_type"]["Levels"].contains("break"));
  EXPECT_EQ(events["onset"]["Units"], "s");
  EXPECT_EQ(events["StimulusPresentation"]["SoftwareName"], "forceshade");
}

TEST_F(Bids, of_a_classification_describes_its_own_task) {
  const fs::path folder = directory.file("c");
  const std::vector<fs::path> own = run_virtual_study(directory.file("own"), kExampleFiles / "classification.toml", 1, 3);
  export_bids(own, folder);
  const SavedSession session = read_session(own.front());
  const Results results = results_of(session);
  const std::string base = folder / "sub-V1/beh/sub-V1_task-classification_run-1";
  const nlohmann::json answers = json_of(base + "_beh.json");
  EXPECT_EQ(answers["TaskName"], "classification");
  EXPECT_EQ(answers["TaskDescription"], "The participant feels a bump and chooses the most similar of four pictures.");
  EXPECT_EQ(answers["Instructions"], session.language.classification.text);
  EXPECT_EQ(answers["radius_mil"]["Description"], "Radius of the bump");
  EXPECT_EQ(answers["response"]["Description"], "Number of the picture: 1 plane, 2 two polygons, 3 three polygons, 4 cylinder");
  std::size_t trials = 0;
  for (const auto& row : rows_of(base + "_beh.tsv")) {
    if (row[0] != "classification") continue;
    const ClassificationResult& trial = results.classification.at(trials++);
    EXPECT_EQ(
        std::vector(row.begin() + 1, row.begin() + 10),
        (std::vector<std::string>{std::to_string(trial.trial), trial.stimulus, std::to_string(static_cast<int>(trial.radius)),
                                  "n/a", "n/a", std::to_string(trial.repetition), "yes", "n/a", std::to_string(trial.answer)}));
    EXPECT_NEAR(std::stod(row[10]), trial.seconds, 1e-9);
  }
  EXPECT_EQ(trials, 504U);
}

TEST_F(Bids, says_why_it_refuses_sessions) {
  const auto said = [&](const std::vector<fs::path>& all, const fs::path& folder) -> std::string {
    try {
      export_bids(all, folder);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  const fs::path second = sessions[1], twice = directory.file("B2");
  EXPECT_EQ(said({second, second}, directory.file("x")),
            second.string() + ": participant B-2 did the same experiment in an earlier session");
  RecordedSession::start(twice, second / "protocol.toml", "B2", 1, {}, Sync::never);
  EXPECT_EQ(said({second, twice}, directory.file("x")),
            twice.string() + ": participants B-2 and B2 become one in BIDS, where labels have no dashes: rename one");
  const std::string file = directory.write("file", "");
  EXPECT_EQ(said(sessions, file), file + ": expected no file of this name, or an empty folder");
  EXPECT_EQ(said(sessions, out()), out().string() + ": expected no file of this name, or an empty folder");
  fs::create_directory(directory.file("empty"));
  EXPECT_EQ(said(sessions, directory.file("empty")), "");
}

}  // namespace
}  // namespace forceshade::experiments
