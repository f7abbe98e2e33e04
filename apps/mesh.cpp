// SPDX-License-Identifier: BSD-3-Clause
// forceshade mesh: whether a file holds a mesh or scene that can be rendered, what is in it, and the repair of a mesh.

#include "subjects/mesh.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/command.h"
#include "apps/irregular_mesh.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/standard_input.h"
#include "apps/troubleshooting.h"
#include "files/csv.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "forceshade/meshes.h"
#include "properties/worst_tick.h"
#include "rendering/meshes/save.h"
#include "subjects/scene.h"
#include "text/joined.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;

struct MeshFileOptions {
  std::string file, unit, out, json, length;  // of cracks that are looked for or joined; empty: none

  // Throws Error.
  std::optional<float> length_named(const char* name) const {
    if (length.empty()) return std::nullopt;
    const float its = files::parse_length(name, length);
    if (its >= 0x1p-30F && its <= 10000) return its;
    throw Error(std::string(name) + ": expected a length of 2^-30 to 10000 mm, got \"" + length + '"');
  }
};

// A mesh, which is a ground without objects, or the ground of a scene.
struct Input {
  mesh::Ground ground;

  bool is_scene() const { return !ground.objects.empty(); }
  std::string words(const mesh::Findings& findings) const {
    return is_scene() ? ground.words(findings) : findings.words(ground.loaded.lines);
  }
};

Input read(const MeshFileOptions& options) {
  if (files::format_ending(options.file) != ".toml") {
    if (options.unit.empty()) throw CLI::RequiredError("--unit");
    return {{load_mesh(options.file, subjects::unit_named(options.unit)), {}}};
  }
  if (!options.unit.empty())
    throw Error("--unit: expected none beside a scene, whose objects have units of their own, got \"" + options.unit + '"');
  subjects::Scene scene = subjects::load_scene({{"scene", options.file}});
  if (scene.ground.objects.empty())
    throw Error(options.file + ": expected an object without a motion, whose mesh can be looked at, got none");
  return {std::move(scene.ground)};
}

Input load(const MeshFileOptions& options) {
  watch_for_interrupt();
  Input input = read(options);
  if (interrupted()) throw Interrupted("nothing was found out about " + options.file);
  return input;
}

// One for each finding.
std::vector<std::string> lines_of(const std::string& words) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end = 0; begin < words.size(); begin = end + 1) {
    end = words.find('\n', begin);
    lines.push_back(words.substr(begin, end - begin));
  }
  return lines;
}

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::printf("%s\n", files::printable(line).c_str());
}

// "FILE: line 12: face 3 has no area: ...", as in every message about a file.
void print_faults(const std::string& file, const std::vector<std::string>& faults) {
  std::string text;
  for (const std::string& fault : faults) text += files::printable(name_of_input(file) + ": " + fault) + '\n';
  std::fputs(with_page(text).c_str(), stdout);
}

void write_mesh(const std::string& path, const mesh::TriangleMesh& triangles) {
  files::OutputFile file(path);
  mesh::write_off(file.stream(), triangles);
  file.commit();
}

constexpr const char kFailedHeading[] = "FAILED: no regular mesh; faces and vertices are counted from 0";

// Notes a vertex that has so many triangles that a tick there may be late.
void note_large_fan(const Input& input, const mesh::TriangleMesh& triangles, std::vector<std::string>& notes) {
  const mesh::LargestFan fan = mesh::largest_fan(triangles);
  if (fan.triangles <= mesh::kLargestQuickFan) return;
  notes.push_back((input.is_scene() ? input.ground.words_of_vertex(fan.vertex) : "vertex " + std::to_string(fan.vertex)) +
                  " has " + std::to_string(fan.triangles) +
                  " faces: each move of a tick from there looks at all of them, which can take longer than 0.1 ms "
                  "(docs/speed.md, \"Vertices of many triangles\")");
}

// The file's notes, and what of it no command renders.
std::vector<std::string> notes_of(const mesh::LoadedMesh& loaded) {
  std::vector<std::string> notes = loaded.notes;
  if (!loaded.normals.empty())
    notes.emplace_back(
        "the normals in the file are not rendered: shading computes its own (docs/meshes.md, \"Corner normals\")");
  return notes;
}

// Names, each with the number of its faces.
using Counted = std::vector<std::pair<std::string, std::uint64_t>>;

// The number of faces of each name, in their order.
Counted faces_with_names(const mesh::FaceNames& names) {
  Counted counted;
  for (const std::string& name : names.names) counted.emplace_back(name, 0);
  for (const std::uint32_t place : names.of_triangle)
    if (place != mesh::FaceNames::kNone) ++counted[place].second;
  return counted;
}

// Those of the objects of a scene.
Counted faces_of_objects(const mesh::Ground& ground) {
  Counted counted;
  for (const mesh::GroundObject& object : ground.objects) counted.emplace_back(object.name, object.triangles);
  return counted;
}

// The names of faces by kind: "objects" of a scene alone, "materials", "groups".
std::vector<std::pair<std::string, Counted>> names_in(const Input& input) {
  std::vector<std::pair<std::string, Counted>> all;
  if (input.is_scene()) all.emplace_back("objects", faces_of_objects(input.ground));
  all.emplace_back("materials", faces_with_names(input.ground.loaded.materials));
  all.emplace_back("groups", faces_with_names(input.ground.loaded.groups));
  return all;
}

Json json_of(const Counted& counted) {
  Json json = Json::object();
  for (const auto& [name, faces] : counted) json[name] = faces;
  return json;
}

// "rubber (8 faces), steel (4 faces)", of many only the first.
std::string words_of(const Counted& counted) {
  constexpr std::size_t kListed = 20;
  const std::string words = joined(first_of(kListed, counted), ", ", [](const Counted::value_type& named) {
    return named.first + " (" + std::to_string(named.second) + " faces)";
  });
  return counted.empty() ? "none" : counted.size() > kListed ? words + ", ..." : words;
}

// As it is rendered where no option is given.
properties::WorstTick worst_tick(mesh::CheckedMesh& checked) {
  const mesh::Sides sides = mesh::usual_sides(checked);
  MeshRendering rendering{std::move(checked), {}, sides, mesh::Shading::none, 1};
  const properties::WorstTick worst = properties::worst_tick(rendering);
  checked = std::move(rendering.checked);
  return worst;
}

std::string shortest(double number) {
  return forceshade::shortest(static_cast<float>(number));
}

void add_facts(Json& json, const mesh::Facts& facts) {
  const auto list = [](const mesh::Vertex& v) { return Json{v[0], v[1], v[2]}; };
  json.update({{"faces", facts.triangles},
               {"vertices", facts.vertices},
               {"unused_vertices", facts.unused_vertices},
               {"edges", facts.edges},
               {"rim_edges", facts.rim_edges},
               {"parts", facts.parts},
               {"low_mm", list(facts.low)},
               {"high_mm", list(facts.high)},
               {"shortest_edge_mm", facts.shortest_edge},
               {"longest_edge_mm", facts.longest_edge},
               {"area_mm2", facts.area},
               {"volume_mm3", facts.volume}});
}

void print_row(const char* name, const std::string& value) {
  std::printf("%-16s %s\n", name, value.c_str());
}

void print_facts(const mesh::Facts& facts) {
  const auto point = [](const mesh::Vertex& v) { return shortest(v[0]) + ", " + shortest(v[1]) + ", " + shortest(v[2]); };
  print_row("faces",
            std::to_string(facts.triangles) + " in " + std::to_string(facts.parts) + (facts.parts == 1 ? " part" : " parts"));
  print_row("vertices", std::to_string(facts.vertices) + ", " + std::to_string(facts.unused_vertices) + " of them in no face");
  print_row("edges", std::to_string(facts.edges) + ", " + std::to_string(facts.rim_edges) + " of them at a rim");
  print_row("box", point(facts.low) + " to " + point(facts.high) + " mm");
  print_row("edge lengths", shortest(facts.shortest_edge) + " to " + shortest(facts.longest_edge) + " mm");
  print_row("area", shortest(facts.area) + " mm^2");
  if (facts.is_closed())
    print_row("volume",
              shortest(std::fabs(facts.volume)) + " mm^3; the fronts are " + (facts.volume > 0 ? "outside" : "inside"));
}

int check(const MeshFileOptions& options) {
  const float nearer_than = options.length_named("--cracks").value_or(0);
  Input input = load(options);
  std::vector<std::string> notes = notes_of(input.ground.loaded);
  const bool has_normals = !input.ground.loaded.normals.empty(), has_texture = !input.ground.loaded.texture.empty();
  const mesh::TriangleMesh& triangles = input.ground.loaded.mesh;
  auto checked = checked_with_progress(options.file, triangles);
  auto* held = std::get_if<mesh::CheckedMesh>(&checked);
  const std::vector<std::string> faults =
      held != nullptr ? std::vector<std::string>{} : lines_of(input.words(std::get<mesh::Findings>(checked)));
  Json json{{"file", options.file}, {"held", held != nullptr}, {"self_intersections", "refused"},
            {"faults", faults},     {"normals", has_normals},  {"texture", has_texture}};
  std::optional<properties::WorstTick> worst;
  std::optional<mesh::Facts> facts;
  std::vector<Row> rows;
  if (held != nullptr) {
    note_large_fan(input, held->mesh(), notes);
    worst = worst_tick(*held);
    facts = mesh::facts_of(*held);
    add_facts(json, *facts);
  } else if (auto any = mesh::check_any(triangles); auto* set = std::get_if<mesh::CheckedMesh>(&any)) {
    worst = worst_tick(*set);
    const mesh::Irregularities found = irregularities_with_progress(options.file, triangles);
    rows = rows_of(found);
    json["irregularities"] = apps::json_of(found);
    notes.emplace_back(
        "any set of triangles is rendered exactly (docs/soups.md): "
        "each face blocks, what coincides feels like one, and a gap is a gap");
  }
  if (held != nullptr || !rows.empty()) {
    const mesh::Borders borders = mesh::borders_of(triangles, nearer_than);
    for (Row& row : rows_of(borders, nearer_than)) rows.push_back(std::move(row));
    json["borders"] = apps::json_of(borders, nearer_than);
  }
  if (worst) json["worst_tick"] = {{"looks", worst->looks}, {"moves", worst->moves}, {"unfinished", worst->is_unfinished}};
  json["notes"] = notes;
  for (const auto& [name, counted] : names_in(input)) json[name] = json_of(counted);
  write_json(options.json, json);
  const int code = held != nullptr ? kHeld : kFailed;
  if (options.json == "-") return code;
  if (held != nullptr) print_facts(*facts);
  for (const auto& [name, words] : rows) print_row(name.c_str(), words);
  if (held != nullptr) {
    print_row("normals", has_normals ? "in the file" : "none");
    print_row("texture", has_texture ? "in the file" : "none");
    for (const auto& [name, counted] : names_in(input)) print_row(name.c_str(), files::printable(words_of(counted)));
  }
  print(notes);
  if (worst) print({properties::words_of(*worst)});
  if (held == nullptr) {
    std::printf("%s\n", kFailedHeading);
    print_faults(options.file, faults);
    return code;
  }
  std::printf("held: a %s of %zu faces\n", input.is_scene() ? "scene" : "mesh", held->mesh().triangles.size());
  return code;
}

int repair(const MeshFileOptions& options) {
  const std::optional<float> length = options.length_named("--join");
  Input input = load(options);
  if (input.is_scene()) throw Error(options.file + ": expected a mesh to repair, got a scene; repair the mesh of an object");
  mesh::LoadedMesh& loaded = input.ground.loaded;
  std::vector<std::string> done = loaded.notes;
  if (!loaded.normals.empty() || !loaded.texture.empty()) done.emplace_back("normals and texture are left out");
  if (!loaded.materials.names.empty() || !loaded.groups.names.empty())
    done.emplace_back("the names of materials and groups are left out");
  mesh::Repaired repaired = [&] {
    try {
      return mesh::repair(std::move(loaded.mesh), length);
    } catch (const std::invalid_argument& error) {
      throw Error("--join: " + std::string(error.what()));
    }
  }();
  done.insert(done.end(), repaired.done.begin(), repaired.done.end());
  write_mesh(options.out, repaired.mesh);
  const auto checked = checked_with_progress(options.out, std::move(repaired.mesh));
  const auto* findings = std::get_if<mesh::Findings>(&checked);
  const std::vector<std::string> faults = findings == nullptr ? std::vector<std::string>{} : lines_of(findings->words());
  Json moved = Json::array();
  for (const auto& [vertex, onto, distance] : repaired.moved)
    moved.push_back({{"from", vertex}, {"onto", onto}, {"distance_mm", distance}});
  Json split = Json::array();
  for (const auto& [face, vertex, distance] : repaired.split)
    split.push_back({{"face", face}, {"at", vertex}, {"distance_mm", distance}});
  write_json(options.json, {{"file", options.file},
                            {"out", options.out},
                            {"done", done},
                            {"moved", moved},
                            {"split", split},
                            {"held", findings == nullptr},
                            {"faults", faults}});
  if (options.json != "-" && options.out != "-") {
    print(repaired.done.empty() ? std::vector<std::string>{"nothing to repair"} : done);
    if (findings != nullptr) std::printf("%s, of the repaired file\n", kFailedHeading);
    print_faults(options.out, faults);
  }
  return findings == nullptr ? kHeld : kFailed;
}

}  // namespace

void add_mesh(CLI::App& app, int& result) {
  CLI::App* command = app.add_subcommand("mesh", "Check, repair and make triangle meshes");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, int (*run)(const MeshFileOptions&)) {
    const auto options = std::make_shared<MeshFileOptions>();
    CLI::App* verb = command->add_subcommand(name, help);
    verb->add_option("file", options->file,
                     "a mesh: FILE.obj, .off, .ply or .stl; - is standard input. check takes a scene, too: FILE.toml")
        ->type_name("FILE")
        ->required();
    add_word(*verb, "--unit", options->unit, "of the coordinates in a mesh's file, which no format says: required for a mesh",
             {mesh::kUnitNames.begin(), mesh::kUnitNames.end()});
    verb->callback([options, run, &result] { result = run(*options); });
    return std::pair(verb, options);
  };
  const auto [check_verb, check_options] = add("check",
                                               "Check that a mesh is regular: exit code 0 and its faces, edges, parts and "
                                               "size; or 1, what kind of mesh it is, and what is "
                                               "wrong, with the numbers of faces",
                                               check);
  add_length(*check_verb, "--cracks", check_options->length,
             "also name borders that are nearer to each other than this without touching, between which a hand can pass");
  add_json(*check_verb, check_options->json, "the same");
  const auto [repair_verb, repair_options] = add(
      "repair", "Join equal vertices, drop faces without area or twice there, turn faces over; lists what was done", repair);
  add_length(
      *repair_verb, "--join", repair_options->length,
      "also move each vertex of a border onto the nearest one within this length that stays, and split faces whose edges have "
      "one beside them; nothing else moves");
  add_output(*repair_verb, "--out", repair_options->out, "the repaired mesh, an OFF file in mm", {".off"})->required();
  add_json(*repair_verb, repair_options->json, "the repairs");
  add_mesh_make(*command, result);
}

}  // namespace forceshade::apps
