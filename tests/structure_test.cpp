// SPDX-License-Identifier: BSD-3-Clause
// The house's own rules: one law, one basename; two sides that never meet; nothing copyleft near the real-time path.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "forceshade/vocabulary/law.h"

namespace forceshade {
namespace {

const std::filesystem::path kRoot = FORCESHADE_SOURCE_DIR;

// What stands between the <> or "" of every #include below the folder.
std::vector<std::string> includes_of(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp" && extension != ".inl") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::size_t open = line.find_first_of("<\"");
      if (!line.starts_with("#include") || open == std::string::npos) continue;
      found.push_back(line.substr(open + 1, line.find_first_of(">\"", open + 1) - open - 1));
    }
  }
  EXPECT_FALSE(found.empty()) << folder;
  return found;
}

void expect_no_include(const char* folder, const std::vector<std::string>& forbidden) {
  for (const std::string& include : includes_of(kRoot / folder))
    for (const std::string& prefix : forbidden) EXPECT_FALSE(include.starts_with(prefix)) << folder << " includes " << include;
}

TEST(structure, every_law_has_its_file_in_every_folder) {
  for (const LawName& law : kLaws)
    for (const char* pattern : {"reference/%.h", "fast/%.h", "fast/%.g", "tests/%_test.cpp", "tests/%.cases"}) {
      std::string path = pattern;
      path.replace(path.find('%'), 1, law.file);
      EXPECT_TRUE(std::filesystem::exists(kRoot / path)) << path;
    }
}

// So that every build compiles the header by itself; the others are for tests/headers_test.sh.
TEST(structure, each_source_file_includes_the_header_of_its_name_first) {
  int found = 0;
  for (const char* folder : {"fast", "csv", "heights", "device", "recorder", "reference", "properties", "apps"})
    for (const auto& entry : std::filesystem::directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::filesystem::path header = entry.path();
      if (!std::filesystem::exists(header.replace_extension(".h"))) continue;
      ++found;
      std::ifstream file(entry.path());
      std::string line;
      while (std::getline(file, line) && !line.starts_with("#include")) continue;
      std::string expected = "#include \"forceshade/";
      expected.append(folder).append("/").append(header.filename().string()).append("\"");
      EXPECT_EQ(line, expected) << entry.path();
    }
  EXPECT_GT(found, 60);
}

// A claim that no change of its code has ever broken is not known to be tested: lines of tests/mutants/mutants.txt.
TEST(structure, every_file_that_evaluates_height_maps_has_its_mutants) {
  std::map<std::string, int> mutants;  // by file without its extension: a header may have its code in a source file
  std::ifstream list(kRoot / "tests/mutants/mutants.txt");
  for (std::string line; std::getline(list, line);) {
    const std::size_t from = line.find(" | "), to = line.find(" | ", from + 1);
    if (to == std::string::npos) continue;
    const std::filesystem::path file = line.substr(from + 3, to - from - 3);
    ++mutants[file.parent_path() / file.stem()];
  }
  int found = 0;
  for (const char* folder : {"fast", "reference"})
    for (const auto& entry : std::filesystem::directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension(), name = entry.path().stem();
      const bool is_of_height_maps = name.starts_with("height_") || name.starts_with("spline_") || name == "fraction" ||
                                     name == "root_field" || name == "exponential_sum";
      if ((extension != ".h" && extension != ".cpp") || !is_of_height_maps) continue;
      ++found;
      EXPECT_GE(mutants[std::filesystem::path(folder) / name], 2) << folder << '/' << name;
    }
  EXPECT_GT(found, 40);
}

TEST(structure, the_two_sides_never_meet) {
  expect_no_include("fast",
                    {"forceshade/reference/", "forceshade/properties/", "forceshade/device/", "CGAL", "boost", "mpfr", "gmp"});
  expect_no_include("reference", {"forceshade/fast/", "forceshade/properties/", "forceshade/device/"});
  expect_no_include("vocabulary", {"forceshade/"});
}

TEST(structure, the_device_side_knows_only_the_real_time_path) {
  expect_no_include("device", {"forceshade/reference/", "forceshade/properties/", "CGAL", "boost"});
}

TEST(structure, height_files_know_neither_side) {
  expect_no_include("heights", {"forceshade/fast/", "forceshade/reference/", "forceshade/properties/"});
}

TEST(structure, the_recorder_takes_only_the_ring_of_boost) {
  expect_no_include("recorder", {"forceshade/reference/", "forceshade/properties/", "CGAL"});
  for (const std::string& include : includes_of(kRoot / "recorder"))
    EXPECT_TRUE(!include.starts_with("boost") || include == "boost/lockfree/spsc_queue.hpp") << include;
}

TEST(structure, no_gpl_part_of_cgal_is_used) {
  for (const char* folder : {"reference", "properties", "apps", "tests", "bench"})
    expect_no_include(folder, {"CGAL/AABB", "CGAL/Polygon_mesh_processing", "CGAL/Surface_mesh"});
}

}  // namespace
}  // namespace forceshade
