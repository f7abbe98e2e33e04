// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/printable.h"
#include "files/quantity.h"
#include "subjects/damping.h"
#include "subjects/materials.h"
#include "subjects/mesh.h"
#include "subjects/motion.h"
#include "subjects/read.h"
#include "subjects/tables.h"
#include "subjects/words.h"
#include "text/number_text.h"

namespace forceshade::subjects {
namespace {

constexpr std::size_t kLargestScene = 4 << 20;

// The keys of options that a scene's file may have.
std::vector<std::string> keys_of_options() {
  std::vector<std::string> keys;
  for (const Key& key : kKeys)
    if (key.is_of("scene")) keys.emplace_back(key.name);
  return keys;
}

// Adds the materials of an object with so many triangles. One that an object before has, too, is not listed again.
void add_materials(mesh::Materials& all, const mesh::Materials& its, std::size_t triangles) {
  const auto before = static_cast<std::ptrdiff_t>(all.list.size());
  std::vector<std::uint32_t> places;
  for (const mesh::Material& one : its.list.empty() ? std::vector<mesh::Material>(1) : its.list) {
    auto found = std::find(all.list.begin(), all.list.begin() + before, one);
    if (found == all.list.begin() + before) found = all.list.insert(all.list.end(), one);
    places.push_back(static_cast<std::uint32_t>(found - all.list.begin()));
  }
  for (std::size_t i = 0; i < triangles; ++i)
    all.of_triangle.push_back(places[its.of_triangle.empty() ? 0 : its.of_triangle[i]]);
}

class SceneReader {
 public:
  explicit SceneReader(const std::string& file) : in_(file, kLargestScene) {}

  // Those in the file, then those given, of which none may be in the file.
  Options options(const Options& given) const {
    std::vector<std::string> keys = keys_of_options();
    keys.insert(keys.end(), {"object", "rate", std::string(kDamping)});
    Options all;
    if (const toml::node* its = in_.root().get(kDamping))
      for (Option& one : options_of_damping(*its, in_.document(), in_.file())) all.add(std::move(one));
    for (const auto& [key, node] : in_.root())
      if (key.str() != "object" && key.str() != "rate" && key.str() != kDamping && !is_former(key.str(), node, in_.file()))
        all.add(option_of(std::string(key.str()), node, in_.document(), in_.file(), keys, "scene"));
    for (const Option& one : given) all.add(one);
    expect_consistent(all, Laws::one);
    if (is_texture(all.value("shading")))
      throw Error(all.name("shading") + ": expected vertex, edge or none for a scene, got \"" + all.value("shading") +
                  "\": the texture coordinates of several files have no common unit");
    return all;
  }

  Scene read(Options options) {
    scene_.options = std::move(options);
    scene_.rate = rate();
    for (const toml::table* one : in_.tables_of("object")) one->contains("motion") ? add_moving(*one) : add(*one);
    const bool has_ground = !scene_.ground.objects.empty();
    if (!has_ground && scene_.moving.empty()) throw Error(in_.file() + ": expected an [[object]], got none");
    if (scene_.moving.size() + (has_ground ? 1 : 0) > scene::kMostObjects)
      throw Error(in_.file() + ": expected at most " + std::to_string(scene::kMostObjects) +
                  " objects, those without a motion together being one");
    if (!has_ground)
      for (const std::string& key : keys_of_options())
        if (scene_.options.has(key)) fail_alone(scene_.options.name(key), "an object without a motion");
    if (const toml::node* rate = in_.root().get("rate"); rate != nullptr && scene_.moving.empty())
      fail_alone(in_.name_of(*rate, "rate"), "an object with a motion");
    scene_.materials = simplest(std::move(scene_.materials));
    return std::move(scene_);
  }

 private:
  void add(const toml::table& table) {
    if (const toml::node* map = table.get("height-map"))
      throw Error(in_.name_of(*map, "height-map") +
                  ": expected a mesh: a height map is a force above a plane and has no faces; 'forceshade mesh make "
                  "height-map' makes a mesh of it");
    in_.expect_keys(
        table, {"name", "mesh", "unit", "translation", "rotation", "friction", "stiffness", "damping", "drag", "materials"});
    const std::string name = name_of(table);
    const std::string file = in_.text_of(table, "mesh", name, "a mesh");
    const std::string unit_word = in_.text_of(table, "unit", name, "a unit, mm, cm, m or in");
    const mesh::Unit unit = unit_named(unit_word, in_.name_of(*table.get("unit"), "unit"));
    const scene::Pose placement = placement_of(table);
    mesh::LoadedMesh loaded = mesh::load_with_corners(beside(in_.file(), file), unit);
    const std::size_t triangles = loaded.mesh.triangles.size();
    add_materials(scene_.materials, materials_of(table, loaded), triangles);
    if (!scene_.ground.add(name, std::move(loaded), placement))
      throw Error(in_.name_of(*table.get("mesh"), "mesh") + ": expected fewer faces and vertices in all objects together");
  }

  // An object with a motion has the keys of a subject file.
  void add_moving(const toml::table& table) {
    std::vector<std::string> keys = names_of_keys();
    for (const std::string_view key : {std::string_view("scene"), kDamping}) std::erase(keys, key);
    UnreadObject made;
    made.name = name_of(table);
    bool repeats = false;
    for (const auto& [key, node] : table) {
      if (key.str() == "name" || key.str() == "motion" || is_former(key.str(), node, in_.file())) continue;
      if (key.str() != "repeats") {
        made.options.add(option_of(std::string(key.str()), node, in_.document(), in_.file(), keys, "subject"));
      } else if (const auto flag = node.value_exact<bool>()) {
        repeats = *flag;
      } else {
        in_.fail(node, "repeats", "true or false", node);
      }
    }
    if (!made.options.has_kind())
      throw Error(in_.name_of(table, made.name) + ": expected one of the keys law, height-map and mesh beside motion");
    made.motion = read_motion(beside(in_.file(), in_.text_of(table, "motion", made.name, "a file")),
                              static_cast<double>(scene_.rate), repeats);
    scene_.moving.push_back(std::move(made));
  }

  float rate() const {
    const toml::node* const node = in_.root().get("rate");
    if (node == nullptr) return Scene().rate;
    const double rate = node->value<double>().value_or(0);
    if (!(rate >= kLeastRate && rate <= kMostRate) || rate != std::floor(rate))
      in_.fail(*node, "rate", "a whole number of ticks per second from 100 to 10000", *node);
    return static_cast<float>(rate);
  }

  [[noreturn]] static void fail_alone(const std::string& name, const std::string& what) {
    throw Error(name + ": expected " + what + " in the scene, got none");
  }

  std::string name_of(const toml::table& table) const {
    const std::string name = in_.text_of(table, "name", "[[object]]", "a name");
    const auto fail = [&](const char* expected, const char* got) {
      throw Error(in_.name_of(*table.get("name"), "name") + ": expected " + expected + ", got \"" + name + '"' + got);
    };
    if (!files::is_printable(name)) fail("a name without control characters", "");
    if (name.find('/') != std::string::npos) fail("a name without /, which stands in front of the names of groups", "");
    if (std::ranges::find(scene_.ground.objects, name, &mesh::GroundObject::name) != scene_.ground.objects.end() ||
        std::ranges::find(scene_.moving, name, &UnreadObject::name) != scene_.moving.end())
      fail("another name for each object", " again");
    return name;
  }

  scene::Pose placement_of(const toml::table& table) const {
    scene::Pose placement;
    if (const toml::node* node = table.get("translation")) {
      const std::vector<std::string> words = list_of(*node, "translation", 3, "a list of three lengths, x, y and z");
      for (std::size_t i = 0; i < 3; ++i) {
        placement.translation[i] = files::parse_length(in_.name_of(*node, "translation"), words[i]);
        if (!mesh::is_of_translation(placement.translation[i]))
          throw Error(in_.name_of(*node, "translation") + ": expected lengths within 10000 mm, got \"" + words[i] + '"');
      }
    }
    if (const toml::node* node = table.get("rotation")) {
      const std::vector<std::string> words =
          list_of(*node, "rotation", 4, "a list of four numbers, the quaternion w, x, y and z");
      for (std::size_t i = 0; i < 4; ++i) placement.rotation[i] = component_of(*node, words[i]);
      if (std::ranges::all_of(placement.rotation, [](float component) { return component == 0; }))
        throw Error(in_.name_of(*node, "rotation") + ": expected a quaternion w, x, y, z that is not 0, got only zeros");
    }
    return placement;
  }

  std::vector<std::string> list_of(const toml::node& node, const char* key, std::size_t size, const char* expected) const {
    const toml::array* const list = node.as_array();
    if (list == nullptr || list->size() != size) in_.fail(node, key, expected, node);
    std::vector<std::string> words;
    for (const toml::node& each : *list) {
      words.push_back(each.is_array() ? "" : in_.document().words_of_scalars(each));
      if (words.back().empty()) in_.fail(each, key, expected, each);
    }
    return words;
  }

  // The binary32 number nearest to the text.
  float component_of(const toml::node& node, const std::string& word) const {
    const auto number = number_in<float>(word);
    if (number && mesh::is_of_rotation(*number)) return *number;
    throw Error(in_.name_of(node, "rotation") + ": expected four numbers w, x, y, z, each 0 or of 2^-30 to 2 in size, got \"" +
                word + '"');
  }

  mesh::Materials materials_of(const toml::table& table, const mesh::LoadedMesh& loaded) const {
    const toml::node* const node = table.get("materials");
    if (node == nullptr) return {{in_.material_of(table)}, {}};
    for (const char* other : {"friction", "stiffness", "damping", "drag"})
      if (const toml::node* its = table.get(other))
        throw Error(in_.name_of(*its, other) + ": expected without materials, got both");
    const std::string file = in_.text_of(table, "materials", "materials", "a file");
    return read_materials({{"materials", beside(in_.file(), file)}}, loaded);
  }

  Tables in_;
  Scene scene_;
};

}  // namespace

Scene load_scene(const Options& options) {
  SceneReader reader(options.value("scene"));
  Scene scene = reader.read(reader.options(options));
  contact_beside(scene.materials, scene.options);
  return scene;
}

Description read_scene(const Options& options, float stiffness, const Monitor& monitor) {
  SceneReader reader(options.value("scene"));
  Options all = reader.options(options);
  Scene scene = reader.read(all);
  const std::string name = std::filesystem::path(options.value("scene")).filename().string();
  const auto ground = [&] {
    const auto load = [&]() -> Unchecked {
      mesh::LoadedMesh loaded = std::move(scene.ground.loaded);
      const auto words = [ground = std::move(scene.ground)](const mesh::Findings& findings) { return ground.words(findings); };
      return {std::move(loaded), std::move(scene.materials), words};
    };
    return Description{name, rendered(all, stiffness, load, monitor), read_damping(all)};
  };
  if (scene.moving.empty()) return ground();
  DescribedScene described{{}, scene.rate, stiffness};
  if (!scene.ground.objects.empty()) described.objects.push_back({"ground", ground(), {}});
  for (UnreadObject& one : scene.moving) {
    if (!one.options.has("stiffness")) one.options.add({"stiffness", shortest(stiffness)});
    described.objects.push_back({one.name, read_one(one.options, monitor), std::move(one.motion)});
  }
  return {name, std::move(described), read_damping(all)};
}

std::vector<std::pair<std::string, std::string>> written_scene(const Options& options, bool with_folders) {
  const std::string file = options.value("scene");
  std::vector<std::pair<std::string, std::string>> entries{
      {"scene", with_folders ? file : std::filesystem::path(file).filename().string()}};
  for (const std::string& key : keys_of_options()) entries.emplace_back(key, options.value(key));
  return entries;
}

}  // namespace forceshade::subjects
