// SPDX-License-Identifier: BSD-3-Clause
// The list of what a session rendered: what was written is read back, and anything else is refused.

#include "study/experiments/stimulus_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "files/csv.h"
#include "files/input_file.h"
#include "study/experiments/trial_log.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

std::vector<ListedStimulus> some_stimuli() {
  const ListedBump left{"bump-cylinder", 1000, {-19.05F, 0, 0}, R"({"law":"bump-cylinder"})", "c.json", "none"},
      right{"a \"name\"", 0, {19.05F, -0.1F, 3e-41F}, R"({"mesh":"a.off"})", "d.json", "00ff"};
  return {{1, 0, std::nullopt, std::nullopt}, {2, 0.1F, left, right}, {3, 0, right, std::nullopt}};
}

TEST(stimulus_list, reads_back_what_was_written_wherever_a_crash_cut_it_short) {
  const tests::TemporaryDirectory directory;
  const std::vector<ListedStimulus> all = some_stimuli();
  std::string text;
  std::vector<std::size_t> ends;
  for (const ListedStimulus& stimulus : all) ends.push_back((text += line_of(stimulus)).size());
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const auto whole = std::ranges::count_if(ends, [&](std::size_t end) { return end <= size; });
    EXPECT_EQ(read_stimuli(directory.write("s.jsonl", text.substr(0, size))),
              std::vector<ListedStimulus>(all.begin(), all.begin() + whole))
        << size;
  }
  EXPECT_THROW(read_stimuli(directory.file("no_such.jsonl")), Error);
}

TEST(stimulus_list, refuses_another_line_with_file_and_line) {
  const tests::TemporaryDirectory directory;
  const std::string first = line_of(some_stimuli()[0]), second = line_of(some_stimuli()[1]);
  const auto changed = [&](const std::string& what, const std::string& by) {
    std::string text = second;
    EXPECT_NE(text.find(what), std::string::npos) << what;
    return first + text.replace(text.find(what), what.size(), by);
  };
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {first + first, "number: expected 2"},
           {changed("\"number\":2", "\"number\":3"), "number: expected 2"},
           {changed("\"number\":2", "\"number\":-1"), "number: expected a whole number, 1 to 2147483647, got -1"},
           {changed("\"radius_mil\":1000", "\"radius_mil\":1e300"),
            "radius_mil: expected a whole number, 0 to 2147483647, got 1e+300"},
           {changed("\"radius_mil\":1000", "\"radius_mil\":-1"),
            "radius_mil: expected a whole number, 0 to 2147483647, got -1"},
           {changed("\"seam_mm\":0.1", "\"seam_mm\":1e39,\"x\":0.1"), "seam_mm: expected a number of millimetres"},
           {changed("[-19.0", "[1,-19.0"), "origin_mm: expected a list of three numbers"},
           {changed("[-19.0", "[null,-19.0"), "origin_mm: expected a list of three numbers"},
           {changed("\"c.json\"", "null"), "certificate: expected a text in quotes, got null"},
           {changed("\"left\"", "\"links\""), "the key left is missing"}}) {
    const std::string file = directory.write("s.jsonl", text);
    std::string words;
    try {
      read_stimuli(file);
    } catch (const Error& error) {
      words = error.what();
    }
    EXPECT_EQ(words, file + ":2: " + expected);
  }
}

}  // namespace
}  // namespace forceshade::experiments
