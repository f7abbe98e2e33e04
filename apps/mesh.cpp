// SPDX-License-Identifier: BSD-3-Clause
// forceshade mesh: whether a file holds a mesh that can be rendered, what is in it, its repair, and meshes of simple shapes.

#include "rendering/subjects/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/command.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "files/csv.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"
#include "rendering/meshes/save.h"
#include "rendering/subjects/height_map.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;

struct MeshFileOptions {
  std::string file, unit, out, json;
  bool self_intersecting = false;

  mesh::SelfIntersections self_intersections() const {
    return self_intersecting ? mesh::SelfIntersections::allowed : mesh::SelfIntersections::refused;
  }
};

mesh::LoadedMesh load(const MeshFileOptions& options) {
  watch_for_interrupt();
  mesh::LoadedMesh loaded = load_mesh(options.file, subjects::unit_named(options.unit));
  if (interrupted()) throw Interrupted("nothing was found out about " + options.file);
  return loaded;
}

// One for each finding. lines_of_faces: LoadedMesh::lines of the file that it is about.
std::vector<std::string> lines_of(const mesh::Findings& findings, const std::vector<std::uint64_t>& lines_of_faces) {
  std::vector<std::string> lines;
  const std::string words = findings.words(lines_of_faces);
  for (std::size_t begin = 0, end = 0; begin < words.size(); begin = end + 1) {
    end = words.find('\n', begin);
    lines.push_back(words.substr(begin, end - begin));
  }
  return lines;
}

void write_json(const MeshFileOptions& options, const Json& json) {
  if (!options.json.empty())
    write_file(options.json, json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void print(const std::vector<std::string>& lines, const std::string& before = "") {
  for (const std::string& line : lines) std::printf("%s\n", files::printable(before + line).c_str());
}

// "FILE: line 12: face 3 has no area: ...", as in every message about a file.
void print_faults(const std::string& file, const std::vector<std::string>& faults) {
  print(faults, (file == "-" ? "standard input" : file) + ": ");
}

void write_mesh(const std::string& path, const mesh::TriangleMesh& triangles) {
  files::OutputFile file(path);
  mesh::write_off(file.stream(), triangles);
  file.commit();
}

using TexturePoints = std::vector<std::array<mesh::TexturePoint, 3>>;

// A mesh that is made, with its texture if the file can hold one.
void write_made(const std::string& path, const mesh::TriangleMesh& triangles,
                TexturePoints (*texture)(const mesh::TriangleMesh&)) {
  if (files::format_ending(path) != ".obj") return write_mesh(path, triangles);
  files::OutputFile file(path);
  mesh::write_obj(file.stream(), triangles, texture(triangles));
  file.commit();
}

constexpr const char kFailedHeading[] = "FAILED: no mesh that can be rendered; faces and vertices are counted from 0";

// Where a vertex has so many triangles that a tick there may be late.
void note_large_fan(const mesh::TriangleMesh& triangles, std::vector<std::string>& notes) {
  const mesh::LargestFan fan = mesh::largest_fan(triangles);
  if (fan.triangles <= mesh::kLargestQuickFan) return;
  notes.push_back("vertex " + std::to_string(fan.vertex) + " has " + std::to_string(fan.triangles) +
                  " faces: a tick there can take longer than 0.1 ms, which it does not up to " +
                  std::to_string(mesh::kLargestQuickFan) + " faces (docs/meshes.md, \"Vertices of many triangles\")");
}

// The file's notes, and what of it no command renders.
std::vector<std::string> notes_of(const mesh::LoadedMesh& loaded) {
  std::vector<std::string> notes = loaded.notes;
  if (!loaded.normals.empty())
    notes.emplace_back(
        "the normals in the file are not rendered: shading computes its own (docs/meshes.md, \"Corner normals\")");
  return notes;
}

int check(const MeshFileOptions& options) {
  mesh::LoadedMesh loaded = load(options);
  std::vector<std::string> notes = notes_of(loaded);
  const auto checked = checked_with_progress(options.file, std::move(loaded.mesh), options.self_intersections());
  if (const auto* held = std::get_if<mesh::CheckedMesh>(&checked)) note_large_fan(held->mesh(), notes);
  const auto* findings = std::get_if<mesh::Findings>(&checked);
  const std::vector<std::string> faults = findings == nullptr ? std::vector<std::string>{} : lines_of(*findings, loaded.lines);
  write_json(options, {{"file", options.file},
                       {"held", findings == nullptr},
                       {"self_intersections", options.self_intersecting ? "allowed" : "refused"},
                       {"notes", notes},
                       {"faults", faults}});
  if (options.json == "-") return findings == nullptr ? kHeld : kFailed;
  print(notes);
  if (findings == nullptr) {
    const auto& held = std::get<mesh::CheckedMesh>(checked);
    std::printf("held: a mesh of %zu faces%s\n", held.mesh().triangles.size(),
                held.self_intersections() == mesh::SelfIntersections::refused
                    ? ""
                    : "; whether faces without a common vertex cross was not checked");
    return kHeld;
  }
  std::printf("%s\n", kFailedHeading);
  print_faults(options.file, faults);
  return kFailed;
}

// How many faces have each name, in their order.
std::vector<std::pair<std::string, std::uint64_t>> faces_with_names(const mesh::FaceNames& names) {
  std::vector<std::pair<std::string, std::uint64_t>> counted;
  for (const std::string& name : names.names) counted.emplace_back(name, 0);
  for (const std::uint32_t place : names.of_triangle)
    if (place != mesh::FaceNames::kNone) ++counted[place].second;
  return counted;
}

Json json_of(const mesh::FaceNames& names) {
  Json json = Json::object();
  for (const auto& [name, faces] : faces_with_names(names)) json[name] = faces;
  return json;
}

// "rubber (8 faces), steel (4 faces)", of many only the first.
std::string words_of(const mesh::FaceNames& names) {
  constexpr std::size_t kListed = 20;
  std::string words;
  const auto counted = faces_with_names(names);
  for (std::size_t i = 0; i < counted.size() && i < kListed; ++i)
    words += (i == 0 ? "" : ", ") + counted[i].first + " (" + std::to_string(counted[i].second) + " faces)";
  return counted.empty() ? "none" : counted.size() > kListed ? words + ", ..." : words;
}

std::string shortest(double number) {
  return files::shortest(static_cast<float>(number));
}

int info(const MeshFileOptions& options) {
  mesh::LoadedMesh loaded = load(options);
  const std::vector<std::string> notes = notes_of(loaded);
  const bool has_normals = !loaded.normals.empty(), has_texture = !loaded.texture.empty();
  const auto checked = mesh::check_joints(std::move(loaded.mesh));
  if (const auto* findings = std::get_if<mesh::Findings>(&checked)) {
    write_json(options, {{"file", options.file}, {"notes", notes}, {"faults", lines_of(*findings, loaded.lines)}});
    if (options.json == "-") return kFailed;
    print(notes);
    std::printf("%s\n", kFailedHeading);
    print_faults(options.file, lines_of(*findings, loaded.lines));
    return kFailed;
  }
  const mesh::Facts facts = mesh::facts_of(std::get<mesh::JoinedMesh>(checked));
  const auto list = [](const mesh::Vertex& v) { return Json{v[0], v[1], v[2]}; };
  write_json(options, {{"file", options.file},
                       {"faces", facts.triangles},
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
                       {"volume_mm3", facts.volume},
                       {"normals", has_normals},
                       {"texture", has_texture},
                       {"materials", json_of(loaded.materials)},
                       {"groups", json_of(loaded.groups)},
                       {"notes", notes}});
  if (options.json == "-") return kHeld;
  const auto row = [](const char* name, const std::string& value) { std::printf("%-16s %s\n", name, value.c_str()); };
  const auto point = [](const mesh::Vertex& v) {
    return files::shortest(v[0]) + ", " + files::shortest(v[1]) + ", " + files::shortest(v[2]);
  };
  row("faces",
      std::to_string(facts.triangles) + " in " + std::to_string(facts.parts) + (facts.parts == 1 ? " part" : " parts"));
  row("vertices", std::to_string(facts.vertices) + ", " + std::to_string(facts.unused_vertices) + " of them in no face");
  row("edges", std::to_string(facts.edges) + ", " + std::to_string(facts.rim_edges) + " of them at a rim");
  row("box", point(facts.low) + " to " + point(facts.high) + " mm");
  row("edge lengths", shortest(facts.shortest_edge) + " to " + shortest(facts.longest_edge) + " mm");
  row("area", shortest(facts.area) + " mm^2");
  if (facts.is_closed())
    row("volume", shortest(std::fabs(facts.volume)) + " mm^3; the fronts are " + (facts.volume > 0 ? "outside" : "inside"));
  row("normals", has_normals ? "in the file" : "none");
  row("texture", has_texture ? "in the file" : "none");
  for (const auto& [name, names] : {std::pair("materials", &loaded.materials), {"groups", &loaded.groups}})
    row(name, files::printable(words_of(*names)));
  print(notes);
  return kHeld;
}

int repair(const MeshFileOptions& options) {
  mesh::LoadedMesh loaded = load(options);
  std::vector<std::string> done = loaded.notes;
  if (!loaded.normals.empty() || !loaded.texture.empty()) done.emplace_back("normals and texture are left out");
  if (!loaded.materials.names.empty() || !loaded.groups.names.empty())
    done.emplace_back("the names of materials and groups are left out");
  mesh::Repaired repaired = mesh::repair(std::move(loaded.mesh));
  done.insert(done.end(), repaired.done.begin(), repaired.done.end());
  write_mesh(options.out, repaired.mesh);
  const auto checked = checked_with_progress(options.out, std::move(repaired.mesh), options.self_intersections());
  const auto* findings = std::get_if<mesh::Findings>(&checked);
  const std::vector<std::string> faults = findings == nullptr ? std::vector<std::string>{} : lines_of(*findings, {});
  write_json(options,
             {{"file", options.file}, {"out", options.out}, {"done", done}, {"held", findings == nullptr}, {"faults", faults}});
  if (options.json != "-" && options.out != "-") {
    print(repaired.done.empty() ? std::vector<std::string>{"nothing to repair"} : done);
    if (findings != nullptr) std::printf("%s, of the repaired file\n", kFailedHeading);
    print_faults(options.out, faults);
  }
  return findings == nullptr ? kHeld : kFailed;
}

struct MakeOptions {
  std::string shape, out, height_map;
  std::string radius, across_radius = "10mm", width = subjects::kUsualWidth, size = "100mm";
  std::uint32_t cells = 64;
};

struct ShapeOptions {
  std::string_view shape, options;  // the options have an effect on the shape
};
constexpr ShapeOptions kShapeOptions[]{{"icosphere", "--radius --cells"},
                                       {"cube", "--size"},
                                       {"wall", "--size --cells"},
                                       {"torus", "--radius --across-radius --cells"},
                                       {"bump", "--radius --width --size --cells"},
                                       {"cylinder-bump", "--radius --width --size --cells"},
                                       {"height-map", "--height-map --size --cells"}};

void expect_options_of(const std::string& shape, const CLI::App& command) {
  const std::string_view options = std::ranges::find(kShapeOptions, shape, &ShapeOptions::shape)->options;
  for (const char* option : {"--radius", "--across-radius", "--width", "--size", "--cells", "--height-map"})
    if (command.count(option) > 0 && options.find(option) == std::string_view::npos)
      throw BadInput(std::string(option) + ": has no effect on the shape " + shape + "; expected " + std::string(options));
}

// The lowest binary32 number above which, in this column, a height map exerts no force: its surface, rounded up.
double surface_of(const fast::HeightMapField& field, double x, double y) {
  const auto is_free = [&](float z) {
    return field.evaluate({static_cast<float>(x), static_cast<float>(y), z}).status == Status::free;
  };
  float low = -9999, high = 9999;
  if (!is_free(high) || is_free(low))
    throw BadInput("--height-map: at x = " + files::shortest(x) + " mm, y = " + files::shortest(y) +
                   " mm no surface is found within 9999 mm");
  while (true) {
    const auto middle = static_cast<float>((static_cast<double>(low) + static_cast<double>(high)) / 2);
    if (middle == low || middle == high || high - low < 0x1p-30F) return static_cast<double>(high);
    (is_free(middle) ? high : low) = middle;
  }
}

double length(const char* name, const std::string& text) {
  const float length = files::parse_length(name, text);
  if (!(length > 0 && length <= 20000))
    throw BadInput(std::string(name) + ": expected a length above 0 and up to 20000 mm, got \"" + text + '"');
  return static_cast<double>(length);
}

mesh::TriangleMesh made(const MakeOptions& options) {
  const double size = length("--size", options.size), width = length("--width", options.width);
  const double across_radius = length("--across-radius", options.across_radius);
  const bool is_large = options.shape == "icosphere" || options.shape == "torus";
  const double radius = length("--radius", !options.radius.empty() ? options.radius
                                           : is_large              ? "50mm"
                                                                   : subjects::kUsualRadius);
  if (options.height_map.empty() && options.shape == "height-map")
    throw BadInput("--height-map: expected a height map for the shape height-map, got none");
  if (options.shape == "icosphere") return mesh::icosphere(options.cells, radius);
  if (options.shape == "cube") return mesh::cube(size);
  if (options.shape == "wall") return mesh::thin_wall(size, size, options.cells, options.cells);
  if (options.shape == "torus" && !(across_radius < radius))
    throw BadInput("--across-radius: expected less than --radius, " + shortest(radius) + " mm, got \"" + options.across_radius +
                   '"');
  if (options.shape == "torus") return mesh::torus(radius, across_radius, options.cells, std::max(options.cells / 2, 3U));
  if (options.shape == "bump") return mesh::bump(radius, width, size, options.cells);
  if (options.shape == "cylinder-bump") return mesh::cylinder_bump(radius, width, size, options.cells);
  const heights::Spec spec = heights::read_spec(options.height_map);
  subjects::expect_valid(options.height_map, spec);
  const auto field = built(fast::HeightMapField::build(spec.map, spec.mode, 1), options.height_map + ": ");
  return mesh::height_map(size, size, options.cells, options.cells,
                          [&](double x, double y) { return surface_of(field, x, y); });
}

int make(const MakeOptions& options) {
  try {
    const bool is_solid = options.shape == "icosphere" || options.shape == "cube" || options.shape == "torus";
    write_made(options.out, made(options), is_solid ? &mesh::texture_from_box : &mesh::texture_from_above);
  } catch (const std::invalid_argument& error) {
    throw BadInput("mesh make " + options.shape + ": " + error.what());
  }
  return kHeld;
}

void add_make(CLI::App& command, int& result) {
  CLI::App* verb = command.add_subcommand("make", "Write a mesh of a simple shape");
  const auto options = std::make_shared<MakeOptions>();
  verb->add_option("shape", options->shape,
                   "icosphere, cube, wall (a square without thickness), torus, bump, cylinder-bump, or height-map: the surface "
                   "on which the force of a height map begins")
      ->type_name("SHAPE")
      ->required()
      ->check(one_of({"icosphere", "cube", "wall", "torus", "bump", "cylinder-bump", "height-map"}));
  verb->add_option("--radius", options->radius, "of an icosphere or torus, 50mm unless said, or of a bump, 15.24mm unless said")
      ->type_name("LENGTH");
  add_length(*verb, "--across-radius", options->across_radius, "of a torus: of the circle across");
  add_length(*verb, "--width", options->width, "of a bump");
  add_length(*verb, "--size", options->size, "of a cube, or of the square on which a wall, bump or height map lies");
  add_whole(*verb, "--cells", options->cells,
            "along each side of the square, or around a torus; each edge of an icosahedron becomes so many", {1, 16384});
  verb->add_option("--height-map", options->height_map, "for the shape height-map: a TOML file (docs/height-maps.md)")
      ->type_name("SPEC");
  add_output(*verb, "--out", options->out, "the mesh in mm: NAME.obj, an OBJ file with texture coordinates; else an OFF file",
             {".off", ".obj"})
      ->required();
  verb->callback([options, verb, &result] {
    expect_options_of(options->shape, *verb);
    result = make(*options);
  });
}

}  // namespace

void add_mesh(CLI::App& app, int& result) {
  CLI::App* command = app.add_subcommand("mesh", "Check, look into, repair and make triangle meshes");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, int (*run)(const MeshFileOptions&)) {
    const auto options = std::make_shared<MeshFileOptions>();
    CLI::App* verb = command->add_subcommand(name, help);
    verb->add_option("file", options->file, "a mesh: FILE.obj, .off, .ply or .stl; - is standard input")
        ->type_name("FILE")
        ->required();
    add_word(*verb, "--unit", options->unit, "of the coordinates in the file, which no format says", {"mm", "m", "in"})
        ->required();
    verb->callback([options, run, &result] { result = run(*options); });
    return std::pair(verb, options);
  };
  const auto allow_self_intersections = [](CLI::App& verb, MeshFileOptions& options) {
    verb.add_flag("--self-intersecting", options.self_intersecting, "allow faces without a common vertex to cross");
  };
  const auto [check_verb, check_options] =
      add("check", "Whether it is a mesh that can be rendered: 0 if so, 1 and what is wrong, with the numbers of faces, if not",
          check);
  allow_self_intersections(*check_verb, *check_options);
  add_json(*check_verb, check_options->json, "the same");
  const auto [info_verb, info_options] = add("info", "Faces, edges, parts, size; whether it is closed", info);
  add_json(*info_verb, info_options->json, "the same");
  const auto [repair_verb, repair_options] = add(
      "repair", "Join equal vertices, drop faces without area or twice there, turn faces over; lists what was done", repair);
  allow_self_intersections(*repair_verb, *repair_options);
  add_output(*repair_verb, "--out", repair_options->out, "the repaired mesh, an OFF file in mm", {".off"})->required();
  add_json(*repair_verb, repair_options->json, "what was done,");
  add_make(*command, result);
}

}  // namespace forceshade::apps
