// SPDX-License-Identifier: BSD-3-Clause
// The lists of mutants, tests/mutants/mutants.txt and equivalent.txt, without a mutant made: that takes hours.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/structure.h"

namespace forceshade::tests {
namespace {

struct Row {
  std::string line;
  std::filesystem::path file;
  std::string original;  // \n in it is the end of a line
};

// Lines "file | original => changed", and those that begin with a law, "law | file | original => changed".
std::vector<Row> rows_of(const char* list) {
  std::vector<Row> rows;
  std::ifstream in(kRoot / "tests/mutants" / list);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with('#') || line.starts_with(' ')) continue;
    const std::size_t begin = line.find('/') < line.find(" | ") ? 0 : line.find(" | ") + 3;
    const std::size_t bar = line.find(" | ", begin), arrow = line.find(" =>", bar);
    if (bar == std::string::npos || arrow == std::string::npos) {
      ADD_FAILURE() << list << ": expected 'file | original => changed', got " << line;
      continue;
    }
    std::string original = line.substr(bar + 3, arrow - bar - 3);
    for (std::size_t at = 0; (at = original.find("\\n", at)) != std::string::npos;) original.replace(at, 2, "\n");
    rows.push_back({line, line.substr(begin, bar - begin), original});
  }
  return rows;
}

// The place is what a row is about: where the code has changed, the row tries nothing.
TEST(structure, every_row_of_the_lists_of_mutants_matches_one_place) {
  int found = 0;
  for (const char* list : {"mutants.txt", "equivalent.txt"})
    for (const Row& row : rows_of(list)) {
      ++found;
      const std::string text = text_of(kRoot / row.file);
      const std::size_t first = text.find(row.original);
      EXPECT_NE(first, std::string::npos) << list << ": nothing in " << row.file << " reads as in " << row.line;
      EXPECT_EQ(first, text.rfind(row.original)) << list << ": several places in " << row.file << " read as in " << row.line;
    }
  EXPECT_GT(found, 1000);
}

// A claim that no change of its code has ever broken is not known to be tested: rows of mutants.txt. Those of other folders
// than fast/ and reference/laws/ are generated.
TEST(structure, every_file_of_fast_that_evaluates_height_maps_has_its_mutants) {
  std::map<std::string, int> mutants;  // by file without its extension: a header may have its code in a source file
  for (const Row& row : rows_of("mutants.txt")) ++mutants[row.file.parent_path() / row.file.stem()];
  int found = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "fast")) {
    const std::string extension = entry.path().extension(), name = entry.path().stem();
    const bool is_of_height_maps = entry.path().parent_path().filename() == "heights" || name.starts_with("height_") ||
                                   name == "fraction" || name == "root_field";
    // They list kinds, or bound them for properties, and evaluate nothing.
    const bool is_a_list = name == "all" || name == "shape" || name == "outline";
    if ((extension != ".h" && extension != ".cpp") || !is_of_height_maps || is_a_list) continue;
    ++found;
    const std::filesystem::path file = std::filesystem::relative(entry.path(), kRoot);
    EXPECT_GE(mutants[file.parent_path() / name], 2) << file;
  }
  EXPECT_GT(found, 15);
}

}  // namespace
}  // namespace forceshade::tests
