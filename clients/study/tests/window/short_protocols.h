// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Protocols of a few trials, for sessions in a real window.

#include <filesystem>
#include <string>

#include "tests/support/temporary_directory.h"

namespace forceshade::window {

// One reference radius, with and without vision: six trials, as Table 5.1 has them. `language` is english or german.
inline std::string short_matching(const std::string& language, int practice_trials) {
  return R"(
experiment = "matching"
name = "Three trials with vision, three without"
width_mil = 1000
stiffness_N_per_mm = 0.5
spacing_mil = 1500
trials_before_break = 0
resume = "trial"
block_order = "as-listed"
reference = { law = "bump-cylinder" }
stimuli = [{ law = "bump-1p-shaded" }]
vision = [true, false]
reference_radii_mil = [1000]
large_initial_radius_mil = 1400
small_initial_radius_mil = 600
repetitions = 1
radius_step_mil = 20
least_radius_mil = 520
largest_radius_mil = 2000
bigger = "higher"
language = ")" +
         language + ".toml\"\npractice_trials = " + std::to_string(practice_trials) + "\n";
}

// Two bumps at two radii.
inline std::string short_classification(const std::string& language, int practice_trials, int trials_before_break) {
  return R"(
experiment = "classification"
name = "Four trials"
width_mil = 1000
stiffness_N_per_mm = 0.5
resume = "trial"
stimuli = [{ law = "bump-2p" }, { law = "bump-3p-shaded" }]
radii_mil = [600, 1000]
repetitions = 1
language = ")" +
         language + ".toml\"\npractice_trials = " + std::to_string(practice_trials) +
         "\ntrials_before_break = " + std::to_string(trials_before_break) + "\n";
}

// The file of a protocol, beside the texts that it may name.
inline std::string written_protocol(const tests::TemporaryDirectory& folder, const std::string& text) {
  const std::filesystem::path texts = std::filesystem::path(FORCESHADE_SOURCE_DIR) / "clients/study/examples";
  for (const char* file : {"english.toml", "german.toml"}) std::filesystem::copy_file(texts / file, folder.file(file));
  return folder.write("protocol.toml", text);
}

}  // namespace forceshade::window
