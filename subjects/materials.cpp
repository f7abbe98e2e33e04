// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/materials.h"

#include <algorithm>
#include <utility>

#include "files/printable.h"
#include "files/quantity.h"
#include "files/suggestion.h"
#include "rendering/mesh_rendering.h"
#include "subjects/tables.h"
#include "text/joined.h"
#include "text/number_text.h"

namespace forceshade::subjects {
namespace {

constexpr std::size_t kLargestMaterials = 4 << 20;

// The binary32 number nearest to the text.
float coefficient_of(const std::string& name, std::string_view word, const std::string& text) {
  word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
  const auto number = number_in<float>(word);
  if (!number || !is_friction(*number))
    throw Error(name + ": expected one coefficient of friction, or a static and a dynamic one, each 0, inf or from 2^-10 to " +
                "1024, got \"" + text + '"');
  return *number + 0.0F;  // -0 is 0
}

class Reader {
 public:
  Reader(const std::string& file, const mesh::LoadedMesh& loaded) : in_(file, kLargestMaterials), loaded_(loaded) {}

  mesh::Materials read() {
    const toml::table& root = in_.root();
    if (root.empty()) throw Error(in_.file() + ": expected [default] or a [[material]], got neither");
    in_.expect_keys(root, {"default", "material"});
    made_.list.push_back({});
    names_.emplace_back("default");
    made_.of_triangle.assign(loaded_.mesh.triangles.size(), 0);
    if (const toml::node* usual = root.get("default")) {
      const toml::table& table = in_.table_of("default", *usual);
      in_.expect_keys(table, {"stiffness", "friction", "damping", "drag"});
      made_.list.front() = in_.material_of(table);
    }
    for (const toml::table* one : in_.tables_of("material")) add(*one);
    return std::move(made_);
  }

 private:
  void add(const toml::table& table) {
    in_.expect_keys(table, {"name", "stiffness", "friction", "damping", "drag", "groups", "faces"});
    const std::string name = in_.text_of(table, "name", "[[material]]", "a name");
    if (std::ranges::find(names_, name) != names_.end())
      throw Error(in_.name_of(*table.get("name"), "name") + ": expected another name for each material, got \"" + name +
                  "\" again");
    names_.push_back(name);
    made_.list.push_back(in_.material_of(table));
    std::size_t given = 0;
    for (const char* key : {"groups", "faces"})
      if (const toml::node* node = table.get(key)) {
        if (!node->is_array()) in_.fail(*node, key, "a list", *node);
        for (const toml::node& one : *node->as_array()) {
          std::string_view(key) == "groups" ? add_group(one) : add_faces(one);
          ++given;
        }
      }
    if (given == 0) throw Error(in_.name_of(table, name) + ": expected groups or faces that have the material, got none");
  }

  void add_group(const toml::node& node) {
    const auto name = node.value_exact<std::string>();
    if (!name) in_.fail(node, "groups", "names in quotes", node);
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
      throw Error(in_.name_of(node, "groups") + ": expected a group or material of the mesh's file" + listed(known) +
                  ", got \"" + *name + '"' + files::suggestion(*name, known));
  }

  static std::string listed(const std::vector<std::string>& known) {
    constexpr std::size_t kListed = 20;
    if (known.empty()) return ", which names none";
    return " (" + joined(first_of(kListed, known), ", ", &files::printable) + (known.size() > kListed ? ", ...)" : ")");
  }

  // "7" or "0-99", or the number 7.
  void add_faces(const toml::node& node) {
    const std::string text = node.is_array() ? "" : in_.document().words_of_scalars(node);
    const std::size_t dash = text.find('-');
    const auto first = number_in<std::uint32_t>(text.substr(0, dash));
    const auto last = dash == text.npos ? first : number_in<std::uint32_t>(text.substr(dash + 1));
    if (!first || !last || *first > *last || *last >= made_.of_triangle.size())
      in_.fail(node, "faces",
               "a face such as \"7\" or faces such as \"0-99\", from 0 to " + std::to_string(made_.of_triangle.size() - 1),
               node);
    for (std::uint32_t i = *first; i <= *last; ++i) assign(i, node, "faces");
  }

  void assign(std::uint32_t triangle, const toml::node& at, std::string_view key) {
    std::uint32_t& its = made_.of_triangle[triangle];
    const auto material = static_cast<std::uint32_t>(made_.list.size() - 1);
    if (its != 0 && its != material)
      throw Error(in_.name_of(at, key) + ": expected each face in one material, got face " + std::to_string(triangle) +
                  " in \"" + names_[its] + "\" and \"" + names_[material] + '"');
    its = material;
  }

  Tables in_;
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
    throw Error(name + ": expected a dynamic coefficient of at most the static one, which comes first, got \"" + text + '"');
  return made;
}

mesh::Materials read_materials(const Options& options, const mesh::LoadedMesh& loaded) {
  mesh::Materials made;
  if (options.has("friction")) made.list = {parse_friction(options.name("friction"), options.value("friction"))};
  if (options.has("materials")) made = Reader(options.value("materials"), loaded).read();
  return simplest(std::move(made));
}

mesh::Materials simplest(mesh::Materials made) {
  const bool is_usual = std::ranges::all_of(made.list, [](const mesh::Material& one) { return one == mesh::Material{}; });
  if (is_usual) return {};
  if (made.list.size() == 1) made.of_triangle.clear();
  return made;
}

}  // namespace forceshade::subjects
