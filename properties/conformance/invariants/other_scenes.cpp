// SPDX-License-Identifier: BSD-3-Clause
// The same surface, described otherwise, feels the same.

#include <algorithm>
#include <functional>
#include <utility>

#include "forceshade/meshes.h"
#include "properties/binary32.h"
#include "properties/conformance/invariants/all.h"

namespace forceshade::conformance {
namespace {

using properties::show;
using Turn = std::function<Eigen::Vector3f(const Eigen::Vector3f&)>;  // of the scene; also of positions and forces

constexpr int kStrokeSteps = 40;

mesh::CheckedMesh checked(mesh::TriangleMesh mesh) {
  return std::get<mesh::CheckedMesh>(mesh::check_any(std::move(mesh)));
}

std::array<float, 3> turned(const Turn& turn, const std::array<float, 3>& vector) {
  const Eigen::Vector3f there = turn(Eigen::Vector3f(vector.data()));
  return {there.x(), there.y(), there.z()};
}

// is_mirrored: so that the corners of each triangle go round the other way.
Description turned(const Description& description, const Turn& turn, bool is_mirrored) {
  MeshRendering rendering = std::get<MeshRendering>(description.what);
  mesh::TriangleMesh mesh = rendering.mesh();
  for (mesh::Vertex& vertex : mesh.vertices) vertex = turned(turn, vertex);
  for (auto& corners : rendering.normals)
    for (mesh::Normal& normal : corners) normal = turned(turn, normal);
  for (auto& corners : rendering.texture.corners)
    for (mesh::CornerTexture& corner : corners) {
      corner.gradient_x = turned(turn, corner.gradient_x);
      corner.gradient_y = turned(turn, corner.gradient_y);
    }
  if (is_mirrored) {
    for (mesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    for (auto& corners : rendering.normals) std::swap(corners[1], corners[2]);
    for (auto& corners : rendering.texture.corners) std::swap(corners[1], corners[2]);
  }
  rendering.checked = checked(std::move(mesh));
  return {description.name, rendering};
}

// Vertices and triangles in the opposite order, and each triangle from its second corner on.
Description renumbered(const Description& description) {
  MeshRendering rendering = std::get<MeshRendering>(description.what);
  mesh::TriangleMesh mesh = rendering.mesh();
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  std::ranges::reverse(mesh.vertices);
  const auto from_the_second = [](auto& per_triangle) {
    std::ranges::reverse(per_triangle);
    for (auto& corners : per_triangle) std::ranges::rotate(corners, corners.begin() + 1);
  };
  from_the_second(mesh.triangles);
  from_the_second(rendering.normals);
  from_the_second(rendering.texture.corners);
  for (mesh::Triangle& triangle : mesh.triangles)
    for (std::uint32_t& vertex : triangle) vertex = last - vertex;
  rendering.checked = checked(std::move(mesh));
  return {description.name, rendering};
}

// Into contact, and then aslant along it.
std::vector<Path> strokes(const Trial& trial) {
  std::vector<Path> all;
  for (const Approach& approach : trial.approaches) {
    all.push_back(approach.line(trial.renderer, kStrokeSteps));
    for (int i = 1; i <= kStrokeSteps; ++i)
      all.back().push_back(
          trial.renderer.writable(approach.contact + static_cast<float>(i) / kStrokeSteps * Eigen::Vector3f(3, 1.75F, 0)));
  }
  return all;
}

// The same strokes in another renderer, on the turned scene.
Invariant compared(const Trial& trial, Invariant invariant, const Description& scene, const Turn& turn) {
  SceneRenderer other = trial.open(scene);
  if (other.hello().refusal) {
    invariant.not_applicable = "it does not render that scene: " + *other.hello().refusal;
    return invariant;
  }
  for (const Path& stroke : strokes(trial)) {
    Path turned_stroke(stroke.size());
    std::ranges::transform(stroke, turned_stroke.begin(), turn);
    const Path forces = trial.renderer.forces_along(stroke), there = other.forces_along(turned_stroke);
    for (std::size_t i = 0; i < stroke.size(); ++i) {
      ++invariant.cases;
      if (differ(turn(forces[i]), there[i]))
        invariant.violated("at " + show(stroke[i]) + " mm the force is " + show(forces[i]) + " N, and there, at " +
                           show(turned_stroke[i]) + " mm, " + show(there[i]) + " N: a hand would feel " +
                           newtons(turn(forces[i]) - there[i]));
    }
    trial.monitor.at(0.98);
  }
  other.say_goodbye();
  if (invariant.cases == 0) invariant.not_applicable = trial.why_no_approach();
  return invariant;
}

// A square plate of 40 mm at z = 0, of cells on which the inner corners are shifted; either diagonal.
Description plate(const Description& description, int cells) {
  MeshRendering rendering = std::get<MeshRendering>(description.what);
  mesh::TriangleMesh mesh;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const auto place = [cells](int at, int other) {
        const bool is_inner = at > 0 && at < cells && other > 0 && other < cells;
        return -20 + 40 * static_cast<float>(at) / static_cast<float>(cells) +
               (is_inner ? static_cast<float>((7 * at + 3 * other) % 5 - 2) / 4 : 0);
      };
      mesh.vertices.push_back({place(column, row), place(row, column), 0});
    }
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const auto corner = [&](int r, int c) { return static_cast<std::uint32_t>((row + r) * (cells + 1) + column + c); };
      if ((row + column) % 2 == 0) {
        mesh.triangles.push_back({corner(0, 0), corner(0, 1), corner(1, 1)});
        mesh.triangles.push_back({corner(0, 0), corner(1, 1), corner(1, 0)});
      } else {
        mesh.triangles.push_back({corner(0, 0), corner(0, 1), corner(1, 0)});
        mesh.triangles.push_back({corner(0, 1), corner(1, 1), corner(1, 0)});
      }
    }
  if (rendering.has_corner_normals()) rendering.normals.assign(mesh.triangles.size(), {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}});
  rendering.checked = checked(std::move(mesh));
  return {"plate of " + std::to_string(cells) + " x " + std::to_string(cells) + " cells", rendering};
}

// Compares plates as they feel along paths; is_last_only: only at their ends. The speed of a landing is forgotten at the second
// position, where the hand waits for that.
void feel_plates(const Trial& trial, Invariant& invariant, const std::vector<Path>& paths, bool is_last_only,
                 const std::string& what) {
  for (const int cells : {1, 2, 8, 16}) {
    const Description scene = plate(trial.description, cells);
    SceneRenderer renderer = trial.open(scene);
    if (renderer.hello().refusal) {
      invariant.not_applicable = "it does not render a plate: " + *renderer.hello().refusal;
      return;
    }
    for (const Path& path : paths) {
      const Path forces = renderer.forces_along(path);
      for (std::size_t i = is_last_only ? path.size() - 1 : 1 + trial.settling(); i < path.size(); ++i) {
        const Eigen::Vector3f expected(0, 0, -path[i].z() * trial.description.stiffness());
        ++invariant.cases;
        if (differ(forces[i], expected))
          invariant.violated("on a " + scene.name + ", at " + show(path[i]) + " mm, the force is " + show(forces[i]) +
                             " N and not " + show(expected) + " N: a hand would feel " + newtons(forces[i] - expected) + what);
      }
    }
    renderer.say_goodbye();
  }
}

// The reason why no plate is felt.
std::optional<std::string> without_plates(const Trial& trial) {
  if (!trial.is_mesh()) return "the scene has no triangles";
  if (std::get<MeshRendering>(trial.description.what).shading == mesh::Shading::texture_scheme)
    return "a textured plate is not flat";
  return std::nullopt;
}

}  // namespace

Invariant flat_however_triangulated(const Trial& trial) {
  Invariant invariant{"a flat plate feels flat however it is triangulated", 0, {}, without_plates(trial)};
  if (trial.renderer.hello().damping && trial.renderer.hello().damping->drag > 0)
    invariant.not_applicable = "drag pulls along a flat plate";
  if (invariant.not_applicable) return invariant;
  Path path;
  for (int i = 0; i <= 800; ++i) {
    const float share = static_cast<float>(i) / 800;
    path.push_back(trial.renderer.writable({-15 + 28 * share, -11 + 23 * share, i == 0 ? 2 : -0.5F}));
    if (i == 1) path.resize(path.size() + trial.settling(), path.back());
  }
  feel_plates(trial, invariant, {path}, false, " at an edge that is not there");
  return invariant;
}

Invariant no_jump_through_a_plate(const Trial& trial) {
  Invariant invariant{"no jump goes through a plate", 0, {}, without_plates(trial)};
  if (!invariant.not_applicable && !trial.renderer.hello().remembers)
    invariant.not_applicable = "without memory no side of a plate is known";
  if (invariant.not_applicable) return invariant;
  std::vector<Path> jumps;
  for (int i = 0; i < 20; ++i) {
    const auto at = static_cast<float>(i);
    const Eigen::Vector3f over(-15 + 1.375F * at, 11 - 1.125F * at, 3);
    jumps.push_back({trial.renderer.writable(over)});
    jumps.back().resize(2 + trial.settling(), trial.renderer.writable(over - Eigen::Vector3f(0, 0, 4 + at)));
  }
  feel_plates(trial, invariant, jumps, true, " less on the other side of it");
  return invariant;
}

Invariant renumbered_scene(const Trial& trial) {
  Invariant invariant{"triangles and vertices in another order give the same"};
  if (trial.is_mesh())
    return compared(trial, std::move(invariant), renumbered(trial.description), [](const Eigen::Vector3f& v) { return v; });
  invariant.not_applicable = "the scene has no triangles";
  return invariant;
}

Invariant turned_scene(const Trial& trial) {
  Invariant invariant{"a quarter turn of the scene about z turns the force"};
  const Turn turn = [](const Eigen::Vector3f& v) { return Eigen::Vector3f(-v.y(), v.x(), v.z()); };
  if (trial.is_mesh()) return compared(trial, std::move(invariant), turned(trial.description, turn, false), turn);
  invariant.not_applicable = "the scene cannot be turned";
  return invariant;
}

Invariant mirrored_scene(const Trial& trial) {
  Invariant invariant{"a mirrored scene mirrors the force"};
  const Turn mirror = [](const Eigen::Vector3f& v) { return Eigen::Vector3f(-v.x(), v.y(), v.z()); };
  if (trial.is_mesh()) return compared(trial, std::move(invariant), turned(trial.description, mirror, true), mirror);
  // Every law is its own mirror image.
  if (std::holds_alternative<DescribedLaw>(trial.description.what))
    return compared(trial, std::move(invariant), trial.description, mirror);
  invariant.not_applicable = "the scene cannot be mirrored";
  return invariant;
}

}  // namespace forceshade::conformance
