// SPDX-License-Identifier: BSD-3-Clause
// A scene with materials is for renderers that say that they render them; every other scene is as it was before there were any.

#include "properties/conformance/hello.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "forceshade/meshes.h"
#include "properties/conformance/scene.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

Json scene_with(mesh::Materials materials, mesh::Contact contact) {
  const auto checked =
      mesh::check({{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  return scene_of({"its.off", MeshRendering{.checked = std::get<mesh::CheckedMesh>(checked),
                                            .stiffness = 0.5F,
                                            .contact = contact,
                                            .materials = std::move(materials)}});
}

Json plain_hello() {
  return Json::parse(R"({"kind": "renderer", "name": "own", "version": "1", "memory": "path", "answers": "force",
    "claims": "definition", "length_unit": "mm", "force_unit": "N", "frame": ["x", "y", "z"], "domain_mm": 10000,
    "rate_Hz": null, "loop_energy_mJ": null, "sides": ["front"], "shading": ["none"], "proxy_radius_mm": 0})");
}

Hello hello_on(const Json& scene, const Json& materials) {
  Json said = plain_hello();
  if (!materials.is_null()) said["materials"] = materials;
  return hello_of(said, scene);
}

TEST(hello, of_a_renderer_that_says_nothing_of_materials_is_for_scenes_without) {
  const Json plain = scene_with({}, mesh::Contact::direct);
  EXPECT_FALSE(plain.at("mesh").contains("materials"));
  EXPECT_FALSE(plain.at("parameters").contains("friction"));
  EXPECT_EQ(hello_on(plain, nullptr).refusal, std::nullopt);
  EXPECT_FALSE(hello_on(plain, nullptr).declared.contains("materials"));
  const Json smooth = scene_with({{{}}, {}}, mesh::Contact::direct);
  EXPECT_EQ(hello_on(smooth, nullptr).refusal, std::nullopt) << "a material that changes nothing";
}

TEST(hello, is_not_applicable_to_a_scene_with_materials_that_it_does_not_declare) {
  const Json rough = scene_with({{{{}, 0.5F, 0.25F}}, {}}, mesh::Contact::friction);
  EXPECT_EQ(rough.at("parameters").at("friction"), "0.5, 0.25");
  EXPECT_EQ(rough.at("mesh").at("materials").dump(),
            R"([{"stiffness_N_per_mm":null,"static_friction":"0x1p-1","dynamic_friction":"0x1p-2"}])");
  EXPECT_EQ(hello_on(rough, nullptr).refusal, R"(it declares materials [] and not "friction")");
  EXPECT_EQ(hello_on(rough, {"stiffness"}).refusal, R"(it declares materials ["stiffness"] and not "friction")");
  EXPECT_EQ(hello_on(rough, {"friction"}).refusal, std::nullopt);
  EXPECT_EQ(hello_on(rough, {"friction"}).declared.at("materials"), Json{"friction"});
  const Json stiff = scene_with({{{}, {2.0F, 0, 0}}, {0, 1, 0, 1}}, mesh::Contact::direct);
  EXPECT_EQ(stiff.at("mesh").at("materials")[1].at("stiffness_N_per_mm"), "0x1p+1");
  EXPECT_EQ(stiff.at("mesh").at("material_of_triangle").dump(), "[0,1,0,1]");
  EXPECT_EQ(hello_on(stiff, {"friction"}).refusal, R"(it declares materials ["friction"] and not "stiffness")");
  EXPECT_EQ(hello_on(stiff, {"friction", "stiffness"}).refusal, std::nullopt);
  const Json dry = scene_with({{{}, {.damping = {0, HUGE_VALF}}}, {0, 1, 0, 1}}, mesh::Contact::direct);
  EXPECT_EQ(dry.at("mesh").at("materials")[1].dump(),
            R"({"stiffness_N_per_mm":null,"static_friction":"0x0p+0","dynamic_friction":"0x0p+0",)"
            R"("damping_N_s_per_mm":"0x0p+0","drag_N_s_per_mm":null})");
  EXPECT_EQ(hello_on(dry, {"friction"}).refusal, std::nullopt) << "it has no damping that they limit";
  Json damped = plain_hello();
  damped["damping"] = Json::parse(R"({"damping": 0.002, "share": 1, "most": 2, "drag": 0, "full_at": 0.25})");
  damped["rate_Hz"] = 1000;
  damped["materials"] = {"friction"};
  EXPECT_EQ(hello_of(damped, dry).refusal, R"(it declares materials ["friction"] and not "damping")");
  damped["materials"] = {"damping"};
  EXPECT_EQ(hello_of(damped, dry).refusal, std::nullopt);
}

TEST(hello, is_not_applicable_to_any_set_of_triangles_unless_it_declares_them) {
  const auto twice = mesh::check_any({{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, {{0, 1, 2}, {0, 1, 2}}});
  const Json scene = scene_of({"its.off", MeshRendering{.checked = std::get<mesh::CheckedMesh>(twice), .stiffness = 0.5F}});
  Json said = plain_hello();
  said["shading"] = mesh::kShadingNames;
  EXPECT_EQ(hello_of(said, scene).refusal, R"(it declares meshes "regular" and not "any")");
  said["meshes"] = "regular";
  EXPECT_EQ(hello_of(said, scene).refusal, R"(it declares meshes "regular" and not "any")");
  said["meshes"] = "any";
  EXPECT_EQ(hello_of(said, scene).refusal, std::nullopt);
  EXPECT_EQ(hello_of(said, scene).declared.at("meshes"), "any");
  EXPECT_EQ(hello_of(said, scene_with({}, mesh::Contact::direct)).refusal, std::nullopt);
  said["meshes"] = "every";
  EXPECT_THROW(hello_of(said, scene), files::ProcessFailed);
}

TEST(hello, says_in_a_list_what_it_renders_of_materials) {
  const Json plain = scene_with({}, mesh::Contact::direct);
  for (const Json& wrong : {Json(true), Json("friction"), Json::array({1})})
    EXPECT_THROW(hello_on(plain, wrong), files::ProcessFailed);
}

TEST(hello, says_what_its_units_and_axes_are_in_the_scene) {
  const Json scene = scene_with({}, mesh::Contact::direct);
  const Hello plain = hello_of(plain_hello(), scene);
  EXPECT_EQ(plain.millimetres, 1);
  EXPECT_EQ(plain.newtons, 1);
  Json said = plain_hello();
  said["length_unit"] = "m";
  said["force_unit"] = "mN";
  said["frame"] = {"-z", "x", "y"};
  const Hello other = hello_of(said, scene);
  EXPECT_EQ(other.millimetres, 1000);
  EXPECT_EQ(other.newtons, 1e-3);
  EXPECT_EQ(other.frame[0].index, 2U);
  EXPECT_TRUE(other.frame[0].is_opposite);
  EXPECT_EQ(other.frame[1].index, 0U);
  EXPECT_FALSE(other.frame[1].is_opposite);
  for (const Json& wrong : {Json{"x", "y", "y"}, Json{"x", "x", "x"}, Json{"x", "y"}, Json{"x", "y", "w"}, Json("xyz")}) {
    said["frame"] = wrong;
    EXPECT_THROW(hello_of(said, scene), files::ProcessFailed) << wrong;
  }
}

}  // namespace
}  // namespace forceshade::conformance
