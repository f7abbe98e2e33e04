// SPDX-License-Identifier: BSD-3-Clause
// The export of sessions to BIDS keeps the validator's rules, each of which is able to fail.
// study/tests/command/bids_export_test.sh runs the community's validators on it, where they are installed.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "study/experiments/bids.h"
#include "study/tests/experiments/bids_study.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

// ---- The validator's rules that bear on such a data set, each with its source ----

// The faults of the data set, one text for each broken rule. Numbers of sections are those of BIDS 1.9.0.
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

// A run that ended before its first tick: BIDS allows no empty file.
TEST_F(Bids, a_run_without_a_tick_has_no_motion) {
  const fs::path folder = directory.file("still");
  export_bids(sessions, folder, [](const fs::path&, int) {
    return Motion{1000, "maker", "model", [] { return std::optional<MotionSample>(); }};
  });
  EXPECT_FALSE(fs::exists(folder / "sub-B2/motion"));
  EXPECT_EQ(faults_of(folder), std::set<std::string>());
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

}  // namespace
}  // namespace forceshade::experiments
