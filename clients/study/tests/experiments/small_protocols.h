// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Protocols of sessions that are short, and one who presses through them.

#include <filesystem>
#include <string>

#include "files/input_file.h"
#include "study/experiments/session_folder.h"
#include "study/tests/experiments/patient.h"

namespace forceshade::experiments {

struct SmallMatching {
  std::string vision = "true, false";
  int practice_trials = 1, repetitions = 2;
};

// A block for each of vision: one reference radius, three initial radii and the repetitions, so two blocks of six trials.
inline std::string small_matching(const std::string& resume, const SmallMatching& its = {}) {
  return R"(experiment = "matching"
name = "m"
language = ")" FORCESHADE_SOURCE_DIR R"(/clients/study/examples/english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
spacing_mil = 1500
practice_trials = )" +
         std::to_string(its.practice_trials) + R"(
trials_before_break = 4
resume = ")" +
         resume + R"("
block_order = "as-listed"
reference = { law = "bump-cylinder" }
stimuli = [{ law = "bump-1p-shaded" }]
vision = [)" +
         its.vision + R"(]
reference_radii_mil = [1000]
large_initial_radius_mil = 1400
small_initial_radius_mil = 600
repetitions = )" +
         std::to_string(its.repetitions) + R"(
radius_step_mil = 100
least_radius_mil = 550
largest_radius_mil = 1450
bigger = "higher"
)";
}

inline const std::string kSmallClassification = R"(experiment = "classification"
name = "c"
language = ")" FORCESHADE_SOURCE_DIR R"(/clients/study/examples/german.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
resume = "trial"
stimuli = [{ law = "bump-1p" }, { law = "bump-cylinder" }]
radii_mil = [600, 1000]
repetitions = 2
)";

// The reason why the session in this folder cannot be read; empty where it can.
inline std::string words_of_reading(const std::filesystem::path& folder) {
  try {
    read_session(folder);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

// Presses until the session is over or `most` presses are done.
inline void go_on(Session& session, double& time, int most = 100'000) {
  int presses_of_trial = 0;
  for (int i = 0; i < most && !session.is_over(); ++i)
    session.press(next_press(session.screen(), presses_of_trial), time += 0.5);
}

}  // namespace forceshade::experiments
