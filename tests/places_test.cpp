// SPDX-License-Identifier: BSD-3-Clause
// Checks the tables of CONTRIBUTING.md: where a law, a kind of height map, a shading scheme, a contact rule or a device is
// added, and that nothing beside these places has to be extended; and that no line is wider than a page.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "device/kinds.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "tests/structure.h"

namespace forceshade {
namespace {

using tests::kRoot;
using tests::text_of;
using tests::top_folders;

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
  Sort laws{"## Adding a law", "<law>", "LawId::", 15, {}, {}},
      kinds{"## Adding a kind of height map", "<kind>", "LawId::", 8, {}, {}},
      schemes{"## Adding a shading scheme", "<scheme>", "Shading::", 10, {}, {}},
      rules{"## Adding a contact rule", "<rule>", "Contact::", 11, {}, {}},
      devices{"## Adding a device", "<kind>", "LawId::", 2, {}, {}};
  for (const LawName& law : kLaws) laws.all.emplace_back(law.name);
  for (const std::string_view kind : height::kKindNames) kinds.all.emplace_back(kind);
  for (const std::string_view scheme : mesh::kShadingNames)
    if (scheme != mesh::name_of(mesh::Shading::none)) schemes.all.emplace_back(scheme, "-scheme");
  for (const std::string_view rule : mesh::kContactNames) rules.all.emplace_back(rule);
  for (const device::Kind& kind : device::kinds()) devices.all.emplace_back(kind.name);
  const std::string chosen = "it tests chosen laws and numbers, while loops over kLaws test every law",
                    figures = "the thesis's own figures", stimuli = "the stimuli of the thesis's two experiments";
  const std::string in_words = "the C header names them for its readers; no code of the interface does";
  const std::string in_browsers = "a client: a browser offers the laws that it names, and its tests hold that these are all";
  laws.exceptions = {
      {"include/forceshade.h", in_words},
      {"clients/study/analysis/thesis.cpp", stimuli},
      {"clients/web/interface.js", in_browsers},
      {"clients/web/package/forceshade.d.ts", in_browsers},
      {"clients/web/page/bump.js", in_browsers},
      {"clients/study/tests/analysis/psychometric_test.cpp", stimuli},
      {"clients/study/tests/analysis/simulated.h", stimuli},
      {"clients/study/tests/analysis/thesis_numbers_test.cpp", stimuli},
      {"clients/study/tests/experiments/virtual_fit.cpp", stimuli},
      {"report/figures.cpp", figures},
      {"report/thesis_figures.cpp", figures},
      {"tests/certificate/refusal_test.cpp", chosen},
      {"tests/certificate/sweep_test.cpp", chosen},
      {"tests/fast/batch_doubt_test.cpp", "what each form leaves to later stages; a new form has a hazard of its own or none"},
      {"tests/fast/separation_test.cpp", "the separations of docs/proofs.md, law by law; it fails for a law without one"},
      {"tests/proofs/model/positions.py", "the laws that Coq has read"},
      {"tests/hard_cases/search.cpp", "extra places to aim at; it searches every law"},
      {"tests/properties/properties_test.cpp", chosen},
      {"tests/properties/witness_test.cpp", chosen},
      {"tests/properties/work_test.cpp", chosen},
      {"tests/reference/energy_test.cpp", "energies known in closed form"},
      {"tests/report/report_words_test.cpp", chosen},
  };
  const std::string maps = "it tests chosen maps, while height_kinds.h and any_height_map() bring every kind";
  kinds.exceptions = {
      {"tests/bindings/python/test_objects.py", maps},
      {"tests/certificate/height_certificate_test.cpp", maps},
      {"tests/fast/height_bounds_test.cpp", "the kinds that reach farthest; a loop compares every kind with them"},
      {"tests/height_maps/height_exact_test.cpp", maps},
      {"tests/height_maps/height_map_field_test.cpp", maps},
      {"tests/height_maps/height_scenes.h", "sums of chosen kinds beside a scene of every kind"},
      {"tests/heights/height_spec_test.cpp", "texts of TOML files; every kind is read by the same lines"},
      {"tests/properties/height_properties_test.cpp", maps},
      {"tests/reference/height_energy_test.cpp", maps},
      {"tests/reference/height_reference_test.cpp", maps},
      {"tests/report/side_view_test.cpp", maps},
  };
  const std::string some = "it tests what the schemes that it names have; mesh_subject_test.cpp runs every scheme";
  const std::string chosen_rules = "it tests chosen rules, while mesh_subject_test.cpp runs every rule";
  rules.exceptions = {
      {"include/forceshade.h", in_words},
      {"properties/mesh_properties.cpp", "what only one rule has: a goal beside the position, a drag beside the shading"},
      {"tests/bench/friction_bench.cpp", "the rules that are timed"},
      {"clients/web/package/forceshade.d.ts", "a client: the rules of JavaScript"},
      {"tests/bindings/c_materials_test.cpp", chosen_rules},
      {"tests/bindings/python/test_package.py", chosen_rules},
      {"tests/conformance/hello_test.cpp", chosen_rules},
      {"tests/meshes/god_object_golden_test.cpp", "the rules of the stored paths"},
      {"tests/meshes/friction_test.cpp", chosen_rules},
      {"tests/subjects/materials_test.cpp", chosen_rules},
      {"tests/subjects/scene_file_test.cpp", chosen_rules},
  };
  schemes.exceptions = {
      {"include/forceshade.h", in_words},
      {"tests/bench/mesh_bench.cpp", "the schemes that are timed"},
      {"bindings/python/forceshade/_subjects.py", "their words for readers; the type is any text, as texture:FILE needs"},
      {"clients/web/package/forceshade.d.ts", "a client: the schemes of JavaScript"},
      {"clients/web/page/page.js", "a client: the schemes of the page"},
      {"clients/web/tests/page_test.js", "a client: the schemes of the page"},
      {"properties/mesh_subject.cpp", "what only one scheme has: a turn that is bounded, a texture to draw"},
      {"tests/bindings/python/test_misuse.py", some},
      {"tests/bindings/python/test_soups.py", some},
      {"tests/fast/same_bits_meshes.h", "the schemes of the stored hashes"},
      {"tests/meshes/mesh_contract_test.cpp", some},
      {"tests/meshes/random_paths.h", "the places of a state, two of which are called as schemes are"},
      {"tests/meshes/texture_scheme_test.cpp", some},
      {"tests/subjects/scene_file_test.cpp", some},
  };
  return {laws, kinds, schemes, rules, devices};
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

// A file that names more than half of the laws or kinds is a list, a switch or a set of overloads, which one more would have to
// be added to.
TEST(structure, no_file_beside_the_tables_has_to_be_extended) {
  const std::set<std::string> code{".h", ".cpp", ".inl", ".inc", ".py", ".pyi", ".js", ".mjs", ".ts"};
  for (const Sort& sort : sorts()) {
    std::set<std::string> places;
    for (const std::string& place : places_of(sort))
      for (const std::string& file : files_of(place, sort)) places.insert(file);
    std::map<std::string, std::string> unused = sort.exceptions;
    int found = 0;
    const auto look_at = [&](const std::filesystem::path& path) {
      const std::string extension = path.extension(), file = std::filesystem::relative(path, kRoot);
      if (!code.contains(extension)) return;
      ++found;
      const std::string text = without_comments(path);
      const auto named = static_cast<std::size_t>(
          std::ranges::count_if(sort.all, [&](const Named& one) { return is_in_code(text, one, sort.id); }));
      // An exception stays one down to a third, so that it does not end with the next law.
      if (3 * named <= sort.all.size() || places.contains(file)) return;
      if (unused.erase(file) == 0 && 2 * named > sort.all.size())
        ADD_FAILURE() << file << " names " << named << " of " << sort.all.size() << ", and is not in " << sort.heading;
    };
    for (const std::string& folder : top_folders())
      for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) look_at(entry.path());
    EXPECT_GT(found, 400);
    for (const auto& [file, reason] : unused) ADD_FAILURE() << file << " is no exception any more: " << reason;
  }
}

// The output of a program, and tests of the command and of clients, where a line is one call with what is expected of it.
bool may_be_wide(const std::string& file) {
  const std::vector<std::string> begins{"proofs/recorded/Recorded.v", "clients/", "tests/apps/"};
  return std::ranges::any_of(begins, [&](const std::string& begin) { return file.starts_with(begin); });
}

TEST(structure, no_line_of_code_has_more_than_140_columns) {
  const std::set<std::string> kinds{".h", ".cpp", ".inl", ".c", ".g", ".v", ".pml", ".py", ".pyi", ".sh", ".js", ".mjs"};
  std::set<std::string> folders = top_folders();
  folders.insert({"scripts", "proofs"});
  int found = 0;
  for (const std::string& folder : folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string file = std::filesystem::relative(entry.path(), kRoot);
      if (!entry.is_regular_file() || may_be_wide(file) ||
          !(kinds.contains(entry.path().extension()) || (folder == "scripts" && !entry.path().has_extension())))
        continue;
      ++found;
      std::ifstream in(entry.path());
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; };  // a character of UTF-8
        EXPECT_LE(std::ranges::count_if(line, std::not_fn(continues)), 140) << file << ':' << number;
      }
    }
  EXPECT_GT(found, 1500);
}

}  // namespace
}  // namespace forceshade
