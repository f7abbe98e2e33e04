// SPDX-License-Identifier: BSD-3-Clause
// A user's friction and materials: the meaning of each key, the refusals and their words, and their part in a mesh's identity
// and in the options that are written.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "forceshade/error.h"
#include "forceshade/identity.h"
#include "forceshade/renderer.h"
#include "subjects/file.h"
#include "tests/subjects/scene_folder.h"

namespace forceshade::subjects {
namespace {

class Materials : public SceneFolder {
 protected:
  Options options(std::initializer_list<Option> others) const {
    Options all{{"mesh", folder.file("its.obj")}, {"unit", "mm"}, {"shading", "none"}};
    for (const Option& one : others) all.add(one);
    return all;
  }
  MeshRendering read_with(std::initializer_list<Option> others) const {
    return std::get<MeshRendering>(read_one(options(others)).what);
  }
  MeshRendering of_file(const std::string& text) {
    folder.write("materials.toml", text);
    return read_with({{"materials", folder.file("materials.toml")}});
  }
  template <class Read>
  static void expect_refusal(const std::string& words, const Read& read) {
    tests::expect_words(tests::thrown_by<Error>(read), {words});
  }
};

TEST_F(Materials, of_the_whole_mesh_have_one_coefficient_or_two) {
  const auto material_of = [&](const std::string& text) {
    const MeshRendering its = read_with({{"friction", text}});
    EXPECT_EQ(its.contact, mesh::Contact::friction);
    EXPECT_EQ(its.materials.list.size(), 1U);
    EXPECT_TRUE(its.materials.of_triangle.empty());
    return its.materials.list.front();
  };
  EXPECT_EQ(material_of("0.3"), (mesh::Material{{}, 0.3F, 0.3F}));
  EXPECT_EQ(material_of("0.4,0.3"), (mesh::Material{{}, 0.4F, 0.3F}));
  EXPECT_EQ(material_of("0.4, 0"), (mesh::Material{{}, 0.4F, 0}));
  EXPECT_FALSE(std::signbit(material_of("0.4,-0").dynamic_friction)) << "-0 is 0, to the bit, in the identity too";
  EXPECT_EQ(material_of("inf,1024"), (mesh::Material{{}, HUGE_VALF, 1024}));
  EXPECT_EQ(material_of("0.0009765625"), (mesh::Material{{}, 0x1p-10F, 0x1p-10F}));
}

TEST_F(Materials, that_change_nothing_are_none) {
  for (const char* zero : {"0", "-0", "0,0"}) {
    const MeshRendering its = read_with({{"friction", zero}});
    EXPECT_EQ(its.materials, mesh::Materials{});
    EXPECT_EQ(its.contact, mesh::Contact::direct);
    EXPECT_EQ(identity_of("its.obj", its).digest, identity_of("its.obj", read_with({})).digest);
  }
  EXPECT_EQ(read_with({{"friction", "0"}, {"contact", "sub-goal"}}).contact, mesh::Contact::sub_goal);
  EXPECT_EQ(read_with({{"contact", "friction"}}).contact, mesh::Contact::friction);
}

TEST_F(Materials, of_a_file_are_found_by_groups_and_faces) {
  const MeshRendering its = of_file(
      "[default]\nfriction = 0.125\n[[material]]\nname = \"soft\"\nstiffness = \"250N/m\"\nfriction = [inf, 0.5]\n"
      "groups = [\"rubber\"]\nfaces = [\"2-2\"]\n[[material]]\nname = \"hard\"\nfaces = [1]\n");
  EXPECT_EQ(its.materials.list, (std::vector<mesh::Material>{{{}, 0.125F, 0.125F}, {0.25F, HUGE_VALF, 0.5F}, {{}, 0, 0}}));
  EXPECT_EQ(its.materials.of_triangle, (std::vector<std::uint32_t>{1, 2, 1, 0}));
  EXPECT_EQ(its.contact, mesh::Contact::friction);
  const MeshRendering of_group = of_file("[[material]]\nname = \"a\"\nfriction = 1\ngroups = [\"tyre\", \"rubber\"]\n");
  EXPECT_EQ(of_group.materials.of_triangle, (std::vector<std::uint32_t>{1, 1, 0, 0}));
  const MeshRendering stiff = of_file("[default]\nstiffness = 2\n");
  EXPECT_EQ(stiff.materials.list, (std::vector<mesh::Material>{{2.0F, 0, 0}}));
  EXPECT_TRUE(stiff.materials.of_triangle.empty());
  EXPECT_EQ(stiff.contact, mesh::Contact::direct) << "no coefficient is above 0";
}

TEST_F(Materials, of_a_file_limit_a_paths_damping) {
  const MeshRendering its = of_file(
      "[default]\ndamping = 0\n[[material]]\nname = \"oiled\"\ndamping = \"2Ns/m\"\ndrag = 0.001\nfaces = [1]\n"
      "[[material]]\nname = \"rubber\"\ndamping = \"inf\"\ndrag = inf\nfaces = [2]\n");
  EXPECT_EQ(its.materials.list, (std::vector<mesh::Material>{{.damping = {0, HUGE_VALF}}, {.damping = {0.002F, 0.001F}}, {}}));
  EXPECT_EQ(its.contact, mesh::Contact::direct);
  EXPECT_EQ(of_file("[default]\ndamping = inf\n").materials, mesh::Materials{}) << "they change nothing";
  const auto expect = [&](const std::string& keys, const std::string& words) {
    expect_refusal("materials.toml: line 2: " + words, [&] { of_file("[default]\n" + keys); });
  };
  expect("damping = 20\n", "damping is 20 N·s/mm; expected 0 or inf, or ");
  expect("drag = -1\n", "drag is -1 N·s/mm; expected 0 or inf, or ");
  expect("drag = 1e-7\n", "drag is ");
  expect("damping = true\n", "damping: expected a number such as \"2Ns/m\", got true");
  expect("damping = \"2kg\"\n", "damping: ");
}

TEST_F(Materials, are_rendered_with_the_largest_of_their_stiffnesses_known) {
  const auto largest = [&](const MeshRendering& its) { return std::get<Rendering>(rendering_of("its.obj", its)).stiffness; };
  const std::string hard = "[[material]]\nname = \"hard\"\nfaces = [1]\nstiffness = 4\n";
  EXPECT_EQ(largest(of_file(hard)), 4);
  EXPECT_EQ(largest(of_file("[default]\nstiffness = 0.25\n")), 0.5F) << "the rendering's own, too";
}

TEST_F(Materials, are_part_of_the_identity) {
  const auto identity = [&](const MeshRendering& its) { return identity_of("its.obj", its); };
  const MeshRendering plain = read_with({});
  EXPECT_EQ(identity(plain).parameter("friction"), nullptr);
  EXPECT_EQ(identity(plain).parameter("materials"), nullptr);
  const Identity one = identity(read_with({{"friction", "0.4,0.3"}}));
  EXPECT_EQ(text_of(*one.parameter("friction")), "0.4, 0.3");
  EXPECT_EQ(text_of(*one.parameter("contact")), "friction");
  EXPECT_EQ(one.parameter("materials"), nullptr);
  const std::string soft = "[[material]]\nname = \"soft\"\nstiffness = 0.25\nfriction = [2, 0.5]\n";
  const Identity two = identity(of_file(soft + "faces = [\"0-1\"]\n"));
  EXPECT_EQ(text_of(*two.parameter("friction")), "up to 2");
  EXPECT_EQ(text_of(*two.parameter("materials")), "2");
  // Each number counts, and so does the material of each face.
  std::set<std::string> digests{identity(plain).digest, one.digest, two.digest};
  digests.insert(identity(read_with({{"friction", "0.4,0.2"}})).digest);
  digests.insert(identity(read_with({{"friction", "0.3"}})).digest);
  digests.insert(identity(of_file(soft + "faces = [\"0-2\"]\n")).digest);
  digests.insert(identity(of_file("[default]\nstiffness = 0.25\n")).digest);
  digests.insert(identity(of_file("[default]\nstiffness = 0.5\n")).digest);
  EXPECT_EQ(identity(of_file("[default]\ndamping = -0.0\n")).digest, identity(of_file("[default]\ndamping = 0\n")).digest);
  digests.insert(identity(of_file("[default]\ndamping = 0.5\n")).digest);
  digests.insert(identity(of_file("[default]\ndrag = 0.5\n")).digest);
  digests.insert(identity(of_file("[default]\ndrag = 0.25\n")).digest);
  EXPECT_EQ(digests.size(), 11U);
  EXPECT_EQ(text_of(*identity(of_file("[default]\ndrag = 0.5\n")).parameter("materials")), "1");
}

TEST_F(Materials, are_written_as_they_are_read) {
  folder.write("materials.toml", "[default]\nfriction = 0.5\n");
  for (const Option& given :
       {Option{"friction", "0.4,0.3"}, {"friction", "inf"}, {"materials", folder.file("materials.toml")}}) {
    const Options all = options({given, {"stiffness", "0.25"}});
    const std::string text = written_files(all).front();
    const Description again = read_text(text, folder.file("again.toml"));
    EXPECT_EQ(std::get<MeshRendering>(again.what).materials, read_with({given}).materials) << text;
    EXPECT_NE(written_for_shell(all).find("--" + given.key + ' '), std::string::npos) << written_for_shell(all);
  }
  EXPECT_EQ(written_files(options({})).front().find("friction"), std::string::npos);
  const Description listed = read_text("mesh = \"its.obj\"\nunit = \"mm\"\nfriction = [0.5, 0.25]\n", folder.file("a.toml"));
  EXPECT_EQ(std::get<MeshRendering>(listed.what).materials.list, (std::vector<mesh::Material>{{{}, 0.5F, 0.25F}}));
}

TEST_F(Materials, are_refused_in_words) {
  const auto expect = [&](std::initializer_list<Option> given, const std::string& words) {
    expect_refusal(words, [&] { read_with(given); });
  };
  for (const char* wrong : {"-1", "nan", "0.0009", "1025", "1e99", "rough", "0.3,", "0.4,0.3,0.2", "0.3 ", ","})
    expect({{"friction", wrong}}, "--friction: expected one coefficient of friction, or a static and a dynamic one");
  expect({{"friction", ""}}, "--friction: expected a value");
  expect({{"friction", "0.2,0.3"}}, "a dynamic coefficient of at most the static one, which comes first, got \"0.2,0.3\"");
  expect({{"friction", "1"}, {"materials", "a.toml"}}, "--friction: expected without --materials, got both");
  for (const char* rule : {"direct", "sub-goal"})
    expect({{"friction", "1"}, {"contact", rule}}, "--contact: expected friction, or no coefficient above 0");
  expect({{"materials", folder.file("none.toml")}}, "none.toml: cannot be opened");
  expect_refusal("--friction: expected --mesh beside it", [] { read_one({{"law", "wall"}, {"friction", "1"}}); });
}

TEST_F(Materials, of_a_file_are_refused_with_its_line) {
  const auto expect = [&](const std::string& text, const std::string& words) {
    expect_refusal("materials.toml: " + words, [&] { of_file(text); });
  };
  const std::string a = "[[material]]\nname = \"a\"\n", b = "[[material]]\nname = \"b\"\n";
  expect("", "expected [default] or a [[material]], got neither");
  expect("x = 1\n", "line 1: unknown key x");
  expect("default = 3\n", "line 1: default: expected a table, got 3");
  expect("[material]\nname = \"a\"\n", "line 1: material: expected [[material]], got a list or table");
  expect("[default]\nfrction = 1\n", "line 2: unknown key frction; the nearest is friction");
  expect("[default]\nname = \"a\"\n", "line 2: unknown key name");
  expect("[[material]]\nfaces = [0]\n", "line 1: [[material]]: expected a name, got none");
  expect("[[material]]\nname = 3\n", "line 2: name: expected a text in quotes, got 3");
  expect(a, "line 1: a: expected groups or faces that have the material, got none");
  expect(a + "faces = []\n", "line 1: a: expected groups or faces");
  expect(a + "faces = 3\n", "line 3: faces: expected a list, got 3");
  expect(a + "groups = [3]\n", "line 3: groups: expected names in quotes, got 3");
  for (const char* wrong : {"\"4\"", "4", "\"2-1\"", "-1", "\"1-\"", "\"0-4\"", "\"x\"", "[1]", "1.5"})
    expect(a + "faces = [" + wrong + "]\n",
           "line 3: faces: expected a face such as \"7\" or faces such as \"0-99\", from 0 to 3");
  expect(a + "groups = [\"rubbr\"]\n",
         "line 3: groups: expected a group or material of the mesh's file (rubber, steel, tyre), got \"rubbr\"; the nearest is "
         "rubber");
  expect(a + "faces = [\"0-2\"]\n" + b + "groups = [\"steel\"]\n",
         "line 6: groups: expected each face in one material, got face 1 in \"a\" and \"b\"");
  expect(a + "faces = [0]\n" + a + "faces = [1]\n", "line 5: name: expected another name for each material, got \"a\" again");
  expect(a + "faces = [0]\nfriction = -1\n", "line 4: friction: expected one coefficient of friction");
  expect(a + "faces = [0]\nfriction = [0.2, 0.3]\n", "line 4: friction: expected a dynamic coefficient of at most the static");
  expect(a + "faces = [0]\nfriction = true\n", "line 4: friction: expected a coefficient, or [static, dynamic], got true");
  expect(a + "faces = [0]\nstiffness = \"2000N/mm\"\n", "line 4: stiffness is 2000 N/mm; expected 0.001 to 1000 N/mm");
  expect(a + "faces = [0]\nstiffness = \"hard\"\n", "line 4: stiffness: expected a stiffness such as");
  expect("[default\n", "line 1: ");
}

}  // namespace
}  // namespace forceshade::subjects
