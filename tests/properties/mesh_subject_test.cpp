// SPDX-License-Identifier: BSD-3-Clause
// A god-object as a subject: every property holds of the fast path on every family of meshes, and renderers that are wrong in
// one way each are found by the property that is for it.

#include "forceshade/properties/mesh_subject.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <map>
#include <set>

#include "forceshade/properties/mesh_generators.h"
#include "forceshade/properties/mesh_properties.h"
#include "forceshade/properties/run.h"

namespace forceshade::properties {
namespace {

MeshRendering rendering_of(MeshSource& source, std::size_t family, mesh::Shading shading) {
  RandomMesh random = source.of_family(family);
  MeshRendering rendering{std::move(random.mesh), {}, random.sides, shading, 0.3F};
  if (mesh::has_corner_normals(shading)) rendering.normals = source.normals_of(rendering.mesh);
  if (shading == mesh::Shading::texture_scheme)
    rendering.texture = {source.textures_of(rendering.mesh),
                         {{{height::Grating{1, 0.5F, 0.75F, 0}}, {height::Cone{1, 2, 3, 4}}}}};
  return rendering;
}

TEST(mesh_subject, has_every_property_on_every_family_of_meshes) {
  for (std::size_t family = 0; family < kMeshFamilies.size(); ++family)
    for (const mesh::Shading shading :
         {mesh::Shading::none, mesh::Shading::vertex_scheme, mesh::Shading::edge_scheme, mesh::Shading::texture_scheme}) {
      MeshSource source(2026 + family);
      const MeshSubject subject(std::string(kMeshFamilies[family]), rendering_of(source, family, shading));
      for (const PropertyResult& result : run_properties(subject, 40, 7))
        EXPECT_TRUE(result.held) << subject.identity().name << ", " << name_of(shading) << ", " << result.name << ": "
                                 << result.counterexample;
    }
}

// Answers as the fast path does, changed.
class Changed final : public fast::TickSession {
 public:
  using Change = std::function<mesh::Tick(const mesh::Tick& before, mesh::Tick now, const MeshPosition& position)>;

  Changed(std::unique_ptr<fast::TickSession> right, Change change) : right_(std::move(right)), change_(std::move(change)) {}

  mesh::Tick tick(const std::array<float, 3>& position) noexcept override {
    const mesh::Tick now = right_->tick(position), answer = change_(before_, now, position);
    before_ = now;
    return answer;
  }
  void resume(const mesh::GodObject& state) noexcept override {
    right_->resume(state);
    before_ = {};
    before_.after = state;
  }

 private:
  std::unique_ptr<fast::TickSession> right_;
  Change change_;
  mesh::Tick before_;
};

std::set<std::string> failed(const Changed::Change& change, mesh::Shading shading) {
  MeshSource source(11);
  const MeshRendering rendering = rendering_of(source, 7, shading);
  const MeshSubject subject("star", rendering, [right = fast_god_object(rendering), change](float stiffness) {
    return std::make_unique<Changed>(right(stiffness), change);
  });
  std::set<std::string> names;
  for (const PropertyResult& result : run_properties(subject, 200, 3))
    if (!result.held) names.insert(result.name);
  return names;
}

TEST(mesh_subject, finds_a_renderer_that_is_wrong) {
  using mesh::Tick;
  const auto lags = [](const Tick& before, Tick now, const MeshPosition&) {
    now.force = before.force;
    return now;
  };
  const auto is_softer = [](const Tick&, Tick now, const MeshPosition&) {
    for (float& component : now.force) component *= 0.999F;
    return now;
  };
  const auto is_off_by_one_unit = [](const Tick&, Tick now, const MeshPosition&) {
    if (now.force[0] != 0) now.force[0] = std::nextafter(now.force[0], std::numeric_limits<float>::infinity());
    return now;
  };
  const auto forgets_its_side = [](const Tick&, Tick now, const MeshPosition&) {
    if (now.after.place == mesh::Place::triangle)
      now.after.side = now.after.side == mesh::Side::front ? mesh::Side::back : mesh::Side::front;
    return now;
  };
  const auto stays_behind = [](const Tick& before, Tick now, const MeshPosition& p) {
    // The force towards where the god-object was, as if it had stuck there.
    if (now.status != mesh::TickStatus::touching || before.after.place == mesh::Place::nowhere) return now;
    for (std::size_t i = 0; i < 3; ++i) now.force[i] = before.force[i] - 0.3F * p[i];
    return now;
  };
  EXPECT_EQ(failed([](const Tick&, Tick now, const MeshPosition&) { return now; }, mesh::Shading::none),
            std::set<std::string>{});
  for (const mesh::Shading shading : {mesh::Shading::none, mesh::Shading::vertex_scheme}) {
    const std::map<std::string, Changed::Change> wrong{{"lags", lags},
                                                       {"is softer", is_softer},
                                                       {"is off by one unit", is_off_by_one_unit},
                                                       {"forgets its side", forgets_its_side},
                                                       {"stays behind", stays_behind}};
    for (const auto& [name, change] : wrong) {
      const auto found = failed(change, shading);
      EXPECT_TRUE(found.contains("states")) << name;
      if (name == "forgets its side") {
        EXPECT_EQ(found, std::set<std::string>{"states"}) << name;
        continue;
      }
      EXPECT_TRUE(found.contains("equivalence")) << name;
      if (name != "is off by one unit") {
        EXPECT_TRUE(found.contains("unit normals")) << name;
      }
    }
    EXPECT_TRUE(failed(lags, shading).contains("repeats"));
    EXPECT_TRUE(failed(stays_behind, shading).contains("continuity"));
  }
  EXPECT_TRUE(failed(stays_behind, mesh::Shading::none).contains("passivity"));
}

TEST(mesh_subject, identity_is_that_of_every_number) {
  MeshSource source(5);
  const MeshRendering first = rendering_of(source, 7, mesh::Shading::vertex_scheme);
  const Identity its = identity_of("star.off", first);
  EXPECT_EQ(its.kind, kMeshKind);
  EXPECT_TRUE(its.is_same(identity_of("renamed.off", first)));
  const auto changed = [&](const std::function<void(MeshRendering&)>& change) {
    MeshRendering other = first;
    change(other);
    return !its.is_same(identity_of("star.off", other));
  };
  EXPECT_TRUE(changed([](MeshRendering& r) { r.mesh.vertices[3][1] = std::nextafter(r.mesh.vertices[3][1], 9e3F); }));
  EXPECT_TRUE(changed([](MeshRendering& r) { std::swap(r.mesh.triangles[0], r.mesh.triangles[1]); }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.normals[2][1][0] += 0x1p-20F; }));
  EXPECT_TRUE(
      changed([](MeshRendering& r) { r.sides = r.sides == mesh::Sides::both ? mesh::Sides::front : mesh::Sides::both; }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.shading = mesh::Shading::none; }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.stiffness = 0.5F; }));
}

TEST(mesh_subject, identity_is_that_of_every_number_of_a_texture) {
  MeshSource source(5);
  const MeshRendering first = rendering_of(source, 7, mesh::Shading::texture_scheme);
  const Identity its = identity_of("star.obj", first);
  EXPECT_TRUE(its.is_same(identity_of("star.obj", first)));
  const auto changed = [&](const std::function<void(mesh::Texture&)>& change) {
    MeshRendering other = first;
    change(other.texture);
    return !its.is_alike(identity_of("star.obj", other));
  };
  EXPECT_TRUE(changed([](mesh::Texture& t) { t.corners[4][2].point[1] += 0x1p-10F; }));
  EXPECT_TRUE(changed([](mesh::Texture& t) { t.corners[4][1].gradient_x[0] += 0x1p-20F; }));
  EXPECT_TRUE(changed([](mesh::Texture& t) { t.corners[4][1].gradient_y[2] += 0x1p-20F; }));
  EXPECT_TRUE(changed([](mesh::Texture& t) { t.map.parts.pop_back(); }));
  EXPECT_TRUE(changed([](mesh::Texture& t) { t.corners.clear(); }));
}

}  // namespace
}  // namespace forceshade::properties
