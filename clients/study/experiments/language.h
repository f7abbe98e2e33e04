// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The texts for the participant in one language, from a TOML file.

#include <filesystem>
#include <string>
#include <vector>

#include "study/experiments/participant.h"

namespace forceshade::experiments {

struct Heading {
  std::string title, text;
};

// Texts may hold {smaller}, {bigger}, {done}, {enter} and {erase}, the names of keys; those of a block {block} and {blocks},
// those of a break {trial} and {trials}.
struct Language {
  std::string name;                  // in the language itself: English, Deutsch
  Heading matching, classification;  // the instructions before the first trial
  Heading practice;
  Heading block_with_vision, block_without_vision, classification_block;
  Heading pause, resumed, end;
  Heading match, satisfy, classify;  // short, shown during the trial
  Heading question;                  // shown with each question; its text comes before the question's own
  std::vector<std::string> questions_after_matching, questions_after_classification;
  Labels labels;
  std::vector<std::string> pictures;  // names of the four of figure 5-8: plane, two polygons, three polygons, cylinder
};

// Throws Error with file, line and key: every text has to be there, and hold no other names in braces.
Language read_language(const std::filesystem::path& file);

}  // namespace forceshade::experiments
