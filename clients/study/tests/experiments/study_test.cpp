// SPDX-License-Identifier: BSD-3-Clause
// Virtual participants.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "study/experiments/session_results.h"
#include "study/experiments/virtual_participant.h"
#include "study/tests/experiments/example_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

// At 1 N and 0.5 N/mm the hand is 2 mm deep everywhere.
TEST(virtual_participant, feels_what_the_laws_say) {
  const Protocol protocol = read_protocol(kExamples / "matching.toml");
  const Feel feel = feel_of_laws(protocol);
  const double radius = 25.4, depth = 2;
  const std::vector<double> places = stroke_places(protocol);
  const Stroke flat = feel({"bump-1p-shaded", 1000, 0}), round = feel({"bump-cylinder", 1000, 0});
  ASSERT_EQ(flat.size(), kStrokePlaces);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = std::fabs(places[i]), normal = std::asin(x / radius) * 180 / std::numbers::pi;
    EXPECT_NEAR(flat[i].height, 0, 1e-4);
    EXPECT_NEAR(flat[i].direction, normal, 1e-4);
    // Near the sides of the cylinder the plane pushes, too.
    const double height = std::sqrt((radius - depth) * (radius - depth) - x * x) - std::sqrt(radius * radius - 12.7 * 12.7);
    if (height < 0) continue;
    EXPECT_NEAR(round[i].height, height + depth, 1e-4);
    EXPECT_NEAR(round[i].direction, std::asin(x / (radius - depth)) * 180 / std::numbers::pi, 1e-3);
  }
}

struct Ran {
  Results results;
};

Ran run_in_memory(const Protocol& protocol, const Observer& observer, std::uint64_t seed) {
  SavedSession saved{"V", seed, protocol, read_language(protocol.language), {}, {}};
  Session session(protocol, saved.language, seed, [&](const Event& event) { saved.events.push_back(event); });
  VirtualParticipant participant(protocol, observer, feel_of_laws(protocol), seed);
  run_to_end(session, participant);
  return {results_of(saved)};
}

TEST(virtual_participant, does_every_trial_and_repeats_itself_for_a_seed) {
  for (const char* file : {"matching.toml", "classification.toml"}) {
    const Protocol protocol = read_protocol(kExamples / file);
    const Ran one = run_in_memory(protocol, fitted_observer(), 1), again = run_in_memory(protocol, fitted_observer(), 1),
              other = run_in_memory(protocol, fitted_observer(), 2);
    EXPECT_EQ(static_cast<int>(one.results.matching.size() + one.results.classification.size()), protocol.trials());
    const auto answers = [](const Ran& ran) {
      std::vector<double> all;
      for (const MatchingResult& trial : ran.results.matching) all.push_back(trial.final_radius);
      for (const ClassificationResult& trial : ran.results.classification) all.push_back(trial.answer);
      return all;
    };
    EXPECT_EQ(answers(one), answers(again));
    EXPECT_NE(answers(one), answers(other));
  }
}

// Without noise two round bumps are matched exactly, but for the step of the keys.
TEST(virtual_participant, without_noise_matches_cylinders) {
  Protocol protocol = read_protocol(kExamples / "matching.toml");
  protocol.stimuli.resize(1);
  Observer observer = fitted_observer();
  observer.position_noise = observer.direction_noise = 0.001;
  int matched = 0;
  for (const MatchingResult& trial : run_in_memory(protocol, observer, 1).results.matching) {
    EXPECT_LE(std::fabs(trial.final_radius - trial.reference_radius), protocol.radius_step);
    ++matched;
  }
  EXPECT_EQ(matched, 120);
}

// The combination of cues: one who cannot feel directions takes every shaded plane for flat, and makes it as high as the keys
// allow; one who cannot feel heights makes the mean direction that of the reference, to a step of the keys.
TEST(virtual_participant, weighs_the_cues_by_their_noise) {
  Protocol protocol = read_protocol(kExamples / "matching.toml");
  std::erase_if(protocol.stimuli, [](const Stimulus& stimulus) { return stimulus.name != "bump-1p-shaded"; });
  protocol.reference_radii = {800, 1000, 1200, 1400};
  Observer by_height = fitted_observer(), by_direction = fitted_observer();
  by_height.position_noise = by_direction.direction_noise = 0.0001;
  by_height.direction_noise = by_direction.position_noise = 50;
  const Feel feel = feel_of_laws(protocol);
  int matched = 0;
  for (const MatchingResult& trial : run_in_memory(protocol, by_height, 1).results.matching)
    EXPECT_EQ(trial.final_radius, protocol.least_radius);
  for (const MatchingResult& trial : run_in_memory(protocol, by_direction, 1).results.matching) {
    const auto mean_direction = [&](const std::string& stimulus, double radius) {
      double sum = 0;
      for (const Felt& felt : feel({stimulus, static_cast<Mil>(radius), 0})) sum += felt.direction;
      return sum / kStrokePlaces;
    };
    const double reference = mean_direction("bump-cylinder", trial.reference_radius);
    EXPECT_LE(mean_direction(trial.stimulus, trial.final_radius + protocol.radius_step), reference);
    EXPECT_GE(mean_direction(trial.stimulus, trial.final_radius - protocol.radius_step), reference);
    ++matched;
  }
  EXPECT_EQ(matched, 2 * 4 * 3 * 4);
}

TEST(virtual_study, leaves_sessions_as_a_person_does) {
  const tests::TemporaryDirectory directory;
  const std::vector<fs::path> folders = run_virtual_study(directory.file("study"), kExamples / "classification.toml", 2, 9);
  ASSERT_EQ(folders.size(), 2U);
  const Results results = results_of(folders);
  EXPECT_EQ(results.classification.size(), 2U * 504);
  EXPECT_EQ(results.classification.back().participant, "V2");
}

// The answers of a seed's participant: a change of a number of the model, of the noise or of the order in which it is drawn
// would give recorded seeds another meaning. The numbers are those of the version that clients/study/README.md describes.
TEST(virtual_participant, of_a_seed_does_the_same_for_ever) {
  Protocol matching = read_protocol(kExamples / "matching.toml");
  SavedSession saved{"V", 5, matching, read_language(matching.language), {}, {}};
  Session session(matching, saved.language, 5, [&](const Event& event) { saved.events.push_back(event); });
  VirtualParticipant participant(matching, fitted_observer(), feel_of_laws(matching), 6);
  const double seconds = run_to_end(session, participant);
  double radii = 0;
  int satisfaction = 0, steps = 0;
  for (const MatchingResult& trial : results_of(saved).matching) {
    radii += trial.final_radius;
    satisfaction += trial.satisfaction;
    steps += trial.steps;
  }
  EXPECT_EQ(radii, 443'340);
  EXPECT_EQ(satisfaction, 3322);
  EXPECT_EQ(steps, 14'879);
  EXPECT_NEAR(seconds, 21'793.4, 1e-6);
  // One who is never content compares until the most comparisons are made.
  matching.stimuli.resize(1);
  matching.reference_radii = {1000};
  Observer hesitant = fitted_observer();
  hesitant.criterion = 0;
  int hesitant_steps = 0;
  for (const MatchingResult& trial : run_in_memory(matching, hesitant, 8).results.matching) hesitant_steps += trial.steps;
  EXPECT_EQ(hesitant_steps, 12'472);
  const Protocol classification = read_protocol(kExamples / "classification.toml");
  std::vector<int> answers(4);
  int by_place = 0, place = 0;
  for (const ClassificationResult& trial : run_in_memory(classification, fitted_observer(), 7).results.classification) {
    ++answers[static_cast<std::size_t>(trial.answer - 1)];
    by_place += ++place * trial.answer;
  }
  EXPECT_EQ(answers, (std::vector<int>{62, 80, 126, 236}));
  EXPECT_EQ(by_place, 393'656);
}

TEST(virtual_study, has_folders_and_seeds_of_its_own_for_each_participant) {
  const tests::TemporaryDirectory directory;
  const std::vector<fs::path> folders = run_virtual_study(directory.file("study"), kExamples / "classification.toml", 2, 9);
  EXPECT_EQ(folders, (std::vector<fs::path>{directory.file("study/V1"), directory.file("study/V2")}));
  const SavedSession one = read_session(folders[0]), two = read_session(folders[1]);
  EXPECT_EQ(one.participant, "V1");
  EXPECT_EQ(two.participant, "V2");
  EXPECT_NE(one.seed, two.seed);
  EXPECT_EQ(one.events.back().kind, EventKind::run_ended);
  EXPECT_GT(one.events.back().time, 504 * 8) << "s; a classification takes a stroke or two";
}

}  // namespace
}  // namespace forceshade::experiments
