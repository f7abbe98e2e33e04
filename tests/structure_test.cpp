// SPDX-License-Identifier: BSD-3-Clause
// The house's own rules: one law, one basename; two sides that never meet; nothing copyleft near the real-time path.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"

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

// So that a build with the preset dev compiles the header by itself; the others are for tests/headers_test.sh.
TEST(structure, each_source_file_includes_the_header_of_its_name_first) {
  int found = 0;
  for (const char* folder :
       {"fast", "files", "rendering", "device", "recorder", "reference", "properties", "certificate", "study", "apps"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::filesystem::path header = entry.path();
      if (!std::filesystem::exists(header.replace_extension(".h"))) continue;
      ++found;
      std::ifstream file(entry.path());
      std::string line;
      while (std::getline(file, line) && !line.starts_with("#include")) continue;
      const std::string expected = "#include \"" + std::filesystem::relative(header, kRoot).string() + '"';
      EXPECT_EQ(line, expected) << entry.path();
    }
  EXPECT_GT(found, 60);
}

// A claim that no change of its code has ever broken is not known to be tested: lines of tests/mutants/mutants.txt.
TEST(structure, every_file_that_evaluates_height_maps_has_its_mutants) {
  std::map<std::string, int> mutants;  // by file without its extension: a header may have its code in a source file
  std::ifstream list(kRoot / "tests/mutants/mutants.txt");
  for (std::string line; std::getline(list, line);) {
    const std::size_t slash = line.find('/'), to = line.find(" | ", slash), from = line.rfind(" | ", slash);
    if (line.starts_with('#') || slash == std::string::npos || to == std::string::npos) continue;
    const std::filesystem::path file = from == std::string::npos ? line.substr(0, to) : line.substr(from + 3, to - from - 3);
    ++mutants[file.parent_path() / file.stem()];
  }
  int found = 0;
  for (const char* folder : {"fast", "reference"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension(), name = entry.path().stem();
      const bool is_of_height_maps = entry.path().parent_path().filename() == "heights" || name.starts_with("height_") ||
                                     name == "fraction" || name == "root_field" || name == "exponential_sum";
      // They list kinds, or bound them for properties, and evaluate nothing.
      const bool is_a_list = name == "all" || name == "shape" || name == "outline";
      if ((extension != ".h" && extension != ".cpp") || !is_of_height_maps || is_a_list) continue;
      ++found;
      const std::filesystem::path file = std::filesystem::relative(entry.path(), kRoot);
      EXPECT_GE(mutants[file.parent_path() / name], 2) << file;
    }
  EXPECT_GT(found, 40);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The modules of cmake/modules.txt.
std::vector<std::string> modules() {
  std::vector<std::string> found;
  std::ifstream file(kRoot / "cmake/modules.txt");
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with('#')) found.push_back(line.substr(0, line.find(':')));
  EXPECT_GT(found.size(), 10U);
  return found;
}

// The folders at the top in which modules and their public headers lie.
std::set<std::string> top_folders() {
  std::set<std::string> folders{"include"};
  for (const std::string& module : modules()) folders.insert(module.substr(0, module.find('/')));
  return folders;
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
    if (!entry.is_directory()) files.insert(std::filesystem::relative(entry.path(), kRoot / "include/forceshade"));
  const std::vector<std::string> known = modules();
  for (const auto& [header, module] : public_headers()) {
    listed.insert(header);
    EXPECT_TRUE(std::ranges::find(known, module) != known.end()) << header << ": " << module;
  }
  EXPECT_EQ(files, listed);
}

// So that an installed program needs no other header, and no library but Eigen to compile.
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
      EXPECT_EQ(module, "rendering") << line;
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

TEST(structure, at_most_sixteen_folders_lie_at_the_top) {
  EXPECT_LE(folders_at_the_top().size(), 16U);
}

// A law or a kind of height map under the names that a file can have for it.
struct Named {
  std::string file, name, words, type;  // bump_2p, bump-2p, bump 2p, Bump2p

  // ending: of the file, words and type beside the name: vertex_scheme of the name vertex.
  explicit Named(std::string_view of, std::string_view ending = "") : name(of) {
    file = words = name + std::string(ending);
    std::ranges::replace(file, '-', '_');
    std::ranges::replace(words, '-', ' ');
    bool is_first = true;
    for (const char c : name + std::string(ending)) {
      if (c != '-') type += is_first ? static_cast<char>(std::toupper(c)) : c;
      is_first = c == '-';
    }
  }
};

// A sort of thing that is added now and then, and the table of CONTRIBUTING.md that says where.
struct Sort {
  const char* heading;
  const char* pattern;
  const char* id;  // before the file's name, in code
  std::size_t most_places;
  std::vector<Named> all;
  std::map<std::string, std::string> exceptions;  // files that name most of them, and why none has to be added there
};

std::vector<Sort> sorts() {
  Sort laws{"## Adding a law", "<law>", "LawId::", 12, {}, {}},
      kinds{"## Adding a kind of height map", "<kind>", "LawId::", 8, {}, {}},
      schemes{"## Adding a shading scheme", "<scheme>", "Shading::", 10, {}, {}},
      rules{"## Adding a contact rule", "<rule>", "Contact::", 10, {}, {}};
  for (const LawName& law : kLaws) laws.all.emplace_back(law.name);
  for (const std::string_view kind : height::kKindNames) kinds.all.emplace_back(kind);
  for (const std::string_view scheme : mesh::kShadingNames)
    if (scheme != mesh::name_of(mesh::Shading::none)) schemes.all.emplace_back(scheme, "-scheme");
  for (const std::string_view rule : mesh::kContactNames) rules.all.emplace_back(rule);
  const std::string chosen = "it tests chosen laws and numbers, while loops over kLaws test every law",
                    figures = "the thesis's own figures", stimuli = "the stimuli of the thesis's two experiments";
  laws.exceptions = {
      {"study/analysis/thesis.cpp", stimuli},
      {"certificate/report/figures.cpp", figures},
      {"certificate/report/thesis_figures.cpp", figures},
      {"tests/analysis/psychometric_test.cpp", stimuli},
      {"tests/analysis/simulated.h", stimuli},
      {"tests/analysis/thesis_numbers_test.cpp", stimuli},
      {"tests/certificate/comparison_test.cpp", chosen},
      {"tests/certificate/refusal_test.cpp", chosen},
      {"tests/certificate/sweep_test.cpp", chosen},
      {"tests/experiments/virtual_fit.cpp", stimuli},
      {"tests/fast/separation_test.cpp", "the separations of docs/proofs.md, law by law; it fails for a law without one"},
      {"tests/hard_cases/search.cpp", "extra places to aim at; it searches every law"},
      {"tests/laws/errata_test.cpp", "the thesis's errata"},
      {"tests/properties/properties_test.cpp", chosen},
      {"tests/properties/witness_test.cpp", chosen},
      {"tests/properties/work_test.cpp", chosen},
      {"tests/reference/energy_test.cpp", "energies known in closed form"},
      {"tests/report/report_test.cpp", chosen},
  };
  const std::string maps = "it tests chosen maps, while height_kinds.h and any_height_map() bring every kind";
  kinds.exceptions = {
      {"tests/certificate/height_certificate_test.cpp", maps},
      {"tests/fast/height_bounds_test.cpp", "the kinds that reach farthest; a loop compares every kind with them"},
      {"tests/height_maps/height_exact_test.cpp", maps},
      {"tests/height_maps/height_map_field_test.cpp", maps},
      {"tests/height_maps/height_scenes.h", "sums of chosen kinds beside a scene of every kind"},
      {"tests/heights/height_spec_test.cpp", "texts of TOML files; every kind is read by the same lines"},
      {"tests/properties/height_properties_test.cpp", maps},
      {"tests/reference/height_energy_test.cpp", maps},
      {"tests/reference/height_reference_test.cpp", maps},
      {"tests/reference/profile_test.cpp", maps},
      {"tests/report/side_view_test.cpp", maps},
  };
  const std::string some = "it tests what the schemes that it names have; mesh_subject_test.cpp runs every scheme",
                    paths = "the schemes of the stored paths";
  schemes.exceptions = {
      {"tests/bench/mesh_bench.cpp", "the schemes that are timed"},
      {"properties/mesh_subject.cpp", "what only one scheme has: a turn that is bounded, a texture to draw"},
      {"tests/fast/same_bits_meshes.h", "the schemes of the stored hashes"},
      {"tests/meshes/god_object_consequences_test.cpp", some},
      {"tests/meshes/god_object_golden_test.cpp", paths},
      {"tests/meshes/god_object_test.cpp", some},
      {"tests/meshes/mesh_contract_test.cpp", some},
      {"tests/meshes/texture_golden_test.cpp", paths},
      {"tests/meshes/texture_scheme_test.cpp", some},
  };
  return {laws, kinds, schemes, rules};
}

// As a word of its own: bump-1p is no part of bump-1p-shaded.
bool has_word(const std::string& text, const std::string& word) {
  const auto is_in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_in_word(text[at - 1])) && (end == text.size() || !is_in_word(text[end]))) return true;
  }
  return false;
}

// The numbered places of a table.
std::vector<std::string> places_of(const Sort& sort) {
  std::ifstream file(kRoot / "CONTRIBUTING.md");
  std::vector<std::string> places;
  bool is_below = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) is_below = line == sort.heading;
    if (!is_below || !line.starts_with("| ") || std::isdigit(static_cast<unsigned char>(line[2])) == 0) continue;
    const std::string begin = "| " + std::to_string(places.size() + 1) + " | `";
    EXPECT_TRUE(line.starts_with(begin)) << line;
    const std::size_t end = line.find("` |", begin.size());
    if (end == std::string::npos) {
      ADD_FAILURE() << "expected one place in a row, got " << line;
      continue;
    }
    places.push_back(line.substr(begin.size(), end - begin.size()));
  }
  return places;
}

// The files that a place stands for: one, or one of each.
std::vector<std::string> files_of(const std::string& place, const Sort& sort) {
  const std::size_t at = place.find(sort.pattern);
  if (at == std::string::npos) return {place};
  std::vector<std::string> files;
  for (const Named& one : sort.all) files.push_back(std::string(place).replace(at, std::string(sort.pattern).size(), one.file));
  return files;
}

TEST(structure, the_tables_of_contributing_name_as_few_places_as_they_may) {
  for (const Sort& sort : sorts()) {
    const std::vector<std::string> places = places_of(sort);
    EXPECT_GE(places.size(), sort.most_places / 2) << sort.heading;
    EXPECT_LE(places.size(), sort.most_places) << sort.heading;
    EXPECT_EQ(std::set(places.begin(), places.end()).size(), places.size()) << sort.heading;
  }
}

TEST(structure, everything_is_in_every_place_of_its_table) {
  for (const Sort& sort : sorts())
    for (const std::string& place : places_of(sort)) {
      const std::vector<std::string> files = files_of(place, sort);
      for (const std::string& file : files) EXPECT_TRUE(std::filesystem::is_regular_file(kRoot / file)) << file;
      if (files.front() != place) continue;
      const std::string text = text_of(kRoot / place);
      for (const Named& one : sort.all)
        EXPECT_TRUE(has_word(text, one.file) || has_word(text, one.name) || has_word(text, one.words) ||
                    has_word(text, one.type))
            << place << " lacks " << one.name;
    }
}

// By its type, its id, its name as a text or its header; comments left out.
bool is_in_code(const std::string& code, const Named& one, const std::string& sort_id) {
  return has_word(code, one.type) || has_word(code, sort_id + one.file) ||
         code.find('"' + one.name + '"') != std::string::npos || code.find('/' + one.file + ".h\"") != std::string::npos;
}

std::string without_comments(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string code;
  for (std::string line; std::getline(in, line);) code += line.substr(0, line.find("//")) + '\n';
  return code;
}

// What names more than half of the laws or kinds is a list, a switch or a set of overloads, which one more would have to be
// added to.
TEST(structure, no_file_beside_the_tables_has_to_be_extended) {
  for (const Sort& sort : sorts()) {
    std::set<std::string> places;
    for (const std::string& place : places_of(sort))
      for (const std::string& file : files_of(place, sort)) places.insert(file);
    std::map<std::string, std::string> unused = sort.exceptions;
    int found = 0;
    const auto look_at = [&](const std::filesystem::path& path) {
      const std::string extension = path.extension(), file = std::filesystem::relative(path, kRoot);
      if (extension != ".h" && extension != ".cpp" && extension != ".inl" && extension != ".inc") return;
      ++found;
      const std::string code = without_comments(path);
      const auto named = static_cast<std::size_t>(
          std::ranges::count_if(sort.all, [&](const Named& one) { return is_in_code(code, one, sort.id); }));
      if (2 * named <= sort.all.size() || places.contains(file)) return;
      if (unused.erase(file) == 0)
        ADD_FAILURE() << file << " names " << named << " of " << sort.all.size() << ", and is not in " << sort.heading;
    };
    for (const std::string& folder : top_folders())
      for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) look_at(entry.path());
    EXPECT_GT(found, 400);
    for (const auto& [file, reason] : unused) ADD_FAILURE() << file << " is no exception any more: " << reason;
  }
}

// What follows // or # in a line, or the whole line of a page.
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
      {"_avx2.cpp", "the end of a pattern"},
      {"_avx512.cpp", "the end of a pattern"},
      {"_test.cpp", "the end of a pattern"},
  };
  std::vector<std::string> folders{"cmake", "docs", "scripts"};
  for (const std::string& folder : top_folders()) folders.push_back(folder);
  std::vector<std::filesystem::path> files{kRoot / "README.md", kRoot / "CONTRIBUTING.md"};
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
                                     std::filesystem::exists(file.parent_path() / name)
                               : names.contains(name))
            << std::filesystem::relative(file, kRoot) << " names " << name;
      }
    }
  }
  EXPECT_GT(found, 500);
}

TEST(structure, the_real_time_side_uses_no_library_of_the_exact_one) {
  for (const char* folder : {"fast", "device", "rendering/heights"})
    expect_no_include(folder, {"CGAL", "boost", "mpfr", "gmp"});
}

TEST(structure, the_recorder_takes_only_the_ring_of_boost) {
  expect_no_include("recorder", {"CGAL"});
  for (const std::string& include : includes_of(kRoot / "recorder"))
    EXPECT_TRUE(!include.starts_with("boost") || include == "boost/lockfree/spsc_queue.hpp") << include;
}

TEST(structure, no_gpl_part_of_cgal_is_used) {
  for (const char* folder : {"reference", "rendering", "properties", "certificate", "study", "apps", "tests"})
    expect_no_include(folder, {"CGAL/AABB", "CGAL/Polygon_mesh_processing", "CGAL/Surface_mesh", "CGAL/box_intersection_d"});
}

}  // namespace
}  // namespace forceshade
