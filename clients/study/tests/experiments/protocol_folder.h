// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A folder with the protocols of two very small experiments and their texts.

#include <filesystem>

#include "tests/support/temporary_directory.h"

namespace forceshade::tests {

// Three matching trials of one bump at one reference radius.
inline constexpr const char* kMatching = R"(experiment = "matching"
name = "Small"
language = "english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
spacing_mil = 2000
practice_trials = 0
trials_before_break = 0
resume = "trial"
block_order = "as-listed"
reference = { law = "bump-cylinder" }
stimuli = [{ law = "bump-1p-shaded" }]
vision = [true]
reference_radii_mil = [800]
large_initial_radius_mil = 1000
small_initial_radius_mil = 600
repetitions = 1
radius_step_mil = 200
least_radius_mil = 600
largest_radius_mil = 1000
bigger = "higher"
)";

// Two trials of one bump.
inline constexpr const char* kClassification = R"(experiment = "classification"
name = "Small"
language = "english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
practice_trials = 0
trials_before_break = 0
resume = "trial"
stimuli = [{ law = "bump-1p" }]
radii_mil = [600]
repetitions = 2
)";

struct ProtocolFolder : TemporaryDirectory {
  ProtocolFolder() {
    write("matching.toml", kMatching);
    write("classification.toml", kClassification);
    std::filesystem::copy_file(FORCESHADE_SOURCE_DIR "/clients/study/examples/english.toml", file("english.toml"));
  }
};

}  // namespace forceshade::tests
