// SPDX-License-Identifier: BSD-3-Clause
// Faces that touch, coincide or share an edge in any number feel like the surface that they are (docs/soups.md).

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "forceshade/meshes.h"
#include "properties/binary32.h"
#include "properties/conformance/invariants/all.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {
namespace {

using Corners = std::vector<mesh::Vertex>;

constexpr int kSteps = 12;  // of a straight part of a path

// A polygon as triangles from its first corner on.
void add_face(mesh::TriangleMesh& mesh, const Corners& corners) {
  std::vector<std::uint32_t> numbers;
  for (const mesh::Vertex& corner : corners) {
    const auto found = std::ranges::find(mesh.vertices, corner);
    numbers.push_back(static_cast<std::uint32_t>(found - mesh.vertices.begin()));
    if (found == mesh.vertices.end()) mesh.vertices.push_back(corner);
  }
  for (std::size_t i = 2; i < numbers.size(); ++i) mesh.triangles.push_back({numbers[0], numbers[i - 1], numbers[i]});
}

mesh::TriangleMesh faces(std::initializer_list<Corners> all) {
  mesh::TriangleMesh mesh;
  for (const Corners& corners : all) add_face(mesh, corners);
  return mesh;
}

// The triangles of both, those that are in both twice.
mesh::TriangleMesh together(mesh::TriangleMesh mesh, const mesh::TriangleMesh& other) {
  for (const auto& [a, b, c] : other.triangles) add_face(mesh, {other.vertices[a], other.vertices[b], other.vertices[c]});
  return mesh;
}

const Corners kLeft{{-20, -20, 0}, {0, -20, 0}, {0, 20, 0}, {-20, 20, 0}};
const Corners kRight{{20, -20, 0}, {20, 20, 0}, {0, 20, 0}, {0, -20, 0}};
// With corners on the side that it shares with the left one.
const Corners kSplitRight{{20, -20, 0}, {20, 20, 0}, {0, 20, 0}, {0, 0.5F, 0}, {0, -10, 0}, {0, -20, 0}};

mesh::TriangleMesh plate() {
  return faces({kLeft, kRight});
}

// 10 mm high, with its top at z = 0.
mesh::TriangleMesh box(float from, float to) {
  const auto at = [&](int x, int y, int z) {
    return mesh::Vertex{x < 0 ? from : to, 20 * static_cast<float>(y), z < 0 ? -10.0F : 0.0F};
  };
  return faces({{at(-1, -1, 1), at(1, -1, 1), at(1, 1, 1), at(-1, 1, 1)},
                {at(-1, -1, -1), at(-1, 1, -1), at(1, 1, -1), at(1, -1, -1)},
                {at(-1, -1, -1), at(1, -1, -1), at(1, -1, 1), at(-1, -1, 1)},
                {at(1, 1, -1), at(-1, 1, -1), at(-1, 1, 1), at(1, 1, 1)},
                {at(-1, 1, -1), at(-1, -1, -1), at(-1, -1, 1), at(-1, 1, 1)},
                {at(1, -1, -1), at(1, 1, -1), at(1, 1, 1), at(1, -1, 1)}});
}

Corners page(float x, float z) {
  return {{x, 20, z}, {x, -20, z}, {0, -20, 0}, {0, 20, 0}};
}

// Pages on one edge, along y; two of them are the valley x = z, x = -z.
mesh::TriangleMesh book(const Corners& right = page(20, 20)) {
  return faces({right, page(-20, 20), page(20, 0), page(-16, -12), page(0, -20)});
}

enum class Twin { none, coincides, is_split };

// Faces that meet on the line x = z = 0. A twin has to feel like the plain plate or book.
struct Scene {
  const char* name;
  mesh::TriangleMesh mesh;
  mesh::Sides sides = mesh::Sides::both;
  Twin twin = Twin::none;
  bool is_book = false;
};

std::vector<Scene> scenes() {
  const auto both = mesh::Sides::both;
  const Corners across{{20, -20, 0}, {20, 20, 0}, {-20, 20, 0}, {-20, -20, 0}}, turned_over(across.rbegin(), across.rend());
  const Corners split_page{{20, 20, 20}, {20, -20, 20}, {0, -20, 0}, {0, -5, 0}, {0, 0.5F, 0}, {0, 20, 0}};
  return {{"a plate twice", together(plate(), plate()), both, Twin::coincides},
          {"a plate twice, of other triangles", together(plate(), faces({across})), both, Twin::coincides},
          {"a plate and the same turned over", together(plate(), faces({turned_over})), both, Twin::coincides},
          {"a plate of which one half is split at their common side", faces({kLeft, kSplitRight}), both, Twin::is_split},
          {"two boxes side by side", together(box(-20, 0), box(0, 20)), mesh::Sides::front, Twin::is_split},
          {"a book", book(), both, Twin::none, true},
          {"a book with each page twice", together(book(), book()), both, Twin::coincides, true},
          {"a book with one page split at the spine", book(split_page), both, Twin::is_split, true}};
}

Scene plain(bool is_book) {
  return {is_book ? "the book" : "the plate", is_book ? book() : plate(), mesh::Sides::both, Twin::none, is_book};
}

// Unshaded, with the stiffness of the trial's scene.
Description description_of(const Trial& trial, const Scene& scene) {
  return {scene.name, MeshRendering{.checked = std::get<mesh::CheckedMesh>(mesh::check_any(scene.mesh)),
                                    .sides = scene.sides,
                                    .shading = mesh::Shading::none,
                                    .stiffness = trial.description.stiffness()}};
}

// From the air above the line on which faces meet, through it and along it, and in one jump.
std::vector<Path> paths(const Trial& trial, bool is_book) {
  using Points = std::vector<Eigen::Vector3f>;
  const std::vector<Points> strokes =
      is_book ? std::vector<Points>{{{0, -9, 8}, {0, -9, -1}, {0.5F, 9, -1}, {4, 9, 1}, {-3, -6, 0.5F}},
                                    {{1, -5, 8}, {0.25F, -5, -2}, {-1.5F, 0.5F, -2}, {-0.25F, 7, -9}}}
              : std::vector<Points>{{{0, -15, 3}, {0, -15, -0.5F}, {0, 13, -0.5F}},
                                    {{-8, 0.5F, 3}, {-8, 0.5F, -0.5F}, {8, 0.5F, -1}},
                                    {{6, -10, 3}, {6, -10, -0.5F}, {-6, -10, -0.5F}},
                                    {{-15, -11, 3}, {-15, -11, -0.5F}, {13, 12, -2}}};
  std::vector<Path> all;
  const auto at = [&](const Eigen::Vector3f& position) { return trial.renderer.writable(position); };
  for (const Points& points : strokes) {
    all.push_back({at(points[0])});
    for (std::size_t part = 1; part < points.size(); ++part)
      for (int i = 1; i <= kSteps; ++i)
        all.back().push_back(at(points[part - 1] + static_cast<float>(i) / kSteps * (points[part] - points[part - 1])));
  }
  for (const float y : {-10.0F, -5.0F, 0.5F, 3.0F})
    for (const float x : {0.0F, 0.75F}) all.push_back({at({x, y, 4}), at({-2 * x, y, -2 - x})});
  return all;
}

// The reason why no such scene is tried. A renderer of regular meshes is not even opened on one, which it may refuse by
// failing.
std::optional<std::string> without_scenes(const Trial& trial) {
  if (!trial.is_mesh()) return "the scene has no triangles";
  const auto& declared = trial.renderer.hello().declared;
  if (!declared.contains("meshes") || declared.at("meshes") != "any") return R"(it declares meshes "regular" and not "any")";
  return std::nullopt;
}

// Calls look(scene, renderer) for each scene that the renderer renders.
template <class Look>
Invariant in_scenes(const Trial& trial, Invariant invariant, const std::vector<Scene>& all, Look look) {
  if (!invariant.not_applicable) invariant.not_applicable = without_scenes(trial);
  if (invariant.not_applicable) return invariant;
  std::optional<std::string> refusal;
  for (const Scene& scene : all) {
    trial.monitor.at(0.98);
    SceneRenderer renderer = trial.open(description_of(trial, scene));
    if (renderer.hello().refusal) {
      refusal = std::string("it does not render ") + scene.name + ": " + *renderer.hello().refusal;
      continue;
    }
    look(invariant, scene, renderer);
    renderer.say_goodbye();
  }
  if (invariant.cases == 0) invariant.not_applicable = refusal;
  return invariant;
}

std::string place(const Scene& scene, const Eigen::Vector3f& position) {
  return std::string("on ") + scene.name + ", at " + properties::show(position) + " mm, ";
}

// Each twin of this kind along the same paths as the plain one.
Invariant like_plain(const Trial& trial, const std::string& name, Twin twin) {
  std::vector<Scene> all = scenes();
  std::erase_if(all, [twin](const Scene& scene) { return scene.twin != twin; });
  return in_scenes(trial, {name}, all, [&](Invariant& invariant, const Scene& scene, SceneRenderer& renderer) {
    const Scene whole = plain(scene.is_book);
    SceneRenderer of_whole = trial.open(description_of(trial, whole));
    if (of_whole.hello().refusal) return;
    for (const Path& path : paths(trial, scene.is_book)) {
      const Path forces = renderer.forces_along(path), expected = of_whole.forces_along(path);
      for (std::size_t i = 0; i < path.size(); ++i) {
        ++invariant.cases;
        if (differ(forces[i], expected[i]))
          invariant.violated(place(scene, path[i]) + "the force is " + properties::show(forces[i]) + " N, and on " +
                             whole.name + ' ' + properties::show(expected[i]) + " N: a hand would feel " +
                             newtons(forces[i] - expected[i]));
      }
    }
    of_whole.say_goodbye();
  });
}

}  // namespace

// A hand that is so far behind a wall is pushed back by at least half of what a spring of that length gives.
Invariant nothing_passes_where_faces_meet(const Trial& trial) {
  Invariant invariant{"nothing passes where faces meet"};
  if (trial.is_mesh() && !trial.renderer.hello().remembers) invariant.not_applicable = "without memory no side is known";
  return in_scenes(trial, std::move(invariant), scenes(), [&](Invariant& its, const Scene& scene, SceneRenderer& renderer) {
    const float slant = std::sqrt(0.5F);
    const std::vector<Eigen::Vector3f> normals = scene.is_book
                                                     ? std::vector<Eigen::Vector3f>{{-slant, 0, slant}, {slant, 0, slant}}
                                                     : std::vector<Eigen::Vector3f>{{0, 0, 1}};
    for (Path path : paths(trial, scene.is_book)) {
      path.resize(path.size() + trial.settling(), path.back());
      const Eigen::Vector3f hand = path.back(), force = renderer.forces_along(path).back();
      for (const Eigen::Vector3f& normal : normals) {
        ++its.cases;
        const float spring = -trial.description.stiffness() * normal.dot(hand), is = normal.dot(force);
        if (!(is >= spring / 2))
          its.violated(place(scene, hand) + "the force is " + properties::show(force) + " N: a hand that is pressed on with " +
                       newtons(spring * normal) + " goes through");
      }
    }
  });
}

Invariant coinciding_faces_feel_like_one(const Trial& trial) {
  return like_plain(trial, "faces that coincide feel like one", Twin::coincides);
}

Invariant split_face_feels_like_the_whole(const Trial& trial) {
  return like_plain(trial, "a split face feels like the whole", Twin::is_split);
}

Invariant meeting_faces_are_as_defined(const Trial& trial) {
  Invariant invariant{"where faces meet the force is that of the definition"};
  if (!trial.renderer.hello().claims_definition) invariant.not_applicable = "it does not claim the definition";
  return in_scenes(trial, std::move(invariant), scenes(), [&](Invariant& its, const Scene& scene, SceneRenderer& renderer) {
    Judge judge(properties::subject_of(description_of(trial, scene)), trial.tolerance, 0, renderer.hello().damping);
    for (const Path& path : paths(trial, scene.is_book)) {
      const Path forces = renderer.forces_along(path);
      for (std::size_t i = 0; i < path.size(); ++i) {
        ++its.cases;
        const std::optional<Judged> beyond = judge.add({path[i], i == 0, forces[i]});
        if (beyond)
          its.violated(place(scene, path[i]) + "the force is " + properties::show(forces[i]) + " N and not " +
                       properties::show(beyond->exact.force) + " N");
      }
    }
  });
}

}  // namespace forceshade::conformance
