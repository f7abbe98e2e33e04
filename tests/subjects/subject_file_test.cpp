// SPDX-License-Identifier: BSD-3-Clause
// Subject files as a program reads them: the meaning of each key, the defaults, and what is refused at which line.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "forceshade/error.h"
#include "forceshade/subjects.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::subjects {
namespace {

const Parameters& parameters_of(const Description& description) {
  return std::get<DescribedLaw>(description.what).parameters;
}

TEST(subject_file, names_a_law_with_its_parameters_in_their_units) {
  const Description bump =
      read_text("law = \"bump-2p\"\nradius = \"600mil\"\nwidth = 30\nstiffness = \"250N/m\"\n", "its.toml");
  EXPECT_EQ(bump.name, "bump-2p");
  EXPECT_EQ(std::get<DescribedLaw>(bump.what).law, LawId::bump_2p);
  EXPECT_EQ(parameters_of(bump).radius, 15.24F);
  EXPECT_EQ(parameters_of(bump).width, 30.0F);
  EXPECT_EQ(parameters_of(bump).stiffness, 0.25F);
  EXPECT_EQ(bump.stiffness(), 0.25F);
}

// 1 + 2^-24 is the middle between two numbers of binary32; 10^-29 more is lost in binary64.
TEST(subject_file, rounds_a_number_once) {
  const std::string above = "1.00000005960464477539062500001", tie = "1.000_000_059_604_644_775_390_625";
  const float next = std::nextafter(1.0F, 2.0F);
  for (const auto& [text, expected] : {std::pair(above, next),
                                       {tie, 1.0F},
                                       {"+" + above, next},
                                       {"10000.0005960464477539062500001e-4", next},
                                       {'"' + above + "N/mm\"", next},
                                       {"\"1000.00005960464477539062500001N/m\"", next},
                                       {"1", 1.0F}}) {
    const Description wall = read_text("# \u00e9\nlaw = \"wall\"\nstiffness = " + text + " # \u00e9\n", "its.toml");
    EXPECT_EQ(parameters_of(wall).stiffness, expected) << text;
  }
}

TEST(subject_file, has_the_thesis_bump_where_it_does_not_say) {
  const Description bump = read_text("law = \"bump-cylinder\"\n", "its.toml");
  EXPECT_EQ(parameters_of(bump).radius, 15.24F);
  EXPECT_EQ(parameters_of(bump).width, 25.4F);
  EXPECT_EQ(parameters_of(bump).stiffness, 0.5F);
}

TEST(subject_file, names_a_height_map_and_a_mesh_that_lie_beside_it) {
  const tests::TemporaryDirectory folder;
  folder.write("map.toml",
               "render = \"height-map-shaded\"\n[[part]]\nshape = \"grating\"\nheight_mm = 0.1\nwave_x_rad_per_mm = 3.0\n");
  folder.write("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  folder.write("of-map.toml", "height-map = \"map.toml\"\nstiffness = 0.75\n");
  folder.write("of-mesh.toml",
               "mesh = \"tetrahedron.off\"\nunit = \"m\"\nsides = \"both\"\nshading = \"edge\"\ncontact = \"sub-goal\"\n"
               "crease = \"90deg\"\nstiffness = 0.25\n");
  const Description map = read_file(folder.file("of-map.toml"));
  EXPECT_EQ(map.name, "map.toml");
  EXPECT_EQ(std::get<DescribedHeightMap>(map.what).stiffness, 0.75F);
  const Description mesh = read_file(folder.file("of-mesh.toml"));
  EXPECT_EQ(mesh.name, "tetrahedron.off");
  const auto& rendering = std::get<MeshRendering>(mesh.what);
  EXPECT_EQ(rendering.stiffness, 0.25F);
  EXPECT_EQ(rendering.mesh().vertices.size(), 4U);
  EXPECT_EQ(rendering.mesh().vertices[1][0], 9000.0F) << "m are 1000 mm";
}

TEST(subject_file, has_damping_in_a_table) {
  const auto damping_of = [](const std::string& keys) {
    return read_text("law = \"wall\"\n[damping]\n" + keys, "its.toml").damping;
  };
  EXPECT_TRUE(read_text("law = \"wall\"\n", "its.toml").damping.parameters.is_off());
  const damping::Described all = damping_of("damping = 0.002\nmost = inf\ndrag = \"3Ns/m\"\nfull_at = \"0.5N\"\nshare = 0.1\n");
  EXPECT_EQ(
      all.parameters,
      (damping::Parameters{
          .share = 0.1F, .damping = 0.002F, .most = std::numeric_limits<float>::infinity(), .drag = 0.003F, .full_at = 0.5F}));
  EXPECT_EQ(all.time, 0);
  const damping::Described timed = damping_of("drag = \"0.003Ns/mm\"\ntime = \"2ms\"\n");
  EXPECT_EQ(timed.at(500).share, 0.5F);
  EXPECT_EQ(timed.at(500).rate, 500.0F);
  const auto expect = [&](const std::string& keys, const std::string& words) {
    tests::expect_words(tests::thrown_by<Error>([&] { damping_of(keys); }), {"its.toml: line " + words});
  };
  expect("", "2: damping: expected the key damping or drag in its table, got none");
  expect("share = 0.5\n", "2: damping: expected the key damping or drag in its table, got none");
  expect("dampin = 1\n", "3: unknown key dampin; expected keys of [damping]; the nearest is damping");
  expect("drag = 1\nmost = 3\n", "4: most: expected damping beside it, got it alone");
  expect("drag = 1\nfull_at = 0\n", "4: full_at is 0 N; expected");
  expect("damping = 17\n", "3: damping is 17 N·s/mm; expected 0, or 9.536743e-07 to 16 N·s/mm");
  expect("drag = -1\n", "3: drag is -1 N·s/mm; expected 0, or 9.536743e-07 to 16 N·s/mm");
  expect("damping = 1\nmost = 0.5\n", "4: most is 0.5; expected inf, or 1 to 1024");
  expect("damping = 1\nshare = \"2ms\"\n", "4: share: expected a number such as 0.5, got \"2ms\"");
  expect("damping = 1\ntime = 2\n", "4: time: expected a time such as 2ms or 0.002s, got \"2\"");
  expect("damping = 1\ntime = \"0ms\"\n", "4: time: expected a time above 0, got \"0ms\"");
  expect("damping = 1\ntime = \"1ms\"\nshare = 1\n", "4: time: expected without share, got both");
  expect("damping = [1, 2]\n", "3: damping: expected a damping such as 0.002, 0.002Ns/mm or 2Ns/m, got \"1,2\"");
  expect("damping = true\n", "3: damping: expected a number or a text in quotes, got true");
  tests::expect_words(tests::thrown_by<Error>([] { read_text("law = \"wall\"\ndamping = 1\n", "its.toml"); }),
                      {"its.toml: line 2: damping: expected the table [damping], got 1"});
  tests::expect_words(tests::thrown_by<Error>([] { read_text("law = \"wall\"\ndrag = 1\n", "its.toml"); }),
                      {"its.toml: line 2: unknown key drag"});
}

TEST(subject_file, is_refused_with_its_line_and_what_was_expected) {
  const auto expect = [](const std::string& text, const std::string& words) {
    tests::expect_words(tests::thrown_by<Error>([&] { read_text(text, "its.toml"); }), {words});
  };
  expect("", "its.toml: has none of the keys law, height-map, mesh and scene");
  expect("law = \"bump-2p\"\nradus = 3\n", "its.toml: line 2: unknown key radus");
  expect("law = \"wall\"\nradius = 3\n",
         "its.toml: line 2: radius: has no effect on the law wall, which has no bump; expected none");
  expect("law = \"wall\"\n\nwidth = 3\n", "its.toml: line 3: width: has no effect on the law wall");
  expect("law = \"bmp-2p\"\n", "its.toml: line 1: law: expected");
  expect("law = \"bump-2p\"\nradius = true\n",
         "its.toml: line 2: radius: expected a text in quotes, a number or a list of these");
  expect("law = \"wall\"\n\nstiffness = -1\n", "its.toml: line 3: stiffness");
  expect("law = \"wall\"\nmesh = \"a.off\"\n", "mesh");
  expect("law = [\"wall\", \"bump-2p\"]\n", "its.toml: line 1: law: expected");
  expect("law = \"wall\"\nunit = \"mm\"\n", "its.toml: line 2: unit");
  expect("law = = 3\n", "its.toml: line 1");
  EXPECT_THROW(read_file("no-such-file.toml"), Error);
}

}  // namespace
}  // namespace forceshade::subjects
