// SPDX-License-Identifier: BSD-3-Clause
// The house's own rules: one law, one basename; two sides that never meet; nothing copyleft near the real-time path.

#include "tests/structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "device/kinds.h"
#include "forceshade/law.h"

namespace forceshade {
namespace {

using tests::kRoot;
using tests::modules;
using tests::text_of;
using tests::top_folders;

// The text between the <> or "" of every #include below the folder.
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

// A build with the preset dev thus compiles the header by itself; the others are for tests/headers_test.sh.
TEST(structure, each_source_file_includes_the_header_of_its_name_first) {
  int found = 0;
  for (const char* folder : {"fast", "files", "rendering", "subjects", "system", "device", "run", "report", "window",
                             "reference", "properties", "certificate", "apps", "clients"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::filesystem::path header = entry.path();
      if (!std::filesystem::exists(header.replace_extension(".h"))) continue;
      ++found;
      std::string line;
      for (std::ifstream file(entry.path()); std::getline(file, line) && !line.starts_with("#include");) continue;
      const std::filesystem::path from = std::string(folder) == "clients" ? kRoot / folder : kRoot;
      const std::string expected = "#include \"" + std::filesystem::relative(header, from).string() + '"';
      EXPECT_EQ(line, expected) << entry.path();
    }
  EXPECT_GT(found, 60);
}

// The folders at the top, without those of builds and of tools.
std::vector<std::filesystem::path> folders_at_the_top() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    if (entry.is_directory() && !name.starts_with('.') && !name.starts_with("build")) found.push_back(entry.path());
  }
  return found;
}

// The compiler holds the table of modules; that it holds it everywhere takes a library of each, which is in the table.
TEST(structure, every_kind_of_device_has_a_row_in_the_table_of_what_works_with_it) {
  const std::string page = text_of(kRoot / "docs/device.md");
  const std::size_t begin = page.find("## What works with which device");
  ASSERT_NE(begin, std::string::npos);
  const std::string table = page.substr(begin, page.find("\n## ", begin) - begin);
  for (const device::Kind& kind : device::kinds())
    EXPECT_NE(table.find("\n| `" + std::string(kind.name) + "` |"), std::string::npos) << kind.name;
}

TEST(structure, every_folder_with_a_library_is_a_module) {
  const std::vector<std::string> known = modules();
  int found = 0;
  for (const std::filesystem::path& top : folders_at_the_top())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(top)) {
      const std::string folder = std::filesystem::relative(entry.path().parent_path(), kRoot);
      if (entry.path().filename() != "CMakeLists.txt" || folder.starts_with("tests")) continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("forceshade_library(")) continue;
        ++found;
        EXPECT_TRUE(std::ranges::find(known, folder) != known.end()) << folder << " is not in cmake/modules.txt";
      }
    }
  EXPECT_GT(found, 10);
}

TEST(structure, every_module_is_in_the_picture_that_scripts_modules_draws) {
  const std::string picture = text_of(kRoot / "docs/modules.svg");
  for (const std::string& module : modules()) {
    if (module == "apps" || module.starts_with("tests")) continue;  // they may include everything
    EXPECT_NE(picture.find("<title>" + module + "</title>"), std::string::npos) << module << ": run scripts/modules";
  }
}

// The lines of cmake/public_headers.txt: header and module.
std::map<std::string, std::string> public_headers() {
  std::map<std::string, std::string> found;
  std::ifstream file(kRoot / "cmake/public_headers.txt");
  for (std::string line; std::getline(file, line);)
    if (const std::size_t colon = line.find(": "); !line.starts_with('#') && colon != std::string::npos)
      found[line.substr(0, colon)] = line.substr(colon + 2);
  EXPECT_GE(found.size(), 12U);
  return found;
}

std::vector<std::string> includes_of_file(const std::filesystem::path& path) {
  std::vector<std::string> found;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("#include ")) found.push_back(line.substr(9));
  return found;
}

TEST(structure, the_public_headers_are_the_files_of_their_folder) {
  std::set<std::string> files, listed;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "include"))
    if (!entry.is_directory()) files.insert(std::filesystem::relative(entry.path(), kRoot / "include"));
  const std::vector<std::string> known = modules();
  for (const auto& [header, module] : public_headers()) {
    listed.insert("forceshade/" + header);
    EXPECT_TRUE(std::ranges::find(known, module) != known.end()) << header << ": " << module;
  }
  listed.insert({"forceshade.h", "forceshade_reference.h"});  // of the C interfaces
  EXPECT_EQ(files, listed);
}

// An installed program thus needs no other header, and no library but Eigen to compile.
TEST(structure, public_headers_include_only_one_another_eigen_and_the_standard_library) {
  const std::regex is_standard("<[a-z_]+>");
  for (const auto& [header, module] : public_headers())
    for (const std::string& include : includes_of_file(kRoot / "include/forceshade" / header)) {
      if (include == "<Eigen/Core>" || std::regex_match(include, is_standard)) continue;
      ASSERT_TRUE(include.starts_with("\"forceshade/")) << header << " includes " << include;
      EXPECT_TRUE(public_headers().contains(include.substr(12, include.size() - 13))) << header << " includes " << include;
    }
}

TEST(structure, each_public_header_begins_with_an_example_and_says_what_is_not_promised) {
  for (const auto& [header, module] : public_headers()) {
    const std::string text = text_of(kRoot / "include/forceshade" / header), begin = text.substr(0, text.find("\n\n"));
    EXPECT_NE(begin.find("\n//\n//   "), std::string::npos) << header;
    EXPECT_NE(begin.find("\n// Not promised: "), std::string::npos) << header;
  }
}

// The component of the package that each library comes with; a library that none names is always there.
std::map<std::string, std::string> components() {
  std::map<std::string, std::string> found;
  const std::string text = text_of(kRoot / "cmake/install.cmake");
  const std::regex line(R"(set\(libraries_of_(\w+) ([^)]+)\))");
  for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at) {
    std::istringstream libraries(at->str(2));
    for (std::string library; libraries >> library;) found[library] = at->str(1);
  }
  EXPECT_GT(found.size(), 8U);
  return found;
}

TEST(structure, the_page_of_the_public_headers_says_what_each_includes_and_needs) {
  const std::string page = text_of(kRoot / "docs/public-headers.md");
  const std::map<std::string, std::string> component_of = components();
  for (const auto& [header, module] : public_headers()) {
    std::string includes;
    const auto add = [&](const std::string& word) { includes += (includes.empty() ? "" : ", ") + word; };
    bool has_eigen = false;
    for (const std::string& include : includes_of_file(kRoot / "include/forceshade" / header))
      if (include.starts_with('"'))
        add('`' + include.substr(12, include.size() - 13) + '`');
      else
        has_eigen = has_eigen || include == "<Eigen/Core>";
    if (has_eigen) add("Eigen");
    const std::size_t row = page.find("\n| `" + header + "` | ");
    ASSERT_NE(row, std::string::npos) << header;
    const std::string line = page.substr(row + 1, page.find('\n', row + 1) - row - 1);
    EXPECT_NE(line.find(" | " + (includes.empty() ? "—" : includes) + " | "), std::string::npos)
        << line << "\nexpected " << includes;
    const std::string begin = " | `forceshade::";
    const std::size_t at = line.find(begin);
    if (at == std::string::npos) {
      EXPECT_TRUE(module == "text" || module == "rendering") << line;
      EXPECT_TRUE(line.ends_with(" | none | always there |")) << line;
      continue;
    }
    const std::string library = line.substr(at + begin.size(), line.find('`', at + begin.size()) - at - begin.size());
    const auto component = component_of.find(library);
    EXPECT_TRUE(line.ends_with(component == component_of.end() ? " | always there |" : " | `" + component->second + "` |"))
        << line;
    EXPECT_NE(text_of(kRoot / module / "CMakeLists.txt").find("forceshade_" + library), std::string::npos) << line;
  }
}

// The text after // or # in a line, or the whole line of a page.
std::string prose_of(const std::string& line, const std::filesystem::path& file) {
  const std::string extension = file.extension();
  if (extension == ".md") return line;
  const bool is_cpp = extension == ".h" || extension == ".cpp" || extension == ".inl" || extension == ".inc";
  const std::size_t begin = line.find(is_cpp ? "//" : "# ");
  return begin == std::string::npos ? "" : line.substr(begin + 1 + (is_cpp ? 1 : 0));
}

// A comment that names a file which was moved sends its reader to nothing.
TEST(structure, every_file_that_a_comment_or_page_names_exists) {
  const std::map<std::string, std::string> exceptions{
      {"mutant.cpp", "each mutant is generated under this name"},
      {"mutated.py", "tests of the command write it"},
      {"stdio.h", "of the standard"},
      {"math.h", "of the standard"},
      {"ball.py", "a page has its reader write it"},
      {"mine.py", "a page has its reader write it"},
      {"test_mine.py", "a page has its reader write it"},
      {"_avx2.cpp", "the end of a pattern"},
      {"_avx512.cpp", "the end of a pattern"},
      {"_test.cpp", "the end of a pattern"},
  };
  std::vector<std::string> folders{"cmake", "docs", "scripts"};
  for (const std::string& folder : top_folders()) folders.push_back(folder);
  std::vector<std::filesystem::path> files{kRoot / "README.md", kRoot / "CONTRIBUTING.md", kRoot / "SECURITY.md"};
  for (const std::string& folder : folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::set<std::string> names{"CHANGELOG.md"};  // it tells of files that are no more, and is not read itself
  for (const std::filesystem::path& file : files) names.insert(file.filename());
  const std::set<std::string> read{".h", ".cpp", ".inl", ".inc", ".sh", ".py", ".cmake", ".txt", ".g", ".md"};
  const std::regex word("[A-Za-z0-9_./-]+\\.(h|cpp|inl|inc|g|md|sh|py|cases)\\b");
  int found = 0;
  for (const std::filesystem::path& file : files) {
    const std::string extension = file.extension();
    if (!read.contains(extension) || (extension == ".txt" && file.filename() != "CMakeLists.txt")) continue;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      const std::string prose = prose_of(line, file);
      for (std::sregex_iterator at(prose.begin(), prose.end(), word), end; at != end; ++at) {
        const std::string name = at->str();
        if (exceptions.contains(name)) continue;
        ++found;
        const bool has_folder = name.find('/') != std::string::npos;
        EXPECT_TRUE(has_folder ? std::filesystem::exists(kRoot / name) || std::filesystem::exists(kRoot / "fast" / name) ||
                                     std::filesystem::exists(kRoot / "include" / name) ||
                                     std::filesystem::exists(kRoot / "clients" / name) ||
                                     std::filesystem::exists(file.parent_path() / name)
                               : names.contains(name))
            << std::filesystem::relative(file, kRoot) << " names " << name;
      }
    }
  }
  EXPECT_GT(found, 500);
}

// Tables, and the programs that compute the golden files by themselves.
bool may_be_long(const std::string& file) {
  // A program in C includes one header, which grows by each function of the library.
  return file == "include/forceshade.h" || file.starts_with("tests/golden/") || file.ends_with(".txt") ||
         file.ends_with(".cases");
}

TEST(structure, no_file_of_code_has_more_than_400_lines) {
  int found = 0;
  for (const std::string& folder : top_folders())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string file = std::filesystem::relative(entry.path(), kRoot), extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inl" && extension != ".inc" && extension != ".sh" &&
          extension != ".py" && extension != ".cmake")
        continue;
      ++found;
      const std::string text = text_of(entry.path());
      if (!may_be_long(file)) {
        EXPECT_LE(std::ranges::count(text, '\n'), 400) << file;
      }
    }
  EXPECT_GT(found, 700);
}

// "Of a face that climbs." and "What is left." send their reader to the code to find the noun.
TEST(structure, a_comment_begins_with_a_noun_or_a_verb) {
  const std::vector<std::string> openers{"What", "Where", "Whether", "How", "Who", "Which", "When", "Why", "Of"};
  for (const std::string& folder : top_folders())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension();
      const bool is_cpp = extension == ".h" || extension == ".cpp" || extension == ".inl",
                 is_script = extension == ".py" || extension == ".sh" || extension == ".cmake" || extension == ".g" ||
                             folder == "scripts" || entry.path().filename() == "CMakeLists.txt";
      if (!is_cpp && !is_script) continue;
      const std::string mark = is_cpp ? "//" : "#";
      std::ifstream file(entry.path());
      bool is_within = false;  // a comment of several lines
      for (std::string line; std::getline(file, line);) {
        const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
        const bool is_comment = line.compare(begin, mark.size(), mark) == 0;
        if (is_comment && !is_within) {
          for (const std::string& word : openers)
            EXPECT_FALSE(line.substr(begin).starts_with(mark + " " + word + " ")) << entry.path() << ": " << line;
        }
        is_within = is_comment;
      }
    }
}

// number_7_ is part of the name of the test of row 7, or of a comment above its line of a shell test.
TEST(structure, each_row_of_the_planted_defects_has_a_test_of_its_number) {
  std::string tests;
  for (const char* file : {"tests/conformance/planted_defects_test.cpp", "tests/conformance/planted_simulator_defects_test.cpp",
                           "tests/apps/conform_command_test.sh"})
    tests += text_of(kRoot / file);
  const std::string page = text_of(kRoot / "tests/conformance/planted_defects.md");
  const std::regex row("\n\\| (\\d+) \\|");
  int rows = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), row), end; it != end; ++it, ++rows)
    EXPECT_NE(tests.find("number_" + (*it)[1].str() + '_'), std::string::npos) << "row " << (*it)[1];
  EXPECT_EQ(rows, 30);
}

// Test programs, and scripts that are given the command alone.
TEST(structure, each_test_that_finds_mutants_has_a_name_of_its_own) {
  for (std::set<std::string> names; const auto& file : std::filesystem::recursive_directory_iterator(kRoot / "tests")) {
    const std::string end = file.path().extension(), name = file.path().stem();
    const bool is_run = end == ".cpp" || (end == ".sh" && text_of(file).find(".sh FORCESHADE:") != std::string::npos);
    EXPECT_TRUE(!is_run || !name.ends_with("_test") || names.insert(name).second) << name;
  }
}

TEST(structure, the_real_time_side_uses_no_library_of_the_exact_one) {
  for (const char* folder : {"fast", "device", "rendering/heights"}) expect_no_include(folder, {"CGAL", "mpfr", "gmp"});
  for (const char* folder : {"fast", "rendering/heights"}) expect_no_include(folder, {"boost"});
}

TEST(structure, devices_take_only_the_sockets_of_boost) {
  for (const std::string& include : includes_of(kRoot / "device"))
    EXPECT_TRUE(!include.starts_with("boost") || include.starts_with("boost/asio/") || include.starts_with("boost/beast/"))
        << include;
}

TEST(structure, the_recorder_takes_only_the_ring_of_boost) {
  expect_no_include("run/recorder", {"CGAL"});
  for (const std::string& include : includes_of(kRoot / "run/recorder"))
    EXPECT_TRUE(!include.starts_with("boost") || include == "boost/lockfree/spsc_queue.hpp") << include;
}

TEST(structure, no_gpl_part_of_cgal_is_used) {
  for (const char* folder : {"reference", "rendering", "subjects", "report", "run", "properties", "certificate", "window",
                             "apps", "clients", "tests"})
    expect_no_include(folder, {"CGAL/AABB", "CGAL/Polygon_mesh_processing", "CGAL/Surface_mesh", "CGAL/box_intersection_d"});
}

}  // namespace
}  // namespace forceshade
