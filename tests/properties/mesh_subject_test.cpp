// SPDX-License-Identifier: BSD-3-Clause
// A god-object as a subject: every property holds of the fast path on every family of meshes, and renderers that are wrong in
// one way each are found by the property that is for it.

#include "properties/mesh_subject.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "forceshade/properties.h"
#include "properties/mesh_properties.h"
#include "tests/meshes/rendering.h"
#include "tests/support/drawn.h"
#include "tests/support/mesh_source.h"

namespace forceshade::properties {
namespace {

MeshRendering rendering_of(tests::MeshSource& source, std::size_t family, mesh::Shading shading,
                           mesh::Contact contact = mesh::kUsualContact) {
  tests::RandomMesh random = source.of_family(family);
  MeshRendering rendering{tests::checked(std::move(random.mesh)), {}, random.sides, shading, 0.3F};
  rendering.contact = contact;
  if (contact == mesh::Contact::friction) rendering.materials = source.materials_of(rendering.mesh());
  if (rendering.has_corner_normals()) rendering.normals = source.normals_of(rendering.mesh());
  if (shading == mesh::Shading::texture_scheme)
    rendering.texture = {source.textures_of(rendering.mesh()),
                         {{{height::Grating{1, 0.5F, 0.75F, 0}}, {height::Cone{1, 2, 3, 4}}}}};
  return rendering;
}

void expect_every_property(mesh::Shading shading, mesh::Contact contact) {
  for (std::size_t family = 0; family < tests::kMeshFamilies.size(); ++family) {
    tests::MeshSource source(2026 + family);
    const MeshSubject subject(std::string(tests::kMeshFamilies[family]), rendering_of(source, family, shading, contact));
    for (const PropertyResult& result : run_properties(subject, static_cast<int>(tests::drawn(40)), 7))
      EXPECT_TRUE(result.held) << subject.identity().name << ", " << name_of(shading) << ", " << name_of(contact) << ", "
                               << result.name << ": " << result.counterexample;
  }
}

TEST(mesh_subject, has_every_property_on_every_family_of_meshes) {
  for (const mesh::Contact contact : {mesh::Contact::direct, mesh::Contact::friction})
    for (const mesh::Shading shading :
         {mesh::Shading::none, mesh::Shading::vertex_scheme, mesh::Shading::edge_scheme, mesh::Shading::texture_scheme})
      expect_every_property(shading, contact);
  for (const mesh::Shading shading : {mesh::Shading::none, mesh::Shading::vertex_scheme, mesh::Shading::texture_scheme})
    expect_every_property(shading, mesh::Contact::sub_goal);
}

// Rounded upwards, because less would not be enough.
TEST(mesh_subject, states_as_much_energy_of_the_shading_as_a_turn_can_give) {
  int rounded = 0;
  for (std::uint64_t seed = 1; seed <= tests::drawn(8); ++seed) {
    tests::MeshSource source(seed);
    const MeshRendering rendering = rendering_of(source, 7, mesh::Shading::vertex_scheme);
    double turn = 0;
    for (std::uint32_t i = 0; i < rendering.mesh().triangles.size(); ++i) turn = std::max(turn, largest_turn(rendering, i));
    const std::vector<std::string> parts = MeshSubject("star", rendering).parts();
    const std::string begin = "at a rest inside a triangle the shading gives at most ";
    ASSERT_TRUE(parts.at(1).starts_with(begin)) << parts[1];
    const double stated = std::stod(parts[1].substr(begin.size()));
    EXPECT_GE(stated, turn);
    EXPECT_LT(stated, turn + 1.0001e-4);
    rounded += stated > turn ? 1 : 0;
  }
  EXPECT_GT(rounded, 0);
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
  fast::Stage stage() const noexcept override { return right_->stage(); }
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
  tests::MeshSource source(11);
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
    if (now.status != Status::contact || before.after.place == mesh::Place::nowhere) return now;
    for (std::size_t i = 0; i < 3; ++i) now.force[i] = before.force[i] - 0.3F * p[i];
    return now;
  };
  EXPECT_EQ(failed([](const Tick&, Tick now, const MeshPosition&) { return now; }, mesh::Shading::none),
            std::set<std::string>{});
  EXPECT_EQ(failed(
                [](const Tick&, Tick now, const MeshPosition&) {
                  if (now.status == Status::contact) ++now.moves;
                  return now;
                },
                mesh::Shading::none),
            std::set<std::string>{"states"})
      << "it counts a move too many";
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

// A wrong tick that needs no others keeps none before those that lead to it.
TEST(mesh_subject, leaves_no_tick_of_a_path_that_the_failure_does_not_need) {
  tests::MeshSource source(11);
  const MeshRendering rendering = rendering_of(source, 7, mesh::Shading::none);
  const MeshSubject subject("star", rendering, [right = fast_god_object(rendering)](float stiffness) {
    return std::make_unique<Changed>(right(stiffness), [](const mesh::Tick&, mesh::Tick now, const MeshPosition&) {
      if (now.status == Status::contact) ++now.moves;
      return now;
    });
  });
  for (const std::uint64_t seed : {1U, 2U, 3U})
    for (const PropertyResult& result : run_properties(subject, 100, seed)) {
      EXPECT_EQ(result.held, result.name != "states") << result.name;
      if (!result.held) {
        const std::string& words = result.counterexample;
        EXPECT_TRUE(words.starts_with("tick 0 at ") || words.starts_with("tick 1 at ")) << words;
      }
    }
}

// Its bound is the root of 2 where a normal does not point to the front of its triangle.
TEST(mesh_subject, knows_the_largest_turn_of_a_triangle) {
  MeshRendering rendering = tests::shaded({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, mesh::Sides::front);
  const auto turn = [&](const mesh::Normal& a, const mesh::Normal& b, const mesh::Normal& c) {
    rendering.normals = {{a, b, c}};
    return largest_turn(rendering, 0);
  };
  EXPECT_NEAR(turn({0, 0, 1}, {0, 0, 1}, {0, 0, 1}), 0, 1e-14);
  EXPECT_NEAR(turn({0, 0, 1}, {0, 0.6F, 0.8F}, {0, 0, 1}), 2 * std::sin(std::asin(0.6) / 2), 1e-7);
  EXPECT_NEAR(turn({0, 0, 1}, {0, 0, 0}, {0, -0.6F, 0.8F}), 2 * std::sin(std::asin(0.6) / 2), 1e-7);
  EXPECT_EQ(turn({0, 0, 1}, {0, 1, 0}, {0, 0, 1}), std::numbers::sqrt2);
  EXPECT_EQ(turn({0, 0, 1}, {0, 0, -1}, {0, 0, 1}), std::numbers::sqrt2);
  // N between the corners' normals is never turned by more.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0, 1), side(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    std::array<mesh::Normal, 3> normals{};
    for (mesh::Normal& normal : normals) {
      const Eigen::Vector3d drawn = Eigen::Vector3d(side(random), side(random), 1).normalized();
      for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] = static_cast<float>(drawn[static_cast<Eigen::Index>(axis)]);
    }
    Eigen::Vector3d N(0, 0, 0);
    for (const mesh::Normal& normal : normals)
      N += share(random) * Eigen::Vector3f(normal[0], normal[1], normal[2]).cast<double>();
    EXPECT_LE((N.normalized() - Eigen::Vector3d::UnitZ()).norm(), turn(normals[0], normals[1], normals[2]));
  }
}

TEST(mesh_subject, identity_is_that_of_every_number) {
  tests::MeshSource source(5);
  const MeshRendering first = rendering_of(source, 7, mesh::Shading::vertex_scheme);
  const Identity its = identity_of("star.off", first);
  EXPECT_EQ(its.kind, kMeshKind);
  EXPECT_TRUE(its.is_same(identity_of("renamed.off", first)));
  const auto changed = [&](const std::function<void(MeshRendering&)>& change) {
    MeshRendering other = first;
    change(other);
    return !its.is_same(identity_of("star.off", other));
  };
  const auto changed_mesh = [&](const std::function<void(mesh::TriangleMesh&)>& change) {
    return changed([&](MeshRendering& r) {
      mesh::TriangleMesh other = r.mesh();
      change(other);
      r.checked = tests::checked(std::move(other));
    });
  };
  EXPECT_TRUE(changed_mesh([](mesh::TriangleMesh& m) { m.vertices[3][1] = std::nextafter(m.vertices[3][1], 9e3F); }));
  EXPECT_TRUE(changed_mesh([](mesh::TriangleMesh& m) { std::swap(m.triangles[0], m.triangles[1]); }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.normals[2][1][0] += 0x1p-20F; }));
  EXPECT_TRUE(
      changed([](MeshRendering& r) { r.sides = r.sides == mesh::Sides::both ? mesh::Sides::front : mesh::Sides::both; }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.shading = mesh::Shading::none; }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.stiffness = 0.5F; }));
  EXPECT_TRUE(changed([](MeshRendering& r) { r.contact = mesh::Contact::sub_goal; }));
}

TEST(mesh_subject, identity_is_that_of_every_number_of_a_texture) {
  tests::MeshSource source(5);
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
