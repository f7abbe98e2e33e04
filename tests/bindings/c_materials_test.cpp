// SPDX-License-Identifier: BSD-3-Clause
// Materials of a mesh through the C interface: what they are, what is refused, and the struct of a program that was built
// before.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

#include "forceshade.h"
#include "tests/bindings/subjects.h"

namespace forceshade {
namespace {

constexpr std::array<std::uint32_t, 4> kSecondAtTheEnd{0, 0, 0, 1};
constexpr std::array<forceshade_material, 2> kRoughAndStiff{
    {{sizeof(forceshade_material), 0, 0.5F, 0.25F}, {sizeof(forceshade_material), 2, 0, 0}}};

forceshade_mesh with_materials(const forceshade_material* materials, std::size_t count) {
  forceshade_mesh its = tests::tetrahedron_mesh();
  its.materials = materials;
  its.material_count = count;
  return its;
}

struct Texts {
  std::string parameters, digest;
};
Texts texts_of(const forceshade_mesh& mesh) {
  forceshade_subject made{};
  EXPECT_EQ(forceshade_mesh_new(&mesh, &made), FORCESHADE_OK) << forceshade_message();
  std::array<char, 256> parameters{}, digest{};
  EXPECT_EQ(forceshade_subject_text(made, FORCESHADE_PARAMETERS, parameters.data(), parameters.size(), nullptr), FORCESHADE_OK);
  EXPECT_EQ(forceshade_subject_text(made, FORCESHADE_DIGEST, digest.data(), digest.size(), nullptr), FORCESHADE_OK);
  EXPECT_EQ(forceshade_subject_free(made), FORCESHADE_OK);
  return {parameters.data(), digest.data()};
}

TEST(c_materials, are_those_of_the_mesh_or_of_each_triangle) {
  const Texts plain = texts_of(with_materials(nullptr, 0)), rough = texts_of(with_materials(kRoughAndStiff.data(), 1));
  EXPECT_EQ(plain.parameters, "sides front, shading none, stiffness 0.5 N/mm");
  EXPECT_EQ(rough.parameters, plain.parameters + ", contact friction, friction 0.5, 0.25");
  EXPECT_NE(rough.digest, plain.digest);
  forceshade_mesh mesh = with_materials(kRoughAndStiff.data(), 2);
  mesh.material_of_triangle = kSecondAtTheEnd.data();
  const Texts two = texts_of(mesh);
  EXPECT_EQ(two.parameters, plain.parameters + ", contact friction, friction up to 0.5, materials 2");
  EXPECT_NE(two.digest, texts_of(with_materials(kRoughAndStiff.data(), 2)).digest);
  mesh = with_materials(nullptr, 0);
  mesh.contact = "friction";
  EXPECT_EQ(texts_of(mesh).parameters, plain.parameters + ", contact friction");
}

TEST(c_materials, are_not_read_from_the_struct_of_a_program_that_was_built_before_there_were_any) {
  forceshade_mesh before = with_materials(reinterpret_cast<const forceshade_material*>(1), 7);
  before.size = offsetof(forceshade_mesh, materials);
  EXPECT_EQ(texts_of(before).digest, texts_of(with_materials(nullptr, 0)).digest);
  EXPECT_EQ(texts_of(before).parameters, texts_of(with_materials(nullptr, 0)).parameters);
}

TEST(c_materials, may_be_longer_than_this_header_has_them) {
  struct Longer {
    forceshade_material known;
    std::array<float, 4> unknown;
  };
  std::array<Longer, 2> longer{};
  for (std::size_t i = 0; i < 2; ++i) {
    longer[i].known = kRoughAndStiff[i];
    longer[i].known.size = sizeof(Longer);
  }
  EXPECT_EQ(texts_of(with_materials(&longer[0].known, 2)).digest, texts_of(with_materials(kRoughAndStiff.data(), 2)).digest);
  longer[1].known.size = sizeof(forceshade_material);  // all are as long as the first says
  const forceshade_mesh mesh = with_materials(&longer[0].known, 2);
  forceshade_subject made{};
  EXPECT_EQ(forceshade_mesh_new(&mesh, &made), FORCESHADE_BAD_SIZE);
  EXPECT_EQ(std::string(forceshade_message()), "forceshade_material.size is " + std::to_string(sizeof(forceshade_material)) +
                                                   "; expected sizeof(forceshade_material), " + std::to_string(sizeof(Longer)));
}

TEST(c_materials, that_are_wrong_are_refused_in_words) {
  using Change = std::function<void(forceshade_mesh&, forceshade_material&)>;
  const auto expect = [](forceshade_result result, const std::string& words, const Change& change) {
    forceshade_material material = kRoughAndStiff[0];
    forceshade_mesh mesh = with_materials(&material, 1);
    change(mesh, material);
    forceshade_subject made{};
    EXPECT_EQ(forceshade_mesh_new(&mesh, &made), result) << words;
    EXPECT_NE(std::string(forceshade_message()).find(words), std::string::npos) << forceshade_message();
    EXPECT_EQ(made.handle, 0U);
  };
  expect(FORCESHADE_NULL_POINTER, "mesh->materials is NULL", [](auto& mesh, auto&) { mesh.materials = nullptr; });
  expect(FORCESHADE_BAD_SIZE, "forceshade_material.size is 8", [](auto&, auto& one) { one.size = 8; });
  expect(FORCESHADE_BAD_SIZE, "forceshade_mesh.size", [](auto& mesh, auto&) { mesh.size -= 8; });
  expect(FORCESHADE_BAD_VALUE, "infinite, is -1; expected", [](auto&, auto& one) { one.static_friction = -1; });
  expect(FORCESHADE_BAD_VALUE, "infinite, is nan", [](auto&, auto& one) { one.dynamic_friction = std::nanf(""); });
  expect(FORCESHADE_BAD_VALUE, "dynamic coefficient of friction is 1", [](auto&, auto& one) { one.dynamic_friction = 1; });
  expect(FORCESHADE_BAD_VALUE, "stiffness is -1", [](auto&, auto& one) { one.stiffness = -1; });
  expect(FORCESHADE_BAD_VALUE, "another contact rule than friction", [](auto& mesh, auto&) { mesh.contact = "direct"; });
  expect(FORCESHADE_BAD_VALUE, "number of a material is 1",
         [](auto& mesh, auto&) { mesh.material_of_triangle = kSecondAtTheEnd.data(); });
}

}  // namespace
}  // namespace forceshade
