// SPDX-License-Identifier: BSD-3-Clause
// A certificate says whose renderer was compared. A program's is right here, and permits no driving all the same: it is not
// what drive would run.

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>

#include "forceshade/certify.h"
#include "forceshade/properties.h"
#include "properties/scene_subject.h"
#include "tests/meshes/rendering.h"
#include "tests/properties/subject_wrapper.h"

namespace forceshade::properties {
namespace {

using Shared = std::shared_ptr<const Subject>;

constexpr Parameters kWall{.stiffness = 0.5F};
const HeightMap kPlane{{{height::Plane{0.25F, 0.125F, 1}}}};

Certificate compared(const Shared& subject) {
  static const std::atomic<bool> never{false};
  return certify(
             {.subjects = {subject}, .points = 100, .cases = 10, .threads = 2}, [](std::string_view, double) {}, never)
      .value();
}

Renderer wall_of_library(LawId law, const Parameters& parameters) {
  return renderer_of(std::get<fast::Law>(fast::Law::build(law, parameters)));
}

Rendered wall_of_program(const Eigen::Vector3f& p) {
  const auto session = wall_of_library(LawId::wall, kWall).open();
  const fast::Evaluation answer = session->step(p);
  return {answer.force, answer.status};
}

Rendered plane_of_program(const Eigen::Vector3f& p) {
  const auto field = std::get<fast::HeightMapField>(fast::HeightMapField::build(kPlane, height::Mode::true_height, 0.5F));
  const fast::Evaluation answer = field.evaluate(p);
  return {answer.force, answer.status};
}

MeshRendering tetrahedron() {
  return tests::unshaded({{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}},
                         mesh::Sides::front);
}

std::unique_ptr<Subject> scene_of(const Shared& wall) {
  const auto at_rest = std::make_shared<const scene::Motion>(scene::Motion{{scene::Pose{}}, false});
  return std::make_unique<SceneSubject>(Identity{kSceneKind, "s.toml", {}, std::string(64, 'e')},
                                        std::vector<MovingSubject>{{"wall", wall, at_rest}}, 1000);
}

// Every way to a subject that the headers offer, with the library's own renderer or with another.
std::map<std::string, Shared> subjects_of(RenderedBy who) {
  const MeshRendering mesh = tetrahedron();
  const height::Mode mode = height::Mode::true_height;
  std::map<std::string, Shared> all;
  if (who == RenderedBy::library) {
    all["law"] = law_subject(LawId::wall, kWall);
    all["map"] = height_map_subject("map.toml", kPlane, mode, 0.5F);
    all["mesh"] = mesh_subject("mesh.off", mesh);
    all["scene"] = scene_of(all["law"]);
    return all;
  }
  all["a law by a function"] = law_subject(LawId::wall, kWall, &wall_of_program);
  all["a law by a renderer"] = law_subject(LawId::wall, kWall, &wall_of_library);
  all["a map by a function"] = height_map_subject("map.toml", kPlane, mode, 0.5F, &plane_of_program);
  all["a map by a renderer"] =
      height_map_subject("map.toml", kPlane, mode, 0.5F, [](const HeightMap& map, height::Mode how, float stiffness) {
        return renderer_of(std::get<fast::HeightMapField>(fast::HeightMapField::build(map, how, stiffness)));
      });
  all["a mesh by its sessions"] = mesh_subject("mesh.off", mesh, [mesh](float stiffness) {
    MeshRendering its = mesh;
    its.stiffness = stiffness;
    return std::get<fast::GodObject>(fast::GodObject::build(its)).open();
  });
  const Shared law = law_subject(LawId::wall, kWall);
  all["a subject of its own that forwards all"] = std::make_shared<tests::SubjectWrapper>(law);
  all["a scene of one such object"] = scene_of(std::make_shared<tests::SubjectWrapper>(law));
  all["a scene of an object by a renderer"] = scene_of(law_subject(LawId::wall, kWall, &wall_of_library));
  return all;
}

TEST(own_renderer, is_in_the_certificate_whichever_way_it_was_handed_over) {
  for (const RenderedBy who : {RenderedBy::library, RenderedBy::program})
    for (const auto& [way, subject] : subjects_of(who)) {
      const Certificate made = compared(subject), read = from_json(to_json(made), "here.json");
      EXPECT_TRUE(made.held()) << way;
      EXPECT_EQ(made.subjects.at(0).rendered_by, who) << way;
      EXPECT_EQ(read.subjects.at(0).rendered_by, who) << way;
      const std::string said = refusal(read, current_build(), subject->identity()).value_or("allowed");
      const std::string words = who == RenderedBy::program ? "the certificate is of a program's own renderer for "
                                                           : "the certificate has 100 points for ";
      EXPECT_TRUE(said.starts_with(words)) << way << ": " << said;
    }
}

}  // namespace
}  // namespace forceshade::properties
