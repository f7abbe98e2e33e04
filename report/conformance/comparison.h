// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two conformance runs of one renderer or simulator side by side: what got worse, what got better.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/error.h"

namespace forceshade::conformance {

// changed: neither better nor worse, such as the time of an answer, which differs from run to run.
enum class Direction { worse, better, changed };

struct Change {
  Direction direction{};
  std::string what;           // "answers that are not correctly rounded, aimed at tie"
  std::string before, after;  // "3", "5"
  std::string details = {};   // the first violation of an invariant, in words
};

struct Comparison {
  std::string before, after;  // "a wall 1 (a.json)"
  std::string run;            // the common part of both: "law wall, seed 1, 20000 positions, tolerance: correctly rounded"
  std::vector<Change> changes;

  bool is_worse() const;
};

// Both texts are those of a conformance run's JSON. Their subject, seed, number of positions and tolerance, which runs of
// renderers have, are the same. before, after: what messages call the files. Throws Error, with the file, the key, the value
// and what was expected.
Comparison compare(std::string_view before_text, const std::string& before, std::string_view after_text,
                   const std::string& after);

// The same of files.
Comparison compare_files(const std::string& before, const std::string& after);

// Lines for a terminal, each ended, and a file's JSON.
std::string words_of(const Comparison& found);
nlohmann::ordered_json json_of(const Comparison& found);

}  // namespace forceshade::conformance
