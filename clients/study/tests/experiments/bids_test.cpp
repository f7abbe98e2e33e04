// SPDX-License-Identifier: BSD-3-Clause
// The export of sessions to BIDS: what stands in its files is what the sessions hold.

#include "study/experiments/bids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/input_file.h"
#include "study/experiments/session_results.h"
#include "study/experiments/virtual_participant.h"
#include "study/tests/experiments/bids_study.h"
#include "study/tests/experiments/example_protocols.h"
#include "study/tests/experiments/small_protocols.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

// Each row of behaviour is a trial of the events that was answered, with its duration as response time.
TEST_F(Bids, behaviour_holds_the_answered_trials_of_the_events) {
  int compared = 0, interrupted = 0;
  for (const std::string base : {"sub-V1/beh/sub-V1_task-matching_run-1", "sub-B2/beh/sub-B2_task-matching_run-1",
                                 "sub-B2/beh/sub-B2_task-matching_run-2"}) {
    const Rows events = rows_of(out() / (base + "_events.tsv")), answers = rows_of(out() / (base + "_beh.tsv"));
    Rows expected;
    for (std::size_t i = 1; i < events.size(); ++i) {
      interrupted += events[i][2] == "interrupted" ? 1 : 0;
      if (events[i][11] == "n/a") continue;
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

// A pseudonym that is a label of BIDS, as sub-01, gets no second prefix. One that only begins like it keeps its letters.
TEST_F(Bids, a_label_has_its_prefix_once) {
  for (const auto& [pseudonym, subject] : std::vector<std::pair<std::string, std::string>>{
           {"sub-01", "sub-01"}, {"Sub-A-7", "sub-A7"}, {"subject-1", "sub-subject1"}, {"sub-", "sub-sub"}, {"01", "sub-01"}}) {
    const fs::path session = directory.file("session of " + pseudonym), folder = directory.file("of " + pseudonym);
    RecordedSession::start(session, sessions[1] / "protocol.toml", pseudonym, 1, {}, Sync::never);
    export_bids(std::vector<fs::path>{session}, folder);
    EXPECT_TRUE(
        text_of(folder / "participants.tsv").ends_with("certified\n" + subject + '\t' + pseudonym + "\tn/a\tn/a\tn/a\n"))
        << text_of(folder / "participants.tsv");
    EXPECT_TRUE(fs::exists(folder / subject / "beh" / (subject + "_task-matching_run-1_beh.tsv")));
  }
}

// A session whose block begins again after an interruption: what went before has a kind of its own, and is not used, whatever
// the event; the answers that are left are those of the results.
TEST_F(Bids, trials_of_a_block_that_was_begun_again_are_abandoned) {
  const fs::path session = directory.file("again"), folder = directory.file("again bids");
  double time = 0;
  {
    RecordedSession recorded =
        RecordedSession::start(session, directory.write("again.toml", small_matching("block")), "P", 5, {}, Sync::never);
    go_on(recorded.session(), time, 2 + 4 + 1 + 3 * 4 + 1);  // into the fourth trial of the first block
  }
  RecordedSession resumed = RecordedSession::resume(session, {}, Sync::never);
  time = 0;
  go_on(resumed.session(), time);
  export_bids(std::vector<fs::path>{session}, folder);
  std::map<std::string, int> kinds, used;
  std::vector<std::string> answers;
  for (const char* run : {"1", "2"}) {
    const std::string base = folder / "sub-P/beh/sub-P_task-matching_run-";
    for (const auto& row : rows_of(base + run + "_beh.tsv")) {
      ++kinds[row[0] + ' ' + row[10]];
      if (row[10] == "yes") answers.push_back(row[1] + ' ' + row[9]);
    }
    for (const auto& row : rows_of(base + run + "_events.tsv"))
      if (row[2] == "radius_change" || row[2] == "interrupted") ++used[row[2] + ' ' + row[12] + " in run " + run];
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{
                       {"trial_type used", 2}, {"practice no", 1}, {"abandoned no", 3}, {"matching yes", 12}}));
  const Results results = results_of(read_session(session));
  std::vector<std::string> expected;
  for (const MatchingResult& trial : results.matching)
    expected.push_back(std::to_string(trial.trial) + ' ' + std::to_string(trial.satisfaction));
  EXPECT_EQ(answers, expected);
  EXPECT_EQ(used["interrupted no in run 1"], 1);
  EXPECT_GT(used["radius_change no in run 1"], 2);
  EXPECT_GT(used["radius_change yes in run 2"], 11);
  EXPECT_EQ(used.size(), 3U);
}

// The duration of a run's ticks, and their number in a second.
TEST_F(Bids, motion_says_how_long_it_lasts) {
  const nlohmann::json json = json_of(out() / "sub-B2/motion/sub-B2_task-matching_tracksys-stylus_run-2_motion.json");
  EXPECT_NEAR(json.value("RecordingDuration", 0.0), 0.004, 1e-12);
  EXPECT_NEAR(json.value("SamplingFrequencyEffective", 0.0), 1000, 1e-6);
  EXPECT_EQ(json.value("SamplingFrequency", 0.0), 1000);
  EXPECT_EQ(json.value("Manufacturer", ""), "maker");
  EXPECT_EQ(json.value("ManufacturersModelName", ""), "model");
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
  EXPECT_EQ(rows[0], (std::vector<std::string>{"onset", "duration", "trial_type", "trial", "stimulus", "radius_mil", "initial",
                                               "initial_radius_mil", "repetition", "vision", "matching_radius_mil", "response",
                                               "used"}));
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
                                              whole(trial.satisfaction),
                                              "yes"};
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

// A trial or break that the end of a run interrupts has no duration and no answer, and the radius that it had.
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
  EXPECT_EQ(text_of(out() / "participants.tsv"),
            "participant_id\tpseudonym\tanswered_by\tdevice\tcertified\nsub-B2\tB-2\tperson\tan arm\tyes; no\n"
            "sub-V1\tV1\tvirtual participant\tnone\tn/a\n");
  const std::string readme = text_of(out() / "README");
  EXPECT_NE(readme.find("No person answered for sub-V1: it is a virtual participant"), std::string::npos) << readme;
  EXPECT_NE(readme.find("The forces were not certified for sub-B2.\n"), std::string::npos) << readme;
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
  const std::vector<fs::path> own = run_virtual_study(directory.file("own"), kExamples / "classification.toml", 1, 3);
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
    EXPECT_EQ(row[10], "yes");
    EXPECT_NEAR(std::stod(row[11]), trial.seconds, 1e-9);
  }
  EXPECT_EQ(trials, 504U);
  EXPECT_EQ(json_of(folder / "dataset_description.json")["Name"], "Force shading for shape perception, virtual participants");
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
  const auto become_one = [&](const fs::path& from, const std::string& both) {
    return from.string() + ": participants " + both +
           " become one in BIDS, where labels have no dashes and no \"sub-\" of their own, and where file systems may take "
           "capital letters for small ones: rename one";
  };
  EXPECT_EQ(said({second, twice}, directory.file("x")), become_one(twice, "B-2 and B2"));
  for (const char* other : {"b2", "sub-B2", "SUB-b-2"}) {
    const fs::path folder = directory.file(std::string("other ") + other);
    RecordedSession::start(folder, second / "protocol.toml", other, 1, {}, Sync::never);
    EXPECT_EQ(said({second, folder}, directory.file("x")), become_one(folder, std::string("B-2 and ") + other));
  }
  const std::string file = directory.write("file", "");
  EXPECT_EQ(said(sessions, file), file + ": expected no file of this name, or an empty folder");
  EXPECT_EQ(said(sessions, out()), out().string() + ": expected no file of this name, or an empty folder");
  fs::create_directory(directory.file("empty"));
  EXPECT_EQ(said(sessions, directory.file("empty")), "");
}

}  // namespace
}  // namespace forceshade::experiments
