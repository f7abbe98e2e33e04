// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/subjects/materials.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "files/printable.h"
#include "files/quantity.h"
#include "files/suggestion.h"
#include "rendering/heights/toml_file.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::subjects {
namespace {

constexpr std::size_t kLargestMaterials = 4 << 20;

// The binary32 number nearest to the text.
float coefficient_of(const std::string& name, std::string_view word, const std::string& text) {
  word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
  float number = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc{} || rest != end || !is_friction(number))
    throw BadInput(name +
                   ": expected one coefficient of friction, or a static and a dynamic one, each 0, inf or from 2^-10 to " +
                   "1024, got \"" + text + '"');
  return number + 0.0F;  // -0 is 0
}

class Reader {
 public:
  Reader(std::string file, const mesh::LoadedMesh& loaded) : file_(std::move(file)), loaded_(loaded) {}

  mesh::Materials read() {
    auto parsed = heights::parse_toml_file(file_, kLargestMaterials);
    if (const auto* fault = std::get_if<heights::TomlFault>(&parsed))
      throw BadInput(file_ + ": " + (fault->line == 0 ? "" : "line " + std::to_string(fault->line) + ": ") + fault->reason);
    const auto& root = std::get<toml::table>(parsed);
    if (root.empty()) throw BadInput(file_ + ": expected [default] or a [[material]], got neither");
    expect_keys(root, {"default", "material"});
    made_.list.push_back({});
    names_.emplace_back("default");
    made_.of_triangle.assign(loaded_.mesh.triangles.size(), 0);
    if (const toml::node* usual = root.get("default")) {
      const toml::table& table = table_of("default", *usual);
      expect_keys(table, {"stiffness", "friction"});
      made_.list.front() = material(table);
    }
    if (const toml::node* list = root.get("material")) {
      if (!list->is_array_of_tables()) fail(*list, "material", "[[material]]", *list);
      for (const toml::node& one : *list->as_array()) add(*one.as_table());
    }
    return std::move(made_);
  }

 private:
  std::string name_of(const toml::node& at, std::string_view key) const {
    return file_ + ": line " + std::to_string(at.source().begin.line) + ": " + std::string(key);
  }
  [[noreturn]] void fail(const toml::node& at, std::string_view key, const std::string& expected, const toml::node& got) const {
    throw BadInput(name_of(at, key) + ": expected " + expected + ", got " + heights::words_of_value(got));
  }
  const toml::table& table_of(std::string_view key, const toml::node& node) const {
    if (!node.is_table()) fail(node, key, "a table", node);
    return *node.as_table();
  }
  void expect_keys(const toml::table& table, const std::vector<std::string>& keys) const {
    for (const auto& [key, node] : table)
      if (std::ranges::find(keys, key.str()) == keys.end())
        throw BadInput(name_of(node, "unknown key ") + std::string(key.str()) + files::suggestion(key.str(), keys));
  }

  mesh::Material material(const toml::table& table) const {
    mesh::Material made;
    const auto words = [&](const char* key, const toml::node& node, const char* expected) {
      const std::string text = heights::words_of_scalars(node);
      if (text.empty()) fail(node, key, expected, node);
      return text;
    };
    if (const toml::node* node = table.get("friction"))
      made = parse_friction(name_of(*node, "friction"), words("friction", *node, "a coefficient, or [static, dynamic]"));
    if (const toml::node* node = table.get("stiffness")) {
      const std::string name = name_of(*node, "stiffness");
      made.stiffness = files::parse_stiffness(name, words("stiffness", *node, "a stiffness such as \"0.5N/mm\""));
      if (const auto error = error_of_stiffness(*made.stiffness))
        throw BadInput(name + error->message().substr(std::string_view(error->parameter).size()));
    }
    return made;
  }

  void add(const toml::table& table) {
    expect_keys(table, {"name", "stiffness", "friction", "groups", "faces"});
    const toml::node* const named = table.get("name");
    const std::string name = named == nullptr ? "" : named->value_exact<std::string>().value_or("");
    if (named == nullptr) throw BadInput(name_of(table, "[[material]]") + ": expected a name, got none");
    if (name.empty()) fail(*named, "name", "a text in quotes", *named);
    if (std::ranges::find(names_, name) != names_.end())
      throw BadInput(name_of(*named, "name") + ": expected another name for each material, got \"" + name + "\" again");
    names_.push_back(name);
    made_.list.push_back(material(table));
    std::size_t given = 0;
    for (const char* key : {"groups", "faces"})
      if (const toml::node* node = table.get(key)) {
        if (!node->is_array()) fail(*node, key, "a list", *node);
        for (const toml::node& one : *node->as_array()) {
          std::string_view(key) == "groups" ? add_group(one) : add_faces(one);
          ++given;
        }
      }
    if (given == 0) throw BadInput(name_of(table, name) + ": expected groups or faces that have the material, got none");
  }

  void add_group(const toml::node& node) {
    const auto name = node.value_exact<std::string>();
    if (!name) fail(node, "groups", "names in quotes", node);
    bool is_there = false;
    std::vector<std::string> known;
    for (const mesh::FaceNames* names : {&loaded_.materials, &loaded_.groups}) {
      known.insert(known.end(), names->names.begin(), names->names.end());
      const auto found = std::ranges::find(names->names, *name);
      if (found == names->names.end()) continue;
      is_there = true;
      const auto place = static_cast<std::uint32_t>(found - names->names.begin());
      for (std::uint32_t i = 0; i < names->of_triangle.size(); ++i)
        if (names->of_triangle[i] == place) assign(i, node, "groups");
    }
    if (!is_there)
      throw BadInput(name_of(node, "groups") + ": expected a group or material of the mesh's file" + listed(known) +
                     ", got \"" + *name + '"' + files::suggestion(*name, known));
  }

  static std::string listed(const std::vector<std::string>& known) {
    constexpr std::size_t kListed = 20;
    if (known.empty()) return ", which names none";
    std::string list;
    for (std::size_t i = 0; i < known.size() && i < kListed; ++i) list += (i == 0 ? " (" : ", ") + files::printable(known[i]);
    return list + (known.size() > kListed ? ", ...)" : ")");
  }

  // "7" or "0-99", or the number 7.
  void add_faces(const toml::node& node) {
    const std::string text = node.is_array() ? "" : heights::words_of_scalars(node);
    const char* const end = text.data() + text.size();
    std::uint32_t first = 0, last = 0;
    auto [at, error] = std::from_chars(text.data(), end, first);
    last = first;
    if (error == std::errc{} && at != end && *at == '-') {
      const auto second = std::from_chars(at + 1, end, last);
      at = second.ptr;
      error = second.ec;
    }
    if (error != std::errc{} || at != end || first > last || last >= made_.of_triangle.size())
      fail(node, "faces",
           "a face such as \"7\" or faces such as \"0-99\", from 0 to " + std::to_string(made_.of_triangle.size() - 1), node);
    for (std::uint32_t i = first; i <= last; ++i) assign(i, node, "faces");
  }

  void assign(std::uint32_t triangle, const toml::node& at, std::string_view key) {
    std::uint32_t& its = made_.of_triangle[triangle];
    const auto material = static_cast<std::uint32_t>(made_.list.size() - 1);
    if (its != 0 && its != material)
      throw BadInput(name_of(at, key) + ": expected each face in one material, got face " + std::to_string(triangle) +
                     " in \"" + names_[its] + "\" and \"" + names_[material] + '"');
    its = material;
  }

  std::string file_;
  const mesh::LoadedMesh& loaded_;
  mesh::Materials made_;
  std::vector<std::string> names_;  // of the materials in the list
};

}  // namespace

mesh::Material parse_friction(const std::string& name, const std::string& text) {
  const std::vector<std::string> words = files::at_commas(text);
  mesh::Material made;
  made.static_friction = coefficient_of(name, words.front(), text);
  made.dynamic_friction = coefficient_of(name, words.size() == 2 ? words.back() : words.front(), text);
  if (words.size() > 2) coefficient_of(name, "", text);
  if (made.dynamic_friction > made.static_friction)
    throw BadInput(name + ": expected a dynamic coefficient of at most the static one, which comes first, got \"" + text + '"');
  return made;
}

mesh::Materials read_materials(const Options& options, const mesh::LoadedMesh& loaded) {
  mesh::Materials made;
  if (options.has("friction")) made.list = {parse_friction(options.name("friction"), options.value("friction"))};
  if (options.has("materials")) made = Reader(options.value("materials"), loaded).read();
  const bool is_usual = std::ranges::all_of(made.list, [](const mesh::Material& one) { return one == mesh::Material{}; });
  if (is_usual) return {};
  if (made.list.size() == 1) made.of_triangle.clear();
  return made;
}

}  // namespace forceshade::subjects
