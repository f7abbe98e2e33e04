// SPDX-License-Identifier: BSD-3-Clause
// The defects of tests/conformance/planted_defects.md that are those of a renderer, each in this program's own: what finds it,
// and that nothing else does. The page says of each in which thread somebody met it.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "properties/conformance/conform.h"
#include "properties/conformance/judgement_text.h"
#include "rendering/meshes/make.h"
#include "tests/conformance/own_renderer.h"

namespace forceshade::conformance {
namespace {

using Eigen::Vector3f;
using Names = std::set<std::string>;

const std::string kExact = "exact", kTwice = "the same path twice gives the same bits", kFresh = "a reset equals a fresh start",
                  kRest = "a hand at rest feels a force at rest", kFinite = "any position gets a finite force",
                  kOdd = "an odd position leaves nothing behind", kLost = "without a position there is no force after 10 ms",
                  kAir = "no force out of contact",
                  kAttracts = "the surface does not attract: the first force of a contact opposes the hand",
                  kEnergy = "a closed path gives no more energy than declared", kPushes = "contact gives a force",
                  kJump = "no jump goes through a plate", kFlat = "a flat plate feels flat however it is triangulated",
                  kNumbers = "triangles and vertices in another order give the same",
                  kTurned = "a quarter turn of the scene about z turns the force",
                  kMirrored = "a mirrored scene mirrors the force", kMeet = "nothing passes where faces meet",
                  kOne = "faces that coincide feel like one", kWhole = "a split face feels like the whole",
                  kAsDefined = "where faces meet the force is that of the definition";

const Description kWall{"wall", DescribedLaw{LawId::wall, {.stiffness = 0.75F}}};
const Description kCylinder{"cylinder", DescribedLaw{LawId::cylinder, {15.24F, 25.4F, 0.5F}}};

MeshRendering rendering_of_mesh(mesh::TriangleMesh mesh) {
  return {std::get<mesh::CheckedMesh>(mesh::check_any(std::move(mesh))), {}, mesh::Sides::front, mesh::Shading::none, 0.5F};
}

Description ball(std::uint32_t frequency = 3) {
  return {"ball", rendering_of_mesh(mesh::icosphere(frequency, 20))};
}

Description shaded_ball() {
  MeshRendering rendering = rendering_of_mesh(mesh::icosphere(3, 20));
  rendering.shading = mesh::Shading::vertex_scheme;
  rendering.normals = mesh::corner_normals(rendering.checked).normals;
  return {"shaded ball", rendering};
}

// Without a plane of symmetry.
Description odd_tetrahedron() {
  return {"odd tetrahedron",
          rendering_of_mesh({{{0, 0, 0}, {50, 3, 2}, {7, 31, -4}, {11, 5, 23}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})};
}

// The failures: kExact and names of invariants.
Names failures(const Description& scene, const Spoiler& spoiler, const Tolerance& tolerance = {}, std::uint64_t points = 3000) {
  const Conformance its = conform(scene, own_renderer(scene, spoiler), {.points = points, .tolerance = tolerance});
  EXPECT_FALSE(its.failure) << *its.failure;
  Names names;
  if (its.judgement.all.beyond > 0) names.insert(kExact);
  for (const Invariant& invariant : its.invariants)
    if (invariant.violation) names.insert(invariant.name);
  EXPECT_EQ(names.empty(), its.held());
  return names;
}

// A change of each force, by a renderer that claims the definition.
Spoiler by(const Spoil& spoil) {
  return [=](Description&, Json&) { return spoil; };
}

// The same by one that does not, so that what needs no definition has to find it.
Spoiler unclaimed(const std::function<Spoil(const Description& scene)>& spoil) {
  return [=](Description& scene, Json& hello) {
    hello["claims"] = "invariants";
    return spoil(scene);
  };
}

bool is_contact(const Vector3f& force) {
  return !force.isZero(0);
}

const mesh::TriangleMesh& mesh_of(const Description& scene) {
  return std::get<MeshRendering>(scene.what).mesh();
}

Vector3f vertex_of(const Description& scene, std::uint32_t index) {
  return Vector3f(mesh_of(scene).vertices[index].data());
}

TEST(planted_defect, number_1_a_tie_is_rounded_to_the_wrong_neighbour) {
  const Spoiler spoiler = by([](const Vector3f& position, Vector3f& force, bool) {
    const double exact = -0.75 * static_cast<double>(position.z()), rounded = static_cast<double>(force.z());
    const float other = std::nextafter(force.z(), exact > rounded ? std::numeric_limits<float>::infinity() : 0.0F);
    if (exact != rounded && exact - rounded == static_cast<double>(other) - exact) force.z() = other;
  });
  EXPECT_EQ(failures(kWall, spoiler), Names{kExact});
  EXPECT_EQ(failures(kWall, spoiler, {Unit::ulp, 1}), Names{});
}

TEST(planted_defect, number_2_the_end_of_an_interval_belongs_to_no_side) {
  EXPECT_EQ(failures(kWall, by([](const Vector3f& position, Vector3f& force, bool) {
                       if (position.z() == -0x1p-30F) force.setZero();
                     })),
            Names{kExact});
}

TEST(planted_defect, number_3_large_coordinates_lose_digits) {
  EXPECT_EQ(failures(kWall, by([](const Vector3f& position, Vector3f& force, bool) {
                       if (is_contact(force)) force.z() = -0.75F * ((1e6F + position.z()) - 1e6F);
                     })),
            Names{kExact});
}

TEST(planted_defect, number_4_not_a_number_passes_a_comparison) {
  EXPECT_EQ(failures(kWall, by([](const Vector3f& position, Vector3f& force, bool) {
                       if (std::isnan(position.z())) force.z() = position.z();
                     })),
            (Names{kExact, kFinite, kLost}));
}

TEST(planted_defect, number_5_memory_to_which_nothing_was_written) {
  int openings = 0;
  EXPECT_EQ(failures(kWall, unclaimed([&openings](const Description&) {
                       return
                           [garbage = 1e-6F * static_cast<float>(++openings)](const Vector3f&, Vector3f& force, bool is_first) {
                             if (is_first) force.y() = garbage;
                           };
                     })),
            (Names{kFresh, kAir}));
}

// To the nearest inner edge, so that it is no other where the scene is turned, mirrored or renumbered.
TEST(planted_defect, number_6_the_inner_edge_of_a_flat_surface_pushes) {
  EXPECT_EQ(failures(ball(), unclaimed([](const Description& scene) {
                       return [scene](const Vector3f& position, Vector3f& force, bool) {
                         if (!position.allFinite() || !is_contact(force) || mesh_of(scene).vertices.front()[2] != 0) return;
                         for (const mesh::Triangle& triangle : mesh_of(scene).triangles)
                           for (std::size_t i = 0; i < 3; ++i) {
                             const Vector3f a = vertex_of(scene, triangle[i]),
                                            along = (vertex_of(scene, triangle[(i + 1) % 3]) - a);
                             const Vector3f from = position - a, off = from - from.dot(along) / along.squaredNorm() * along;
                             if (off.head<2>().norm() < 0.2F) {
                               force.head<2>() -= 0.1F * off.head<2>();
                               return;
                             }
                           }
                       };
                     })),
            (Names{kFlat, kJump, kOne}));
}

TEST(planted_defect, number_7_one_triangle_of_a_hundred_thousand_is_not_found) {
  const Description scene = ball(71);
  const auto& triangle = mesh_of(scene).triangles[54321];
  const Vector3f middle = (vertex_of(scene, triangle[0]) + vertex_of(scene, triangle[1]) + vertex_of(scene, triangle[2])) / 3;
  EXPECT_GT(mesh_of(scene).triangles.size(), 100'000U);
  EXPECT_EQ(failures(scene, by([middle](const Vector3f& position, Vector3f& force, bool) {
                       if ((position - middle).norm() < 0.6F && position.cross(middle).norm() / middle.norm() < 0.02F)
                         force.setZero();
                     }),
                     {}, 100),
            Names{kExact});
}

TEST(planted_defect, number_8_the_corners_are_read_the_other_way_round) {
  EXPECT_EQ(failures(odd_tetrahedron(),
                     [](Description& scene, Json&) {
                       auto& its = std::get<MeshRendering>(scene.what);
                       mesh::TriangleMesh mesh = its.mesh();
                       for (mesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
                       its.checked = rendering_of_mesh(std::move(mesh)).checked;
                       return Spoil();
                     }),
            (Names{kExact, kAir, kPushes, kFlat, kJump, kMeet, kWhole, kAsDefined}));
}

TEST(planted_defect, number_9_equal_vertices_are_taken_for_different_ones) {
  EXPECT_EQ(failures(ball(), unclaimed([](const Description& scene) {
                       return [scene](const Vector3f& position, Vector3f& force, bool) {
                         const auto& vertices = mesh_of(scene).vertices;
                         if (!position.allFinite() || !is_contact(force) || vertices.front()[2] != 0) return;
                         for (std::uint32_t i = 0; i < vertices.size(); ++i)
                           if ((vertex_of(scene, i) - position).head<2>().norm() < 0.8F) force *= 1.2F;
                       };
                     })),
            (Names{kFlat, kJump, kWhole}));
}

// The cross product of two edges, of the size that the mesh's triangles have on the average.
TEST(planted_defect, number_10_a_normal_is_not_of_unit_length) {
  EXPECT_EQ(failures(ball(), unclaimed([](const Description& scene) {
                       float area = 0;
                       for (const mesh::Triangle& triangle : mesh_of(scene).triangles)
                         area += (vertex_of(scene, triangle[1]) - vertex_of(scene, triangle[0]))
                                     .cross(vertex_of(scene, triangle[2]) - vertex_of(scene, triangle[0]))
                                     .norm();
                       area = std::round(area / static_cast<float>(mesh_of(scene).triangles.size()));
                       return [area](const Vector3f&, Vector3f& force, bool) { force *= area; };
                     })),
            (Names{kFlat, kJump, kOne, kWhole}));
}

TEST(planted_defect, number_11_weights_are_applied_to_the_wrong_corners) {
  EXPECT_EQ(failures(shaded_ball(),
                     [](Description& scene, Json&) {
                       for (auto& corners : std::get<MeshRendering>(scene.what).normals)
                         std::ranges::rotate(corners, corners.begin() + 1);
                       return Spoil();
                     }),
            (Names{kExact, kMirrored}));
}

// The nearest point of a ball, and not the one on the side from which the hand came.
TEST(planted_defect, number_12_a_body_is_pierced) {
  EXPECT_EQ(failures(ball(),
                     [](Description&, Json&) -> Spoil {
                       return [from = Vector3f(0, 0, 0)](const Vector3f& position, Vector3f& force, bool) mutable {
                         if (is_contact(force) && position.dot(from) < 0) force = -force;
                         if (!is_contact(force)) from = position;
                       };
                     }),
            (Names{kExact, kFlat, kJump, kMeet, kAsDefined}));
}

TEST(planted_defect, number_13_the_force_depends_on_the_order_of_triangles) {
  EXPECT_EQ(failures(ball(), unclaimed([](const Description& scene) {
                       const bool is_other = mesh_of(scene).triangles[0][0] != mesh_of(ball()).triangles[0][0];
                       return [is_other](const Vector3f&, Vector3f& force, bool) {
                         if (is_other) force *= 1.01F;
                       };
                     })),
            Names{kNumbers});
}

TEST(planted_defect, number_14_the_last_force_stays_after_the_contact) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [last = Vector3f(0, 0, 0)](const Vector3f&, Vector3f& force, bool is_first) mutable {
                         if (is_first || is_contact(force)) last = force;
                         force = last;
                       };
                     })),
            (Names{kAir, kLost}));
}

TEST(planted_defect, number_15_a_reset_forgets_a_part_of_the_state) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [softer = 1.0F](const Vector3f&, Vector3f& force, bool is_first) mutable {
                         if (is_first) softer *= 0.9999F;
                         force *= softer;
                       };
                     })),
            (Names{kTwice, kFresh, kOdd, kMirrored}));
}

TEST(planted_defect, number_16_the_first_tick_after_a_reset_comes_from_the_old_place) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [last = Vector3f(0, 0, 0)](const Vector3f&, Vector3f& force, bool is_first) mutable {
                         const Vector3f right = force;
                         if (is_first) force = last;
                         last = right;
                       };
                     })),
            (Names{kTwice, kFresh, kMirrored}));
}

TEST(planted_defect, number_17_a_force_at_rest_drifts) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [before = Vector3f(0, 0, 0), ticks = 0](const Vector3f& position, Vector3f& force, bool) mutable {
                         ticks = position == before ? ticks + 1 : 0;
                         before = position;
                         force *= 1 + 1e-7F * static_cast<float>(ticks);
                       };
                     })),
            Names{kRest});
}

TEST(planted_defect, number_19_two_threads_share_a_force) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [answers = 0](const Vector3f&, Vector3f& force, bool) mutable {
                         if (++answers % 101 == 0) force.z() = 0;
                       };
                     })),
            (Names{kTwice, kFresh, kRest, kOdd, kMirrored}));
}

TEST(planted_defect, number_20_the_force_has_the_wrong_sign) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [](const Vector3f&, Vector3f& force, bool) { force = -force; };
                     })),
            Names{kAttracts});
}

TEST(planted_defect, number_21_a_unit_is_another_one) {
  EXPECT_EQ(failures(kWall, by([](const Vector3f&, Vector3f& force, bool) { force /= 1000; })), Names{kExact});
}

TEST(planted_defect, number_22_degrees_are_taken_for_radians) {
  EXPECT_EQ(failures(kCylinder, by([](const Vector3f&, Vector3f& force, bool) {
                       const float degrees = std::atan2(force.x(), force.z()) * 57.29578F, size = force.norm();
                       if (is_contact(force)) force = {size * std::sin(degrees), 0, size * std::cos(degrees)};
                     })),
            (Names{kExact, kAttracts}));
}

TEST(planted_defect, number_23_the_frame_is_left_handed) {
  EXPECT_EQ(failures(odd_tetrahedron(),
                     [](Description& scene, Json&) {
                       auto& its = std::get<MeshRendering>(scene.what);
                       mesh::TriangleMesh mesh = its.mesh();
                       for (mesh::Vertex& vertex : mesh.vertices) vertex[1] = -vertex[1];
                       for (mesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
                       its.checked = rendering_of_mesh(std::move(mesh)).checked;
                       return Spoil();
                     }),
            (Names{kExact, kPushes}));
}

TEST(planted_defect, number_25_a_decimal_comma_ends_a_number) {
  EXPECT_EQ(failures(kWall, by([](const Vector3f&, Vector3f& force, bool) { force *= 0; })), (Names{kExact, kPushes}));
}

TEST(planted_defect, number_26_gravity_is_compensated_with_another_gravity) {
  EXPECT_EQ(failures(kWall, unclaimed([](const Description&) {
                       return [](const Vector3f&, Vector3f& force, bool) { force.z() -= 0.05F; };
                     })),
            (Names{kAir, kLost, kAttracts}));
}

// Five of the laws are active: the definition itself gives energy, and who renders it gives as much.
TEST(planted_defect, none_is_a_law_that_gives_energy_itself) {
  constexpr const char* kAdvice = "the definition itself gives ";
  int active = 0;
  for (const LawName& law : kLaws) {
    const Description scene{std::string(law.name), DescribedLaw{law.id, {15.24F, 25.4F, 0.5F}}};
    const auto declared = [](const char* claims, float more) {
      return [=](Description&, Json& hello) -> Spoil {
        hello["claims"] = claims;
        hello["loop_energy_mJ"] = 0;
        return [=](const Vector3f&, Vector3f& force, bool) { force.x() *= more; };
      };
    };
    EXPECT_EQ(failures(scene, declared("definition", 1)), Names{}) << law.name;
    const Conformance its = conform(scene, own_renderer(scene, declared("invariants", 1)), {.points = 100});
    const auto energy = std::ranges::find(its.invariants, kEnergy, &Invariant::name);
    ASSERT_NE(energy, its.invariants.end());
    if (!energy->violation) continue;
    ++active;
    EXPECT_NE(energy->violation->find(kAdvice), std::string::npos) << *energy->violation;
    EXPECT_TRUE(failures(scene, declared("definition", 1.5F)).contains(kEnergy)) << law.name << " gives more than it has to";
  }
  EXPECT_EQ(active, 5);
}

// Beside those of the page: it pushes more on the way out than on the way in.
TEST(planted_defect, that_gives_energy_over_a_closed_path) {
  EXPECT_EQ(failures(kWall,
                     [](Description&, Json& hello) -> Spoil {
                       hello["claims"] = "invariants";
                       hello["loop_energy_mJ"] = 0;
                       return [before = 0.0F](const Vector3f& position, Vector3f& force, bool is_first) mutable {
                         if (!is_first && position.z() > before) force *= 1.1F;
                         before = position.z();
                       };
                     }),
            Names{kEnergy});
}

}  // namespace
}  // namespace forceshade::conformance
