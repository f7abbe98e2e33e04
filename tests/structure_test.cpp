// SPDX-License-Identifier: BSD-3-Clause
// The house's own rules: one law, one basename; two sides that never meet; nothing copyleft near the real-time path.

#include <gtest/gtest.h>

#include <algorithm>
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
    for (const char* pattern :
         {"reference/laws/%.h", "fast/laws/%.h", "fast/laws/%.g", "tests/laws/%_test.cpp", "tests/laws/%.cases"}) {
      std::string path = pattern;
      path.replace(path.find('%'), 1, law.file);
      EXPECT_TRUE(std::filesystem::exists(kRoot / path)) << path;
    }
}

// So that every build compiles the header by itself; the others are for tests/headers_test.sh.
TEST(structure, each_source_file_includes_the_header_of_its_name_first) {
  int found = 0;
  for (const char* folder : {"fast", "csv", "heights", "meshes", "device", "recorder", "reference", "identity", "properties",
                             "certificate", "report", "apps"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::filesystem::path header = entry.path();
      if (!std::filesystem::exists(header.replace_extension(".h"))) continue;
      ++found;
      std::ifstream file(entry.path());
      std::string line;
      while (std::getline(file, line) && !line.starts_with("#include")) continue;
      const std::string expected = "#include \"forceshade/" + std::filesystem::relative(header, kRoot).string() + '"';
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
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension(), name = entry.path().stem();
      const bool is_of_height_maps = entry.path().parent_path().filename() == "heights" || name.starts_with("height_") ||
                                     name == "fraction" || name == "root_field" || name == "exponential_sum";
      if ((extension != ".h" && extension != ".cpp") || !is_of_height_maps) continue;
      ++found;
      const std::filesystem::path file = std::filesystem::relative(entry.path(), kRoot);
      EXPECT_GE(mutants[file.parent_path() / name], 2) << file;
    }
  EXPECT_GT(found, 40);
}

// The arrows of the diagram in CONTRIBUTING.md: what each module may include besides itself.
const std::map<std::string, std::vector<std::string>> kMayInclude{
    {"vocabulary", {}},
    {"csv", {}},
    {"identity", {"vocabulary"}},
    {"reference", {"vocabulary"}},
    {"fast", {"vocabulary"}},
    {"heights", {"vocabulary"}},
    {"meshes", {"vocabulary"}},
    {"properties", {"vocabulary", "identity", "reference", "fast"}},
    {"certificate", {"vocabulary", "identity", "reference", "fast", "properties"}},
    {"report", {"vocabulary", "identity", "reference", "fast", "properties", "certificate"}},
    {"device", {"vocabulary", "fast", "csv"}},
    {"recorder", {"vocabulary", "fast", "csv", "device"}},
    {"apps",
     {"vocabulary", "identity", "reference", "fast", "heights", "meshes", "properties", "certificate", "report", "device",
      "recorder", "csv"}},
};

TEST(structure, each_module_includes_only_what_it_may) {
  for (const auto& [module, allowed] : kMayInclude)
    for (const std::string& include : includes_of(kRoot / module)) {
      if (!include.starts_with("forceshade/")) continue;
      const std::string other = include.substr(11, include.find('/', 11) - 11);
      EXPECT_TRUE(other == module || std::find(allowed.begin(), allowed.end(), other) != allowed.end())
          << module << " includes " << include;
    }
}

// Every include can be followed before anything is configured: include/<module> holds a link to the module.
TEST(structure, every_module_has_its_link_in_include) {
  for (const auto& entry : kMayInclude) {
    const std::filesystem::path link = kRoot / "include" / entry.first / "forceshade" / entry.first;
    ASSERT_TRUE(std::filesystem::is_symlink(link)) << link;
    EXPECT_TRUE(std::filesystem::equivalent(link, kRoot / entry.first)) << link;
  }
}

TEST(structure, the_real_time_side_uses_no_library_of_the_exact_one) {
  for (const char* folder : {"fast", "device", "heights"}) expect_no_include(folder, {"CGAL", "boost", "mpfr", "gmp"});
}

TEST(structure, the_recorder_takes_only_the_ring_of_boost) {
  expect_no_include("recorder", {"CGAL"});
  for (const std::string& include : includes_of(kRoot / "recorder"))
    EXPECT_TRUE(!include.starts_with("boost") || include == "boost/lockfree/spsc_queue.hpp") << include;
}

TEST(structure, no_gpl_part_of_cgal_is_used) {
  for (const char* folder : {"reference", "meshes", "properties", "certificate", "report", "apps", "tests", "bench"})
    expect_no_include(folder, {"CGAL/AABB", "CGAL/Polygon_mesh_processing", "CGAL/Surface_mesh", "CGAL/box_intersection_d"});
}

}  // namespace
}  // namespace forceshade
