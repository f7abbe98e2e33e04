// SPDX-License-Identifier: BSD-3-Clause
// Scenes of fixed objects: what each key means, that one unmoved object is its mesh, that objects keep their materials and
// their names in messages, and what is refused in which words.

#include <gtest/gtest.h>

#include <cmath>

#include "forceshade/error.h"
#include "forceshade/fast.h"
#include "forceshade/identity.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "subjects/file.h"
#include "subjects/scene.h"
#include "tests/subjects/scene_folder.h"

namespace forceshade::subjects {
namespace {

const MeshRendering& rendering_in(const Description& description) {
  return std::get<MeshRendering>(description.what);
}

using Scenes = SceneFolder;

const std::string kPlate = "[[object]]\nname = \"floor\"\nmesh = \"plate.off\"\nunit = \"mm\"\n",
                  kTetrahedron = "[[object]]\nname = \"corner\"\nmesh = \"its.obj\"\nunit = \"mm\"\n";

// The fast path's ticks at these positions in turn.
std::vector<mesh::Tick> ticks(const MeshRendering& rendering, const std::vector<std::array<float, 3>>& path) {
  const auto built = fast::GodObject::build(rendering);
  const auto session = std::get<fast::GodObject>(built).open();
  std::vector<mesh::Tick> all;
  for (const auto& position : path) all.push_back(session->tick(position));
  return all;
}

TEST_F(Scenes, of_one_unmoved_object_are_its_mesh) {
  struct Case {
    std::string scene;
    std::vector<Option> mesh;
  };
  folder.write("wheel.toml", "[[material]]\nname = \"a\"\nfriction = [0.5, 0.25]\nstiffness = 2\ngroups = [\"steel\"]\n");
  const std::vector<Case> cases{
      {"", {}},
      {"rotation = [1, 0, 0, 0]\ntranslation = [0, \"0mm\", 0]\n", {}},
      {"friction = 0\n", {}},
      {"friction = [0.4, 0.3]\n", {{"friction", "0.4,0.3"}}},
      {"materials = \"wheel.toml\"\n", {{"materials", folder.file("wheel.toml")}}},
  };
  for (const auto& [keys, options] : cases) {
    Options of_mesh{{"mesh", folder.file("its.obj")}, {"unit", "mm"}, {"stiffness", "0.25"}};
    for (const Option& one : options) of_mesh.add(one);
    const Description expected = read_one(of_mesh), got = read_scene_of(kTetrahedron + keys, {{"stiffness", "0.25"}});
    EXPECT_EQ(got.name, "table.toml");
    const Identity its = identity_of("", rendering_in(got)), other = identity_of("", rendering_in(expected));
    EXPECT_EQ(its.kind, kMeshKind);
    EXPECT_EQ(its.digest, other.digest) << keys;
    EXPECT_TRUE(its.has_parameters_of(other)) << parameters_in_words(its) << " / " << parameters_in_words(other);
    std::vector<std::array<float, 3>> path;
    for (int i = 0; i < 200; ++i)
      path.push_back(
          {static_cast<float>(3 + 2 * std::sin(i)), static_cast<float>(2 + 0.05 * i), static_cast<float>(i % 50 - 5)});
    const auto a = ticks(rendering_in(got), path), b = ticks(rendering_in(expected), path);
    int touching = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      EXPECT_EQ(a[i].force, b[i].force);
      EXPECT_EQ(a[i].after, b[i].after);
      touching += a[i].status == Status::contact ? 1 : 0;
    }
    EXPECT_GT(touching, 10);
  }
}

TEST_F(Scenes, have_their_objects_at_their_places_in_their_units) {
  folder.write("part.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const MeshRendering its = rendering_in(
      read_scene_of(kPlate + "[[object]]\nname = \"part\"\nmesh = \"part.off\"\nunit = \"in\"\nrotation = [1, 0, 0, 1]\n"
                             "translation = [\"1cm\", 2, \"-3in\"]\n"));
  EXPECT_EQ(its.mesh().triangles, (std::vector<mesh::Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}));
  const std::vector<mesh::Vertex> part(its.mesh().vertices.begin() + 4, its.mesh().vertices.end());
  const float depth = -76.2F, inch = 25.4F;
  EXPECT_EQ(part, (std::vector<mesh::Vertex>{{10, 2, depth}, {10, 2 + inch, depth}, {10 - inch, 2, depth}}));
  EXPECT_EQ(its.sides, mesh::Sides::both) << "a plate has a rim";
  EXPECT_EQ(its.shading, mesh::Shading::vertex_scheme);
  EXPECT_EQ(its.stiffness, 0.5F);
  EXPECT_EQ(its.materials, mesh::Materials{});
}

TEST_F(Scenes, have_the_options_of_a_mesh_in_the_file_or_beside_it) {
  const std::string keys =
      "sides = \"both\"\nshading = \"edge\"\ncontact = \"sub-goal\"\ncrease = \"90deg\"\nself-intersecting = true\n";
  const MeshRendering in_file = rendering_in(read_scene_of(keys + kTetrahedron));
  const MeshRendering beside = rendering_in(
      read_scene_of(kTetrahedron, {{"sides", "both"}, {"shading", "edge"}, {"contact", "sub-goal"}, {"crease", "90deg"}}));
  EXPECT_EQ(in_file.sides, mesh::Sides::both);
  EXPECT_EQ(in_file.shading, mesh::Shading::edge_scheme);
  EXPECT_EQ(identity_of("", in_file).digest, identity_of("", beside).digest);
  EXPECT_EQ(rendering_in(read_scene_of(kTetrahedron)).sides, mesh::Sides::front) << "it is closed";
  EXPECT_EQ(rendering_in(read_scene_of("contact = \"sub-goal\"\n" + kTetrahedron)).contact, mesh::Contact::sub_goal);
  // The crease decides the corner normals.
  EXPECT_NE(rendering_in(read_scene_of("crease = 20\n" + kTetrahedron)).normals,
            rendering_in(read_scene_of(kTetrahedron)).normals);
}

TEST_F(Scenes, let_each_object_feel_as_its_own_material) {
  const std::string second = "[[object]]\nname = \"ice\"\nmesh = \"plate.off\"\nunit = \"mm\"\ntranslation = [16, 0, 0]\n";
  const MeshRendering its = rendering_in(read_scene_of(
      "shading = \"none\"\n" + kPlate + "friction = [0.5, 0.25]\nstiffness = \"2N/mm\"\n" + second + "stiffness = 1\n"));
  EXPECT_EQ(its.contact, mesh::Contact::friction);
  EXPECT_EQ(its.materials.list, (std::vector<mesh::Material>{{2.0F, 0.5F, 0.25F}, {1.0F, 0, 0}}));
  EXPECT_EQ(its.materials.of_triangle, (std::vector<std::uint32_t>{0, 0, 1, 1}));
  // 1 mm deep and 0.25 mm aside: the rough one holds, with its stiffness; the smooth one follows, with its own.
  const std::vector<mesh::Tick> of_rough = ticks(its, {{1, 2, 1}, {1, 2, -1}, {1.25F, 2, -1}}),
                                of_smooth = ticks(its, {{17, 2, 1}, {17, 2, -1}, {17.25F, 2, -1}});
  EXPECT_EQ(of_rough.back().force, (std::array<float, 3>{-0.5F, 0, 2}));
  EXPECT_EQ(of_smooth.back().force, (std::array<float, 3>{0, 0, 1}));
  // The exact side has the same materials.
  const auto exact = reference::GodObject::build(its);
  reference::GodObjectSession session(std::get<reference::GodObject>(exact));
  for (const std::array<float, 3> position : {std::array<float, 3>{1, 2, 1}, {1, 2, -1}}) session.step(position);
  EXPECT_EQ(session.step({1.25F, 2, -1}).force, of_rough.back().force);
}

TEST_F(Scenes, let_each_object_limit_a_paths_damping) {
  const std::string second = "[[object]]\nname = \"dry\"\nmesh = \"plate.off\"\nunit = \"mm\"\ntranslation = [16, 0, 0]\n";
  const MeshRendering its = rendering_in(read_scene_of(kPlate + "drag = 0.001\n" + second + "damping = 0\n"));
  EXPECT_EQ(its.materials.list, (std::vector<mesh::Material>{{.damping = {HUGE_VALF, 0.001F}}, {.damping = {0, HUGE_VALF}}}));
  EXPECT_EQ(its.materials.of_triangle, (std::vector<std::uint32_t>{0, 0, 1, 1}));
  tests::expect_words(tests::thrown_by<Error>([&] { read_scene_of(kPlate + "materials = \"wheel.toml\"\ndrag = 0\n"); }),
                      {"drag: expected without materials, got both"});
}

TEST_F(Scenes, list_a_material_of_several_objects_once) {
  folder.write("wheel.toml", "[default]\nfriction = 0.5\n[[material]]\nname = \"a\"\nfriction = 0.25\ngroups = [\"steel\"]\n");
  const std::string far = "translation = [100, 0, 0]\n";
  const mesh::Materials mixed =
      rendering_in(
          read_scene_of(kPlate + "friction = 0.25\n" + kTetrahedron + far + "materials = \"wheel.toml\"\n" +
                        "[[object]]\nname = \"third\"\nmesh = \"plate.off\"\nunit = \"mm\"\ntranslation = [0, 0, -50]\n"))
          .materials;
  EXPECT_EQ(mixed.list, (std::vector<mesh::Material>{{{}, 0.25F, 0.25F}, {{}, 0.5F, 0.5F}, {}}));
  EXPECT_EQ(mixed.of_triangle, (std::vector<std::uint32_t>{0, 0, 1, 0, 0, 0, 2, 2}));
  const mesh::Materials same =
      rendering_in(read_scene_of(kPlate + "friction = 0.25\n" + kTetrahedron + far + "friction = 0.25\n")).materials;
  EXPECT_EQ(same, (mesh::Materials{{{{}, 0.25F, 0.25F}}, {}}));
}

TEST_F(Scenes, name_groups_by_their_objects) {
  folder.write("table.toml",
               kPlate + kTetrahedron + "translation = [100, 0, 0]\n" +
                   "[[object]]\nname = \"other\"\nmesh = \"its.obj\"\nunit = \"mm\"\ntranslation = [0, 100, 0]\n");
  const mesh::LoadedMesh loaded = load_scene({{"scene", folder.file("table.toml")}}).ground.loaded;
  constexpr std::uint32_t kNone = mesh::FaceNames::kNone;
  EXPECT_EQ(loaded.materials.names, (std::vector<std::string>{"corner/rubber", "corner/steel", "other/rubber", "other/steel"}));
  EXPECT_EQ(loaded.materials.of_triangle, (std::vector<std::uint32_t>{kNone, kNone, 0, 1, 1, 1, 2, 3, 3, 3}));
  EXPECT_EQ(loaded.groups.names, (std::vector<std::string>{"corner/tyre", "other/tyre"}));
  EXPECT_EQ(loaded.groups.of_triangle, (std::vector<std::uint32_t>{kNone, kNone, 0, 0, kNone, kNone, 1, 1, kNone, kNone}));
}

TEST_F(Scenes, are_written_as_they_are_read) {
  folder.write("table.toml", "sides = \"both\"\n" + kTetrahedron);
  const Options all{{"scene", folder.file("table.toml")}, {"shading", "edge"}, {"stiffness", "0.25"}};
  const std::string text = written_files(all).front();
  EXPECT_EQ(text, "scene = \"table.toml\"\nshading = \"edge\"\nstiffness = \"0.25N/mm\"\n");
  const Description again = read_text(text, folder.file("again.toml"));
  EXPECT_EQ(identity_of("", rendering_in(again)).digest, identity_of("", rendering_in(read_one(all))).digest);
  EXPECT_EQ(again.name, "table.toml");
  EXPECT_EQ(written_for_shell(all), "--scene " + folder.file("table.toml") + " --shading edge --stiffness 0.25N/mm");
}

// Faults that make the ground of a scene no regular mesh.
class ScenesWithFaults : public SceneFolder {
 protected:
  void expect_fault(const std::string& text, const std::string& words) {
    folder.write("table.toml", text);
    const Scene scene = load_scene({{"scene", folder.file("table.toml")}});
    const auto checked = mesh::check(scene.ground.loaded.mesh);
    ASSERT_TRUE(std::holds_alternative<mesh::Findings>(checked)) << text;
    const std::string found = scene.ground.words(std::get<mesh::Findings>(checked));
    EXPECT_NE(found.find(words), std::string::npos) << found;
  }
};

TEST_F(ScenesWithFaults, name_the_objects_that_meet) {
  const std::string other = "[[object]]\nname = \"ball\"\nmesh = \"its.obj\"\nunit = \"mm\"\ntranslation = [1, 0, -4]\n";
  expect_fault(kPlate + other,
               "object floor, face 0 (line 7), and object ball, face 1 (line 9), meet, but have no vertex in common\n");
  EXPECT_FALSE(rendering_in(read_scene_of(kPlate + other)).checked.is_regular());
  EXPECT_NO_THROW(read_scene_of("self-intersecting = true\n" + kPlate + "friction = 0.5\n" + other));
  // Touching is meeting, as of two plates with an edge in common.
  const std::string touching =
      kPlate + "[[object]]\nname = \"second\"\nmesh = \"plate.off\"\nunit = \"mm\"\ntranslation = [8, 0, 0]\n";
  expect_fault(touching,
               "object floor, face 0 (line 7), and object second, face 1 (line 8), meet, but have no vertex in common");
}

TEST_F(ScenesWithFaults, count_faces_and_vertices_as_the_file_of_the_object) {
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n");
  const std::string far = "translation = [0, 0, 50]\n",
                    flat = "[[object]]\nname = \"flat\"\nmesh = \"flat.obj\"\nunit = \"mm\"\n";
  expect_fault(kPlate + flat + far, "object flat: line 6: face 1 has no area: its vertices 0, 1 and 2 lie on a line\n");
  folder.write("fan.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 3 4\n");
  expect_fault(kPlate + "[[object]]\nname = \"fan\"\nmesh = \"fan.off\"\nunit = \"mm\"\n" + far,
               "object fan: lines 8 and 9: faces 0 and 1 meet at vertex 0, but no edges there lead from one to the other");
  expect_refusal(kPlate + kTetrahedron + "translation = [9995, 0, 0]\n",
                 "object corner: vertex 1 has a coordinate that is no number within 10000 mm");
  folder.write("many.obj", [] {
    std::string text;
    for (int i = 0; i < 25; ++i) {
      for (int k = 0; k < 3; ++k) text += "v " + std::to_string(k) + " 0 " + std::to_string(i) + "\n";
      text += "f -3 -2 -1\n";
    }
    return text;
  }());
  expect_fault(kPlate + "[[object]]\nname = \"many\"\nmesh = \"many.obj\"\nunit = \"mm\"\n" + far,
               "\nand 5 more of this kind\n");
}

TEST_F(Scenes, are_refused_with_file_line_and_value) {
  const auto expect = [&](const std::string& text, const std::string& words) { expect_refusal(text, "table.toml: " + words); };
  expect("", "expected an [[object]], got none");
  expect("sides = \"both\"\n", "expected an [[object]], got none");
  expect("object = 3\n", "line 1: object: expected [[object]], got 3");
  expect("[object]\nname = \"a\"\n", "line 1: object: expected [[object]], got a list or table");
  expect("[[object]]\n[[object]\n", "line 2: expected the name of a table");
  expect("moves = true\n" + kPlate, "line 1: unknown key moves; expected keys of a scene");
  expect("unit = \"mm\"\n" + kPlate, "line 1: unknown key unit; expected keys of a scene");
  expect("side = \"both\"\n" + kPlate, "line 1: unknown key side; expected keys of a scene; the nearest is sides");
  expect("objects = 3\n" + kPlate, "line 1: unknown key objects; expected keys of a scene; the nearest is object");
  expect("sides = \"back\"\n" + kPlate, "line 1: sides: expected one of front, both; got \"back\"");
  expect("shading = \"smooth\"\n" + kPlate, "line 1: shading: expected one of vertex");
  expect("shading = \"texture:map.toml\"\n" + kPlate,
         "line 1: shading: expected vertex, edge or none for a scene, got \"texture:");
  expect("contact = \"loose\"\n" + kPlate, "line 1: contact: expected one of direct");
  expect("crease = 200\n" + kPlate, "line 1: crease: expected an angle from 0 to 180 degrees, got \"200\"");
  expect("self-intersecting = 1\n" + kPlate, "line 1: self-intersecting: expected true or false, got 1");
  expect("[[object]]\nmesh = \"plate.off\"\nunit = \"mm\"\n", "line 1: [[object]]: expected a name, got none");
  expect("[[object]]\nname = 3\n", "line 2: name: expected a text in quotes, got 3");
  expect("[[object]]\nname = \"\"\n", "line 2: name: expected a text in quotes, got ");
  expect("[[object]]\nname = \"a/b\"\n",
         "line 2: name: expected a name without /, which stands in front of the names of groups, got \"a/b\"");
  expect("[[object]]\nname = \"a\\u001b[2J\"\n", "line 2: name: expected a name without control characters, got \"a");
  expect(kPlate + kPlate, "line 6: name: expected another name for each object, got \"floor\" again");
  expect("[[object]]\nname = \"a\"\nunit = \"mm\"\n", "line 1: a: expected a mesh, got none");
  expect("[[object]]\nname = \"a\"\nmesh = 3\n", "line 3: mesh: expected a text in quotes, got 3");
  expect("[[object]]\nname = \"a\"\nmesh = \"plate.off\"\n", "line 1: a: expected a unit, mm, cm, m or in, got none");
  expect("[[object]]\nname = \"a\"\nmesh = \"plate.off\"\nunit = \"ft\"\n",
         "line 4: unit: expected mm, cm, m or in, got \"ft\"");
  expect("[[object]]\nname = \"a\"\nheight-map = \"groove.toml\"\n",
         "line 3: height-map: expected a mesh: a height map is a force above a plane and has no faces; 'forceshade mesh make "
         "height-map'");
  expect(kPlate + "poses = 3\n", "line 5: unknown key poses");
  expect(kPlate + "sides = \"both\"\n", "line 5: unknown key sides");
  for (const char* wrong : {"3", "[1, 2]", "[1, 2, 3, 4]", "\"1mm\""})
    expect(kPlate + "translation = " + wrong + "\n", "line 5: translation: expected a list of three lengths, x, y and z, got ");
  expect(kPlate + "translation = [1, true, 3]\n",
         "line 5: translation: expected a list of three lengths, x, y and z, got true");
  expect(kPlate + "translation = [1, [2], 3]\n",
         "line 5: translation: expected a list of three lengths, x, y and z, got a list");
  expect(kPlate + "translation = [1, \"2 feet\", 3]\n", "line 5: translation: expected a length such as 15.24");
  expect(kPlate + "translation = [1, inf, 3]\n", "line 5: translation: expected a length such as 15.24");
  expect(kPlate + "translation = [\n1,\n\"10.001m\", 3]\n",
         "line 5: translation: expected lengths within 10000 mm, got \"10.001m\"");
  for (const char* wrong : {"3", "[1, 0, 0]", "[1, 0, 0, 0, 0]"})
    expect(kPlate + "rotation = " + wrong + "\n",
           "line 5: rotation: expected a list of four numbers, the quaternion w, x, y and z, got ");
  expect(kPlate + "rotation = [0, 0, 0.0, -0.0]\n",
         "line 5: rotation: expected a quaternion w, x, y, z that is not 0, got only zeros");
  for (const char* wrong : {"2.0000003", "-3", "1e-10", "nan", "inf", "\"1mm\"", "\"90deg\""})
    expect(kPlate + "rotation = [1, 0, " + wrong + ", 0]\n",
           "line 5: rotation: expected four numbers w, x, y, z, each 0 or of 2^-30 to 2 in size, got \"");
  expect(kPlate + "friction = -1\n", "line 5: friction: expected one coefficient of friction");
  expect(kPlate + "stiffness = \"2000N/mm\"\n", "line 5: stiffness is 2000 N/mm; expected 0.001 to 1000 N/mm");
  expect(kPlate + "materials = \"a.toml\"\nfriction = 0.5\n", "line 6: friction: expected without materials, got both");
  expect(kPlate + "stiffness = 1\nmaterials = \"a.toml\"\n", "line 5: stiffness: expected without materials, got both");
  expect(kPlate + "materials = 3\n", "line 5: materials: expected a text in quotes, got 3");
  expect("contact = \"direct\"\n" + kPlate + "friction = 1\n",
         "line 1: contact: expected friction, or no coefficient above 0 of --scene, got \"direct\"");
}

TEST_F(Scenes, say_which_other_file_is_at_fault) {
  expect_refusal(kPlate + "materials = \"none.toml\"\n", folder.file("none.toml") + ": cannot be opened");
  expect_refusal("[[object]]\nname = \"a\"\nmesh = \"none.off\"\nunit = \"mm\"\n", folder.file("none.off"));
  folder.write("wheel.toml", "[[material]]\nname = \"a\"\ngroups = [\"tire\"]\n");
  expect_refusal(
      kTetrahedron + "materials = \"wheel.toml\"\n",
      "wheel.toml: line 3: groups: expected a group or material of the mesh's file (rubber, steel, tyre), got \"tire\"");
  EXPECT_THROW(read_one({{"scene", folder.file("absent.toml")}}), Error);
}

TEST_F(Scenes, stand_beside_no_option_of_another_subject) {
  const auto expect = [&](std::initializer_list<Option> others, const std::string& words) {
    expect_refusal(kPlate, words, others);
  };
  expect({{"mesh", "a.off"}, {"unit", "mm"}}, "--mesh: expected without --scene, got both");
  expect({{"law", "wall"}}, "--law: expected without --scene, got both");
  expect({{"radius", "3"}}, "--radius: expected without --scene, got both");
  for (const Option& one : {Option{"unit", "mm"}, {"friction", "1"}, {"materials", "a.toml"}, {"texture-scale", "1"}})
    expect({one}, "--" + one.key + ": expected --mesh beside it, got --scene");
  expect({{"stiffness", "2000"}}, "--stiffness is 2000 N/mm; expected 0.001 to 1000 N/mm");
  expect_refusal("sides = \"both\"\n" + kPlate, "table.toml: line 1: sides: expected once, got several times",
                 {{"sides", "front"}});
  EXPECT_EQ(tests::thrown_by<Error>([&] {
              read_one({{"law", "wall"}, {"sides", "both"}});
            }),
            "--sides: expected --mesh or --scene beside it, got --law");
}

}  // namespace
}  // namespace forceshade::subjects
