// SPDX-License-Identifier: BSD-3-Clause
// Friction in real time: the reference on random meshes with random materials, stiffnesses, and where a slip ends.

#include <cmath>

#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

constexpr float kStiffness = 0.3F;  // N/mm

MeshRendering with_friction(MeshRendering rendering, mesh::Materials materials, mesh::Shading shading) {
  rendering.shading = shading;
  rendering.contact = mesh::Contact::friction;
  rendering.materials = std::move(materials);
  return rendering;
}

TEST(mesh_friction, is_the_reference_in_every_bit_on_random_meshes_with_random_materials) {
  tests::Occasions occasions;
  tests::expect_reference(
      132, 250, occasions,
      [](tests::MeshSource& source, const tests::RandomMesh& made, mesh::Shading shading) {
        return with_friction(tests::shaded(made.mesh, source.normals_of(made.mesh), made.sides, kStiffness),
                             source.materials_of(made.mesh), shading);
      },
      [&](const tests::ComparedTick& tick) {
        const fast::Mesh& mesh = tick.both.mesh();
        const bool was_touching = fast::is_touching(fast::grid_point_of(mesh, tick.before));
        const mesh::Tick direct = fast::step(mesh, tick.before, tick.position, kStiffness, tick.rendering.shading);
        occasions["friction keeps it back"] += was_touching && !(direct.after == tick.expected.after);
        occasions["held"] += was_touching && tick.expected.moves == 0 && direct.moves > 0;
        occasions["slips no more"] += tick.before.is_slipping && !tick.expected.after.is_slipping;
      });
  occasions.expect_all({"friction keeps it back", "held", "slipping", "slips no more", "decided in binary64",
                        "decided in wide numbers", "free", "touching", "invalid"});
}

TEST(mesh_friction, faces_without_a_stiffness_have_that_of_the_god_object_also_where_others_have_one) {
  const auto with_stiffness = [](float stiffness) {
    const std::array<mesh::Normal, 3> up{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
    MeshRendering rendering = tests::shaded({{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 2, 3}}}, {up, up},
                                            mesh::Sides::both, stiffness);
    rendering.materials = {{{2.0F, 0, 0}, {}}, {0, 1}};
    return tests::built(fast::GodObject::build(rendering));
  };
  // In the first face, on the edge between them, and in the second.
  const auto forces = [](const fast::GodObject& god_object) {
    std::vector<float> forces;
    for (const std::array<float, 2> at : {std::array{6.0F, 2.0F}, {4.0F, 4.0F}, {2.0F, 6.0F}}) {
      const auto session = god_object.open();
      session->tick({at[0], at[1], 1});
      forces.push_back(session->tick({at[0], at[1], -1}).force[2]);
    }
    return forces;
  };
  EXPECT_EQ(forces(with_stiffness(0.5F)), (std::vector{2.0F, 2.0F, 0.5F}));
  EXPECT_EQ(forces(tests::built(with_stiffness(0.5F).with_stiffness(4))), (std::vector{2.0F, 4.0F, 4.0F}));
}

// A gutter along x, rough up to x = 8 and smooth beyond. A hand that is 8 mm deep and pulls by 8 mm lets the god-object slip by
// half of that, from x = 4 just to the end of the rough edge. That is not inside the edge, so that it goes on, over the smooth
// one.
TEST(mesh_friction, a_slip_that_ends_where_the_edge_does_goes_on) {
  const mesh::TriangleMesh gutter{
      {{0, 0, 0}, {8, 0, 0}, {16, 0, 0}, {0, 9, 9}, {8, 9, 9}, {16, 9, 9}, {0, -9, 9}, {8, -9, 9}, {16, -9, 9}},
      {{0, 1, 4}, {0, 4, 3}, {1, 0, 6}, {1, 6, 7}, {1, 2, 5}, {1, 5, 4}, {2, 1, 7}, {2, 7, 8}}};
  const std::vector<mesh::Material> list{{{}, 0.5F, 0.5F}, {}};
  for (const int number : {0, 1, 2, 3}) {
    const bool is_mirrored = number % 2 == 1;
    const std::uint32_t beyond = number < 2 ? 1 : 0;  // the material there
    const mesh::Materials materials{list, {0, 0, 0, 0, beyond, beyond, beyond, beyond}};
    mesh::TriangleMesh mesh = gutter;
    for (mesh::Vertex& v : mesh.vertices)
      if (is_mirrored) v[0] = 16 - v[0];
    for (mesh::Triangle& triangle : mesh.triangles)
      if (is_mirrored) std::swap(triangle[1], triangle[2]);
    tests::BothSides both(with_friction(tests::unshaded(mesh, mesh::Sides::both), materials, mesh::Shading::none));
    for (const auto& [x, z] : {std::pair{4.0F, 1.0F}, {4.0F, -8.0F}, {12.0F, -8.0F}})
      both.step({is_mirrored ? 16 - x : x, 0, z});
    EXPECT_EQ(both.state().place, beyond == 1 ? mesh::Place::edge : mesh::Place::vertex);
    EXPECT_EQ(both.state().index[0], 1U);
  }
}

TEST(mesh_friction, is_refused_where_it_is_not_defined) {
  MeshRendering rendering = tests::shaded({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
                                          {{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}}, mesh::Sides::both, kStiffness);
  const auto message = [&](mesh::Material material, mesh::Contact contact = mesh::Contact::friction) {
    rendering.contact = contact;
    rendering.materials = {{material}, {}};
    const auto built = fast::GodObject::build(rendering);
    const auto* error = std::get_if<ParameterError>(&built);
    return error == nullptr ? std::string() : error->message();
  };
  EXPECT_EQ(message({{}, 0.3F, 0.3F}), "");
  EXPECT_EQ(message({{}, HUGE_VALF, 0}), "");
  EXPECT_NE(message({{}, 0.3F, 0.4F}), "") << "dynamic above static";
  EXPECT_NE(message({{}, -0.3F, -0.4F}), "");
  EXPECT_NE(message({{}, 0x1p-11F, 0}), "");
  EXPECT_NE(message({{}, NAN, 0}), "");
  EXPECT_NE(message({{}, 0.3F, 0.3F}, mesh::Contact::direct), "");
  EXPECT_NE(message({{}, 0.3F, 0.3F}, mesh::Contact::sub_goal), "");
  EXPECT_NE(message({1e6F, 0, 0}), "") << "stiffness";
  EXPECT_EQ(message({2.0F, 0, 0}, mesh::Contact::direct), "");
}

}  // namespace
}  // namespace forceshade
