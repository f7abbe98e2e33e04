// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/conform.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "properties/conformance/invariants/all.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/scene.h"
#include "rendering/meshes/make.h"
#include "tests/conformance/own_renderer.h"

namespace forceshade::conformance {
namespace {

Description law(LawId id) {
  return {std::string(name_of(id)), DescribedLaw{id, {15.24F, 25.4F, 0.5F}}};
}

Description ball(mesh::Sides sides, mesh::Shading shading, mesh::Contact contact = mesh::kUsualContact) {
  MeshRendering rendering{std::get<mesh::CheckedMesh>(mesh::check(mesh::icosphere(3, 20))), {}, sides, shading, 0.5F};
  rendering.contact = contact;
  if (rendering.has_corner_normals()) rendering.normals = mesh::corner_normals(rendering.checked).normals;
  return {"ball", rendering};
}

// Two with a common side, so that the mesh is not regular.
Description cubes() {
  mesh::TriangleMesh both = mesh::cube(20);
  const mesh::TriangleMesh one = both;
  for (const mesh::Vertex& v : one.vertices) both.vertices.push_back({v[0] + 20, v[1] + 2, v[2]});
  const auto first = static_cast<std::uint32_t>(one.vertices.size());
  for (const auto& [a, b, c] : one.triangles) both.triangles.push_back({first + a, first + b, first + c});
  return {"cubes", MeshRendering{.checked = std::get<mesh::CheckedMesh>(mesh::check_any(std::move(both))),
                                 .sides = mesh::Sides::front,
                                 .shading = mesh::Shading::none,
                                 .stiffness = 0.5F}};
}

std::set<std::string> looked_at(const Conformance& its) {
  std::set<std::string> names;
  for (const Invariant& invariant : its.invariants)
    if (!invariant.not_applicable && invariant.cases > 0) names.insert(invariant.name);
  return names;
}

TEST(conform, holds_of_the_own_renderer_on_every_kind_of_scene) {
  std::vector<Description> scenes;
  for (const LawName& one : kLaws) scenes.push_back(law(one.id));
  for (const mesh::Sides sides : {mesh::Sides::front, mesh::Sides::both})
    for (std::size_t shading = 0; shading < mesh::kShadingNames.size(); ++shading)
      if (mesh::Shading{static_cast<int>(shading)} != mesh::Shading::texture_scheme)
        scenes.push_back(ball(sides, mesh::Shading{static_cast<int>(shading)}));
  scenes.push_back(ball(mesh::Sides::front, mesh::Shading::none, mesh::Contact::sub_goal));
  scenes.push_back(cubes());
  std::set<std::string> names;
  for (const Description& scene : scenes) {
    const Conformance its = conform(scene, own_renderer(scene), {.points = 3000});
    EXPECT_TRUE(its.held()) << words_of(its, {});
    names.merge(looked_at(its));
  }
  EXPECT_EQ(names.size(), kInvariants.size() - 1);  // all but that of energy, which the own renderer does not declare
}

// Compares what depends on the tick, where objects move, with the definition alone.
TEST(conform, looks_at_objects_that_move) {
  scene::Motion motion{{}, true};
  for (int tick = 0; tick < 100; ++tick) motion.poses.push_back({{0, 0, static_cast<float>(tick) / 8}, {1, 0, 0.5F, 0}});
  DescribedScene objects{{}, 1000, 0.5F};
  objects.objects.push_back({"ball", ball(mesh::Sides::front, mesh::Shading::none), motion});
  objects.objects.push_back({"wall", law(LawId::wall), {}});
  const Description scene{"moving.toml", objects};
  const Json text = scene_of(scene);
  EXPECT_EQ(text.at("kind"), "scene");
  ASSERT_EQ(text.at("objects").size(), 2U);
  EXPECT_EQ(text["objects"][0].at("scene").at("kind"), "mesh");
  EXPECT_EQ(text["objects"][0].at("poses").size(), 100U);
  EXPECT_EQ(text["objects"][0]["poses"][2].dump(), R"(["0x0p+0","0x0p+0","0x1p-2","0x1p+0","0x0p+0","0x1p-1","0x0p+0"])");
  EXPECT_EQ(text["objects"][1].at("name"), "wall");
  const Conformance its = conform(scene, own_renderer(scene), {.points = 2000});
  EXPECT_TRUE(its.held()) << words_of(its, {});
  EXPECT_EQ(looked_at(its), (std::set<std::string>{"the same path twice gives the same bits", "a reset equals a fresh start",
                                                   "any position gets a finite force"}));
  const auto stops = [](Description& what, Json&) {
    std::get<DescribedScene>(what.what).objects[0].motion.poses.resize(1);
    return Spoil();
  };
  EXPECT_FALSE(conform(scene, own_renderer(scene, stops), {.points = 2000}).held());
}

TEST(conform, a_proxy_of_any_radius_does_not_claim_the_definition) {
  const Description scene = ball(mesh::Sides::front, mesh::Shading::none);
  const auto open = [&](double radius) {
    own_renderer(scene, [=](Description&, Json& hello) {
      hello["proxy_radius_mm"] = radius;
      return Spoil();
    })(scene_of(scene));
  };
  EXPECT_NO_THROW(open(0));
  EXPECT_THROW(open(1e-3), files::ProcessFailed);
}

}  // namespace
}  // namespace forceshade::conformance
