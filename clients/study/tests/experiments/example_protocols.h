// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The folder of the examples, and a small protocol of matching that is changed in one thing or another.

#include <filesystem>
#include <string>

namespace forceshade::experiments {

inline const std::filesystem::path kExamples = FORCESHADE_SOURCE_DIR "/clients/study/examples";

inline const std::string kMatching = R"(experiment = "matching"
name = "m"
language = "english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
spacing_mil = 1500
resume = "trial"
block_order = "as-listed"
reference = { law = "bump-cylinder" }
stimuli = [{ law = "bump-1p-shaded" }]
vision = [true]
reference_radii_mil = [600, 1400]
large_initial_radius_mil = 1400
small_initial_radius_mil = 600
repetitions = 1
radius_step_mil = 300
least_radius_mil = 520
largest_radius_mil = 2000
bigger = "higher"
)";

}  // namespace forceshade::experiments
