// SPDX-License-Identifier: BSD-3-Clause
// Broken files: each is refused with the line or the byte, what was expected and what is there; in little memory.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "forceshade/meshes.h"
#include "tests/meshes/loaded.h"

namespace forceshade::mesh {
namespace {

struct Broken {
  std::string name, text, words;  // the words are all of the refusal, or its beginning if they end in ...
};

void expect_refused(const std::vector<Broken>& files) {
  for (const Broken& file : files) {
    const std::string got = of_text(file.name, file.text).refusal;
    if (file.words.ends_with("...")) {
      EXPECT_TRUE(got.starts_with(file.words.substr(0, file.words.size() - 3))) << got << "\nexpected: " << file.words;
    } else {
      EXPECT_EQ(got, file.words) << file.text.substr(0, 200);
    }
  }
  std::printf("%zu files\n", files.size());
}

const std::string kThree = "0 0 0\n1 0 0\n0 1 0\n";

TEST(broken_mesh_files, of_off_are_refused_in_words) {
  const std::string head = "OFF\n3 1 0\n";
  expect_refused({
      {"a.off", "", "is empty; expected the word OFF"},
      {"a.off", "\n# no more\n", "line 2: the file ends here; expected the word OFF"},
      {"a.off", "OF\n3 1 0\n", "line 1: expected OFF, after none or some of ST, C and N, got \"OF\""},
      {"a.off", "4OFF\n3 1 0\n", "line 1: expected OFF, after none or some of ST, C and N, got \"4OFF\""},
      {"a.off", "OFF BINARY\n\1\2\3", "line 1: is OFF BINARY; expected OFF as text"},
      {"a.off", "OFF\n", "line 1: the file ends here; expected the numbers of vertices and faces"},
      {"a.off", "OFF\n3\n", "line 2: expected a number of faces, got the end of the line"},
      {"a.off", "OFF\n-3 1 0\n", "line 2: expected a number of vertices, got \"-3\""},
      {"a.off", "OFF\n3 1.0 0\n", "line 2: expected a number of faces, got \"1.0\""},
      {"a.off", "OFF\n3 1 x\n", "line 2: expected a number of edges, got \"x\""},
      {"a.off", "OFF\n3 1 0 7\n", "line 2: expected the end of the line, got \"7\""},
      {"a.off", "OFF\n4294967296 1 0\n" + kThree, "line 2: declares 4294967296 vertices; expected 268435456 at most"},
      {"a.off", "OFF\n3 4294967296 0\n" + kThree, "line 2: declares 4294967296 faces; expected 268435456 at most"},
      {"a.off", "OFF\n3 18446744073709551617 0\n", "line 2: expected a number of faces, got \"18446744073709551617\""},
      {"a.off", "OFF\n200000000 1 0\n" + kThree, "line 2: declares 200000000 vertices, more than the file's 36 bytes can hold"},
      {"a.off", "OFF\n3 200000000 0\n" + kThree, "line 2: declares 200000000 faces, more than the file's 36 bytes can hold"},
      {"a.off", head + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate, got the end of the line"},
      {"a.off", head + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate within 10000 mm, got \"nan\""},
      {"a.off", head + "0 0 0\n1 0 -inf\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate within 10000 mm, got \"-inf\""},
      {"a.off", head + "0 0 0\n1 0 1e26\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate within 10000 mm, got \"1e26\""},
      {"a.off", head + "0 0 0\n1 0 1e999999999999\n0 1 0\n3 0 1 2\n",
       "line 4: expected a coordinate within 10000 mm, got \"1e999999999999\""},
      {"a.off", head + "0 0 0\n1 0 0x1\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate, got \"0x1\""},
      {"a.off", head + "0 0 0\n1 0 1,5\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate, got \"1,5\""},
      {"a.off", head + "0 0 0\n1 0 +-1\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate, got \"+-1\""},
      {"a.off", head + "0 0 0\n1 0 0\n", "line 4: the file ends here; expected vertex 2 of 3"},
      {"a.off", head + kThree, "line 5: the file ends here; expected face 0 of 1"},
      {"a.off", head + kThree + "3 0 1", "line 6: expected the index of a vertex, below 3, got the end of the line"},
      {"a.off", head + kThree + "3 0 1 3\n", "line 6: expected the index of a vertex, below 3, got \"3\""},
      {"a.off", head + kThree + "3 0 -1 2\n", "line 6: expected the index of a vertex, below 3, got \"-1\""},
      {"a.off", head + kThree + "3 0 1 4294967298\n", "line 6: expected the index of a vertex, below 3, got \"4294967298\""},
      {"a.off", head + kThree + "2 0 1\n", "line 6: expected a number of corners of 3 or more, got \"2\""},
      {"a.off", head + kThree + "4294967296 0 1 2\n",
       "line 6: expected the index of a vertex, below 3, got the end of the line"},
      {"a.off", head + kThree + "3 0 1 2\n3 0 1 2\n",
       "line 7: expected the end of the file after the last face, got \"3 0 1 2\""},
      {"a.off", "OFF\n3 0 0\n" + kThree, "line 5: the file ends here; expected at least one face"},
      {"a.off", "NOFF\n3 1 0\n0 0 0 0 0\n", "line 3: expected a number within 10000, got the end of the line"},
      {"a.off", "OFF\n3 1 0\n" + std::string(10'000'000, '7') + "\n", "line 3: is longer than 1048576 bytes"},
      {"a.off", "OFF\n3 1 0\n" + std::string(1'000'000, '1') + " 0 0\n",
       "line 3: expected a coordinate within 10000 mm, got \"1111..."},
      {"a.off", std::string("OFF\n\0\0\0\3", 8), "line 2: expected a number of vertices, got \"..."},
      {"a.xyz", head, "has a name of no known format; expected a name that ends in .obj, .off, .ply or .stl"},
      {"off", head, "has a name of no known format; expected a name that ends in .obj, .off, .ply or .stl"},
  });
}

TEST(broken_mesh_files, of_obj_are_refused_in_words) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refused({
      {"a.obj", "", "is empty; expected at least one face"},
      {"a.obj", three, "line 3: the file ends here; expected at least one face"},
      {"a.obj", "v 0 0\n", "line 1: expected a coordinate, got the end of the line"},
      {"a.obj", three + "f 1 2\n", "line 4: has a face of 2 corners; expected 3 or more"},
      {"a.obj", three + "f\n", "line 4: has a face of 0 corners; expected 3 or more"},
      {"a.obj", three + "f 1 2 4\n", "line 4: expected the number of a vertex above, of which there are 3, got \"4\""},
      {"a.obj", three + "f 0 1 2\n", "line 4: expected the number of a vertex above, of which there are 3, got \"0\""},
      {"a.obj", three + "f 1 2 -4\n", "line 4: expected the number of a vertex above, of which there are 3, got \"-4\""},
      {"a.obj", three + "f 1 2 99999999999999999999\n",
       "line 4: expected the number of a vertex above, of which there are 3, got \"99999999999999999999\""},
      {"a.obj", three + "f 1 2 3.0\n", "line 4: expected the number of a vertex above, of which there are 3, got \"3.0\""},
      {"a.obj", "f 1 2 3\n" + three, "line 1: expected the number of a vertex above, of which there are 0, got \"1\""},
      {"a.obj", three + "f 1/1 2/1 3/1\n",
       "line 4: expected the number of a point of the texture above, of which there are 0, got \"1/1\""},
      {"a.obj", three + "f 1//1 2//1 3//1\n",
       "line 4: expected the number of a normal above, of which there are 0, got \"1//1\""},
      {"a.obj", three + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n",
       "line 6: expected a corner such as 12, 12/7, 12//3 or 12/7/3, got \"1/1/1/1\""},
      {"a.obj", three + "cstype bezier\n",
       "line 4: expected v, vt, vn, f or a keyword without faces, such as o, g, s, l, usemtl, got \"cstype\""},
      {"a.obj", three + "f 1 2 \\", "line 4: the file ends here; expected the line that \\ joins to the one before"},
      {"a.obj", std::string("\x7F") + "ELF\1\0\0", "expected a mesh, got a program"},
      {"a.obj", "vt nan\n", "line 1: expected a number within 10000, got \"nan\""},
      {"a.obj", "f " + std::string(2'000'000, '1'), "line 1: is longer than 1048576 bytes"},
  });
  std::string joined = "v 0 0 0\n";
  joined += "f";
  for (int i = 0; i < 40000; ++i) joined += " 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 \\\n";
  EXPECT_TRUE(of_text("a.obj", joined).refusal.ends_with("is joined to more than 1048576 bytes"));
}

std::string ply(const std::string& format, const std::string& elements, const std::string& body) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

const std::string kXyz = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kOneFace = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kOneStrip = "element tristrips 1\nproperty list int int vertex_indices\n";

// A clone without Git LFS has these in the place of files.
TEST(broken_mesh_files, that_are_pointers_of_git_lfs_are_named_so) {
  const std::string pointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, 'a') + "\nsize 12345\n";
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl", "a.STL"})
    EXPECT_EQ(of_text(name, pointer).refusal, "is a pointer of Git LFS in the place of a file, which 'git lfs pull' fetches");
}

TEST(broken_mesh_files, of_another_kind_are_named) {
  for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl"})
    for (const auto& [text, kind] : std::vector<std::pair<std::string, std::string>>{
             {"\x1f\x8b\x08\x01", "a gzip archive"},
             {"PK\x03\x04", "a ZIP archive"},
             {std::string("\xff\xfev\0 \0", 6), "a UTF-16 text"},
             {"<!DOCTYPE html>\n<title>404: not found</title>", "an XML or HTML file"}})
      EXPECT_EQ(of_text(name, text).refusal, "expected a mesh, got " + kind) << name;
}

TEST(broken_mesh_files, of_ply_are_refused_in_words) {
  const std::string nulls(36, '\0');
  expect_refused({
      {"a.ply", "", "is no PLY file: expected the word ply in its first line"},
      {"a.ply", "plyformat ascii 1.0\n", "is no PLY file: expected the word ply in its first line"},
      {"a.ply", "ply\nformat ascii 2.0\n", "line 2: expected version 1.0, got \"2.0\""},
      {"a.ply", "ply\nformat binary 1.0\n",
       "line 2: expected ascii, binary_little_endian or binary_big_endian, got \"binary\""},
      {"a.ply", "ply\nelement vertex 3\n", "line 2: expected format, got \"element vertex 3\""},
      {"a.ply", "ply\nformat ascii 1.0\n" + kXyz, "line 6: the file ends here; expected end_header"},
      {"a.ply", "ply\nformat ascii 1.0\nproperty int x\n", "line 3: has a property in front of the first element"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex -3\n", "line 3: expected a number of elements, got \"-3\""},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 4294967296\n",
       "line 3: declares 4294967296 of element \"vertex\"; expected 268435456 at most"},
      {"a.ply", "ply\nformat ascii 1.0\nelement face 200000000\n",
       "line 3: declares 200000000 of element \"face\", more than the file's 44 bytes can hold"},
      {"a.ply", ply("ascii", "element vertex 9\n", ""), "has element \"vertex\" without a property"},
      {"a.ply", ply("ascii", kXyz + "property real w\n", ""),
       "line 7: expected a type: char, uchar, short, ushort, int, uint, float or double, got \"real\""},
      {"a.ply", ply("ascii", kXyz + "property float x\n", ""),
       "line 7: has property \"x\" a second time, or another name of the same"},
      {"a.ply", ply("ascii", kXyz + kXyz, ""), "line 7: has element \"vertex\" a second time"},
      {"a.ply", ply("ascii", kXyz, ""), "declares no element vertex, or neither face nor tristrips"},
      {"a.ply", ply("ascii", kXyz + kOneStrip, kThree + "2 0 1\n"), "line 13: has a strip of 2 vertices; expected 3 or more"},
      {"a.ply", ply("ascii", kXyz + kOneStrip, kThree + "5 0 1 2 -1 0\n"),
       "line 13: has a strip of 1 vertices; expected 3 or more"},
      {"a.ply", ply("ascii", kXyz + kOneStrip, kThree + "3 0 1 3\n"),
       "line 13: has a strip with vertex 3; expected the index of a vertex, below 3, or -1"},
      {"a.ply", ply("ascii", kXyz + kOneStrip, kThree + "3 0 -2 1\n"),
       "line 13: has a strip with vertex -2; expected the index of a vertex, below 3, or -1"},
      {"a.ply", ply("ascii", kXyz + kOneStrip, kThree + "3 0 1\n"),
       "line 13: expected the index of a vertex, or -1, got the end of the line"},
      {"a.ply", ply("ascii", kXyz + kOneStrip, kThree + "0\n"), "line 13: has no face"},
      {"a.ply", ply("ascii", kOneStrip + kXyz, ""), "has no vertices in front of the faces"},
      {"a.ply", ply("ascii", kOneFace + kXyz, ""), "has no vertices in front of the faces"},
      {"a.ply", ply("ascii", "element vertex 1\nproperty float x\n" + kOneFace, ""), "has vertices without x, y and z"},
      {"a.ply", ply("ascii", kXyz + "element face 1\nproperty int a\n", ""), "has faces without the list vertex_indices"},
      {"a.ply", ply("ascii", kXyz + "element face 1\nproperty list uchar float vertex_indices\n", ""),
       "line 8: has indices that are no whole numbers"},
      {"a.ply", ply("ascii", kXyz + "element face 1\nproperty list float int vertex_indices\n", ""),
       "line 8: has a list whose length is no whole number"},
      {"a.ply", ply("ascii", kXyz + kOneFace, "0 0 0\n1 0 0\n"), "line 11: the file ends here; expected vertex 2 of 3"},
      {"a.ply", ply("ascii", kXyz + kOneFace, kThree + "3 0 1 3\n"),
       "line 13: expected the index of a vertex, 2 at most, got \"3\""},
      {"a.ply", ply("ascii", kXyz + kOneFace, kThree + "3 0 1 -1\n"),
       "line 13: expected the index of a vertex, 2 at most, got \"-1\""},
      {"a.ply", ply("ascii", kXyz + kOneFace, kThree + "2 0 1\n"), "line 13: has a face of 2 corners; expected 3 or more"},
      {"a.ply", ply("ascii", kXyz + kOneFace + "property list uchar float texcoord\n", kThree + "3 0 1 2 5 0 0 0 0 0\n"),
       "line 14: has an odd number of numbers for the points of the texture"},
      {"a.ply", ply("ascii", kXyz + kOneFace + "property list uchar float texcoord\n", kThree + "3 0 1 2 4 0 0 0 0\n"),
       "line 14: has 2 points of the texture for 3 corners"},
      {"a.ply", ply("ascii", kXyz + kOneFace + "property list uchar float texcoord\n", kThree + "3 0 1 2 8 0 0 0 0 0 0 0 0\n"),
       "line 14: has 4 points of the texture for 3 corners"},
      {"a.ply", ply("ascii", kXyz + kOneFace, kThree + "3 0 1 2 0\n"), "line 13: expected the end of the line, got \"0\""},
      {"a.ply", ply("ascii", kXyz + kOneFace, kThree + "4000000000 0 1 2\n"),
       "line 13: expected the index of a vertex, 2 at most, got the end of the line"},
      {"a.ply", ply("ascii", kXyz + kOneFace, kThree + "3 0 1 2\nx"),
       "line 14: expected the end of the file after the last element, got \"x\""},
      {"a.ply", ply("ascii", kXyz + kOneFace, nulls), "line 10: expected a coordinate, got \"..."},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, kThree + "3 0 1 2\n"), "byte 193: the file is truncated"},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, nulls.substr(1)), "byte ..."},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, nulls), "byte 205: the file is truncated"},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, nulls + "\xFF"),
       "byte 205: declares a list of 255 numbers; the file is truncated"},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, nulls + "\6" + std::string(8, '\0')),
       "byte 205: declares a list of 6 numbers; the file is truncated"},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, nulls + "\3" + std::string(8, '\0') + std::string("\3\0\0\0", 4)),
       "byte 205: expected the index of a vertex, 2 at most, got 3"},
      {"a.ply", ply("binary_little_endian", kXyz + kOneFace, nulls + "\3" + std::string(8, '\0') + "\xFF\xFF\xFF\xFF"),
       "byte 205: expected the index of a vertex, 2 at most, got -1"},
      {"a.ply", ply("binary_big_endian", kXyz + kOneFace, std::string("\x7F\xC0\0\0", 4) + nulls),
       "byte 166: expected a coordinate within 10000 mm, got nan"},
  });
}

TEST(broken_mesh_files, of_stl_are_refused_in_words) {
  const std::string head(80, ' '),
      facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  expect_refused({
      {"a.stl", "", "is no STL file: expected the word solid, or 84 bytes and more"},
      {"a.stl", "soli", "is no STL file: expected the word solid, or 84 bytes and more"},
      {"a.stl", "solid", "line 1: the file ends here; expected facet or endsolid"},
      {"a.stl", "solid a\nendsolid a\n", "line 2: the file ends here; expected at least one face"},
      {"a.stl", "solidity\n", "line 1: expected solid, got \"solidity\""},
      {"a.stl", "solid a\n" + facet, "line 8: the file ends here; expected facet or endsolid"},
      {"a.stl", "solid a\n" + facet + "end\n", "line 9: expected endsolid, got \"end\""},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter ring\n", "line 3: expected loop, got \"ring\""},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n",
       "line 4: expected a coordinate, got the end of the line"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0 0\n", "line 4: expected the end of the line, got \"0\""},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nendloop\n",
       "line 6: expected vertex, got \"endloop\""},
      {"a.stl", "solid a\n" + facet.substr(0, facet.rfind("endfacet")) + facet, "line 8: expected endfacet, got \"facet\""},
      {"a.stl", "solid a\n" + facet + "endsolid\nhello\n", "line 10: expected solid, got \"hello\""},
      {"a.stl", head + std::string(4, '\0'), "has no face"},
      {"a.stl", head + std::string("\1\0\0\0", 4), "byte 80: declares 1 triangles, which take 134 bytes; the file has 84"},
      {"a.stl", head + "\xFF\xFF\xFF\xFF" + std::string(50, '\0'),
       "byte 80: declares 4294967295 triangles, which take 214748364834 bytes; the file has 134"},
      {"a.stl", head + std::string("\1\0\0\0", 4) + std::string(51, '\0'),
       "byte 80: declares 1 triangles, which take 134 bytes; the file has 135"},
      {"a.stl", head + std::string("\1\0\0\0", 4) + std::string(50, '\xFF'),
       "byte 96: expected a coordinate within 10000 mm, got ..."},
      {"a.stl", "solid " + std::string(74, 'x') + std::string("\2\0\0\0", 4) + std::string(50, '\0'),
       "byte 80: declares 2 triangles, which take 184 bytes; the file has 134"},
      {"a.stl", "; a comment\nsolid a\n" + facet + "endsolid a\n", "is no STL file: expected the word solid, got another text"},
      {"a.stl", "; f\xC3\xBCr\nsolid a\n" + facet, "is no STL file: expected the word solid, got another text"},
      {"a.stl", "\xEF\xBB\xBF; a comment\nsolid a\n" + facet, "is no STL file: expected the word solid, got another text"},
      {"a.stl", "solid\n" + std::string(20, '\0'), "is no STL file: expected the word solid, or 84 bytes and more"},
  });
}

long memory_KiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// A file takes no more memory for what it declares, or for long lines.
TEST(broken_mesh_files, take_memory_in_proportion_to_their_size) {
  const long before = memory_KiB();
  const std::string much = std::to_string(std::uint64_t{1} << 28);
  EXPECT_NE(of_text("a.off", "OFF\n" + much + " " + much + " 0\n" + kThree).refusal, "");
  EXPECT_NE(
      of_text("a.ply", ply("binary_little_endian",
                           "element vertex " + much + "\nproperty char x\nproperty char y\nproperty char z\nelement face " +
                               much + "\nproperty list uint int vertex_indices\n",
                           ""))
          .refusal,
      "");
  const std::string list = ply("binary_little_endian", kXyz + "element face 1\nproperty list uint int vertex_indices\n",
                               std::string(36, '\0') + "\xFF\xFF\xFF\x7F");
  EXPECT_TRUE(of_text("a.ply", list).refusal.ends_with("declares a list of 2147483647 numbers; the file is truncated"));
  EXPECT_LT(memory_KiB() - before, 20000);
}

// A list of one vertex a million times is a face of no area, not a long search.
TEST(broken_mesh_files, of_one_vertex_many_times_are_read_and_then_found_to_be_no_mesh) {
  std::string text = "OFF\n1000000 1000000 0\n";
  for (int i = 0; i < 1000000; ++i) text += "1 2 3\n";
  for (int i = 0; i < 1000000; ++i) text += "3 0 1 2\n";
  const Loaded loaded = of_text("a.off", text);
  ASSERT_EQ(loaded.refusal, "");
  const auto checked = check(loaded.mesh.mesh);
  const auto& counts = std::get<Findings>(checked).counts;
  EXPECT_EQ(counts[static_cast<std::size_t>(Fault::no_area)], 1000000U);
  EXPECT_EQ(counts[static_cast<std::size_t>(Fault::same_vertices)], 999999U);
}

}  // namespace
}  // namespace forceshade::mesh
