// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <string_view>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "files/csv.h"
#include "files/output_file.h"
#include "files/quantity.h"
#include "forceshade/fast.h"
#include "forceshade/heights.h"
#include "rendering/meshes/make.h"
#include "rendering/meshes/save.h"
#include "subjects/height_map.h"
#include "subjects/options.h"

namespace forceshade::apps {
namespace {

using TexturePoints = std::vector<std::array<mesh::TexturePoint, 3>>;

// A mesh that is made, with its texture if the file can hold one.
void write_made(const std::string& path, const mesh::TriangleMesh& triangles,
                TexturePoints (*texture)(const mesh::TriangleMesh&)) {
  files::OutputFile file(path);
  if (files::format_ending(path) == ".obj")
    mesh::write_obj(file.stream(), triangles, texture(triangles));
  else
    mesh::write_off(file.stream(), triangles);
  file.commit();
}

struct MakeOptions {
  std::string shape, out, height_map;
  std::string radius, width = subjects::kUsualWidth, size = "100mm";
  std::uint32_t cells = 64;
};

struct ShapeOptions {
  std::string_view shape, options;  // the options have an effect on the shape
};
constexpr ShapeOptions kShapeOptions[]{{"icosphere", "--radius --cells"},
                                       {"cube", "--size"},
                                       {"wall", "--size --cells"},
                                       {"torus", "--radius --cells"},
                                       {"bump", "--radius --width --size --cells"},
                                       {"cylinder-bump", "--radius --width --size --cells"},
                                       {"height-map", "--height-map --size --cells"}};

void expect_options_of(const std::string& shape, const CLI::App& command) {
  const std::string_view options = std::ranges::find(kShapeOptions, shape, &ShapeOptions::shape)->options;
  for (const char* option : {"--radius", "--width", "--size", "--cells", "--height-map"})
    if (command.count(option) > 0 && options.find(option) == std::string_view::npos)
      throw Error(std::string(option) + ": has no effect on the shape " + shape + "; expected " + std::string(options));
}

// The lowest binary32 number above which, in this column, a height map exerts no force: its surface, rounded up.
double surface_of(const fast::HeightMapField& field, double x, double y) {
  const auto is_free = [&](float z) {
    return field.evaluate({static_cast<float>(x), static_cast<float>(y), z}).status == Status::free;
  };
  float low = -9999, high = 9999;
  if (!is_free(high) || is_free(low))
    throw Error("--height-map: at x = " + shortest(x) + " mm, y = " + shortest(y) + " mm no surface is found within 9999 mm");
  while (true) {
    const auto middle = static_cast<float>((static_cast<double>(low) + static_cast<double>(high)) / 2);
    if (middle == low || middle == high || high - low < 0x1p-30F) return static_cast<double>(high);
    (is_free(middle) ? high : low) = middle;
  }
}

double length(const char* name, const std::string& text) {
  const float length = files::parse_length(name, text);
  if (!(length > 0 && length <= 20000))
    throw Error(std::string(name) + ": expected a length above 0 and up to 20000 mm, got \"" + text + '"');
  return static_cast<double>(length);
}

mesh::TriangleMesh made(const MakeOptions& options) {
  const double size = length("--size", options.size), width = length("--width", options.width);
  const bool is_torus = options.shape == "torus", is_ball = options.shape == "icosphere";
  const std::string usual_radius = is_torus ? "50mm,10mm" : is_ball ? "50mm" : subjects::kUsualRadius;
  const std::vector<std::string> radii = files::at_commas(options.radius.empty() ? usual_radius : options.radius);
  if (radii.size() != (is_torus ? 2 : 1))
    throw Error("--radius: expected " +
                std::string(is_torus ? "two lengths, around and across, such as " : "a length such as ") + usual_radius +
                ", got \"" + options.radius + '"');
  const double radius = length("--radius", radii.front()), across = length("--radius", radii.back());
  if (options.height_map.empty() && options.shape == "height-map")
    throw Error("--height-map: expected a height map for the shape height-map, got none");
  if (is_ball) return mesh::icosphere(options.cells, radius);
  if (options.shape == "cube") return mesh::cube(size);
  if (options.shape == "wall") return mesh::thin_wall(size, size, options.cells, options.cells);
  if (is_torus && !(across < radius))
    throw Error("--radius: expected a radius across below that around, " + shortest(static_cast<float>(radius)) +
                " mm, got \"" + radii.back() + '"');
  if (is_torus) return mesh::torus(radius, across, options.cells, std::max(options.cells / 2, 3U));
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
    throw Error("mesh make " + options.shape + ": " + error.what());
  }
  return kHeld;
}

}  // namespace

void add_mesh_make(CLI::App& command, int& result) {
  CLI::App* verb = command.add_subcommand("make", "Write a mesh of a simple shape");
  const auto options = std::make_shared<MakeOptions>();
  verb->add_option("shape", options->shape,
                   "icosphere, cube, wall (a square without thickness), torus, bump, cylinder-bump, or height-map: the surface "
                   "on which the force of a height map begins")
      ->type_name("SHAPE")
      ->required()
      ->check(one_of({"icosphere", "cube", "wall", "torus", "bump", "cylinder-bump", "height-map"}));
  verb->add_option(
          "--radius", options->radius,
          "of an icosphere, default: 50mm; of a torus, around and across, default: 50mm,10mm; or of a bump, default: 15.24mm")
      ->type_name("LENGTH[,LENGTH]");
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

}  // namespace forceshade::apps
