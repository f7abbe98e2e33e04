// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files of each format: the same square of two triangles in every way that a format has to write it.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "tests/meshes/loaded.h"

namespace forceshade::mesh {
namespace {

const std::vector<Vertex> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> kTwo{{0, 1, 2}, {0, 2, 3}};
const std::vector<std::array<Normal, 3>> kUp{{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}, {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}};
// The point of the texture of each corner is x, y of its vertex.
const std::vector<std::array<TexturePoint, 3>> kFlat{{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}};

void expect_square(const Loaded& got, const std::string& text) {
  EXPECT_EQ(got.refusal, "") << text;
  EXPECT_EQ(got.mesh.mesh.vertices, kSquare) << text;
  EXPECT_EQ(got.mesh.mesh.triangles, kTwo) << text;
  for (const Vertex& vertex : got.mesh.mesh.vertices)
    for (const float x : vertex) EXPECT_FALSE(std::signbit(x)) << "no coordinate is -0: " << text;
}

void expect_square_alone(const Loaded& got, const std::string& text) {
  expect_square(got, text);
  EXPECT_TRUE(got.mesh.normals.empty() && got.mesh.texture.empty() && got.mesh.notes.empty()) << text;
}

void expect_split(const Loaded& got, const std::string& text) {
  expect_square(got, text);
  const std::string words = "1 faces with more than 3 corners are split into triangles, each from the face's first corner";
  EXPECT_EQ(got.mesh.notes, std::vector<std::string>{words}) << text;
}

TEST(mesh_files, of_off_have_their_vertices_and_triangles_in_order) {
  const std::string square = "0 0 0\n1 0 0\r\n1\t1 0\n\n0 1e0 -0 # corner\n";
  for (const char* head :
       {"OFF\n4 2 0\n", "OFF 4 2 0\n", "OFF 4 2\n", "# a comment\n\nOFF # too\n\n4 2 5 # and here\n", "COFF\r\n4 2 0\r\n"}) {
    const std::string text = head + square + "3 0 1 2 0.5 0.5 0.5\n3 0 2 3";
    expect_square_alone(of_text("a.off", text), text);
  }
  const std::string polygon = "OFF 4 1 0\n" + square + "4 0 1 2 3 255 0 0\n";
  expect_split(of_text("a.OFF", polygon), polygon);
}

// Line ends mean nothing to OFF, but that a colour ends with its line.
TEST(mesh_files, of_off_are_words_between_white_space) {
  for (const std::string text :
       {"OFF4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
        "OFF\n4 2 0\n0 0 0\n1 0\n0\n1 1 0\n0\n1\n0\n3 0 1\n2\n3 0\n2\n3\n",
        "OFF\n4 2 0\n0 0 0 9 9\n1 0 0\n1 1 0\n0 1 0\n3 0 1\n2 0.5 0.5 0.5\n3 0 2\n3 # last\n",
        "OFF\n4\n2\n0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n", "OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3",
        "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2\n3 0 2 3\n",
        "COFF\n4 2 0\n0 0 0 1 1 1 1 1 0 0 1 1 1 1\n1 1 0 1 1 1 1 0 1 0 1 1 1 1 3 0 1 2\n3 0 2 3"})
    expect_square_alone(of_text("a.off", text), text);
  const Loaded both = of_text("a.off",
                              "STCNOFF 4 2 0\n0 0 0 0 0 1 9 9 9 9 0 0 1 0 0 0 0 1 9 9 9 9 1 0 1 1 0 0 0 1 9 9 9 9 1 1\n"
                              "0 1 0 0 0 1 9 9 9 9 0 1 3 0 1 2 3 0 2 3\n");
  expect_square(both, "STCNOFF");
  EXPECT_EQ(both.mesh.normals, kUp);
  EXPECT_EQ(both.mesh.texture, kFlat);
}

TEST(mesh_files, of_off_may_have_normals_and_a_texture) {
  const Loaded normals =
      of_text("a.off", "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n3 0 2 3\n");
  expect_square(normals, "NOFF");
  EXPECT_EQ(normals.mesh.normals, kUp);
  const Loaded both = of_text("a.off",
                              "STCNOFF\n4 2 0\n0 0 0 0 0 1 9 9 9 9 0 0\n1 0 0 0 0 1 9 9 9 1 0\n1 1 0 0 0 1 9 9 9 9 1 1\n"
                              "0 1 0 0 0 1 0 1\n3 0 1 2\n3 0 2 3\n");
  expect_square(both, "STCNOFF");
  EXPECT_EQ(both.mesh.normals, kUp);
  EXPECT_EQ(both.mesh.texture, kFlat);
}

TEST(mesh_files, of_obj_have_faces_in_every_way_of_counting) {
  const std::string vertices = "mtllib a.mtl\no square\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 -0\n";
  for (const char* faces : {"f 1 2 3\nf 1 3 4\n", "f -4 -3 -2\ns off\nf -4 -2 -1", "f 1 2 \\\n 3\nf 1 \\\r\n3 \\\n4 # end\n",
                            "l 1 2\np 1\ng a b\nusemtl c\nf 1// 2// 3//\nf 1 3 4\n"}) {
    const std::string text = vertices + faces;
    expect_square_alone(of_text("a.obj", text), text);
  }
  expect_split(of_text("a.obj", vertices + "f 1 2 3 4\n"), "4 corners");
}

// As some editors write it in front of a text.
TEST(mesh_files, may_begin_with_a_byte_order_mark) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
                                   {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                                   {"a.stl",
                                    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                    "endloop\nendfacet\nendsolid a\n"}}) {
    const auto read = of_text(name, mark + text);
    EXPECT_EQ(read.refusal, "") << name;
    EXPECT_EQ(read.mesh.mesh.triangles, of_text(name, text).mesh.mesh.triangles) << name;
    const std::size_t second = text.find('\n') + 1;
    for (const std::string& wrong : {mark + mark + text, text.substr(0, second) + mark + text.substr(second)})
      EXPECT_NE(of_text(name, wrong).refusal, "") << name;
  }
}

TEST(mesh_files, with_a_face_of_too_many_corners_are_refused_at_once) {
  const auto text_of = [](std::size_t corners) {
    std::string text = "v 9 9 9\nv 9 8 9\nv 8 9 9\nf 1 2 3\n", face = "f";
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 6.283185307 * static_cast<double>(i) / static_cast<double>(corners);
      text += "v " + std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + " 0\n";
      face += ' ' + std::to_string(i + 4);
    }
    return text + face + '\n';
  };
  EXPECT_EQ(of_text("a.obj", text_of(4096)).refusal, "");
  EXPECT_NE(of_text("a.obj", text_of(4097)).refusal.find("face 2 has 4097 corners; expected at most 4096"), std::string::npos);
}

TEST(mesh_files, of_obj_may_have_normals_and_a_texture) {
  const std::string lists = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1\nvt 1 1 0\nvt 0 1\nvn 0 0 1\n";
  const Loaded both = of_text("a.obj", lists + "f 1/1/1 2/2/1 3/3/-1\nf 1/1/1 3/3/1 4/-1/1\n");
  expect_square(both, "both");
  EXPECT_EQ(both.mesh.normals, kUp);
  EXPECT_EQ(both.mesh.texture, kFlat);
  EXPECT_TRUE(both.mesh.notes.empty());
  const Loaded texture = of_text("a.obj", lists + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  EXPECT_TRUE(texture.mesh.normals.empty());
  EXPECT_EQ(texture.mesh.texture, kFlat);
  const Loaded normals = of_text("a.obj", lists + "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
  EXPECT_EQ(normals.mesh.normals, kUp);
  EXPECT_TRUE(normals.mesh.texture.empty());
  const Loaded some = of_text("a.obj", lists + "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4\n");
  expect_square(some, "some");
  EXPECT_TRUE(some.mesh.normals.empty());
  EXPECT_EQ(some.mesh.texture, kFlat);
  EXPECT_EQ(some.mesh.notes, std::vector<std::string>{"normals are not used: face 2 has none at a corner"});
}

TEST(mesh_files, of_ply_are_text_or_binary_in_either_order) {
  const std::string elements =
      "comment made by hand\nelement vertex 4\nproperty uchar red\nproperty double x\nproperty float y\nproperty list uchar "
      "short "
      "neighbours\nproperty float32 z\nelement thing 2\nproperty list int8 double numbers\nproperty int n\nobj_info none\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty uint8 flags\nend_header\n";
  const std::string ascii = "ply\nformat ascii 1.0\n" + elements +
                            "255 0 0 0 -0\n1 1 0 2 7 8 0\n2 1 1 1 5 0\n3 0 1 0 0\n0 5\n2 1.5 nan -7\n3 0 1 2 9\n3 0 2 3 9\n";
  expect_square_alone(of_text("a.ply", ascii), ascii);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const auto add = [&](std::string& text, auto... numbers) { ((text += bytes_of(numbers, order)), ...); };
    std::string text = "ply\r\nformat binary_";
    text += (order == std::endian::little ? "little" : "big") + std::string("_endian 1.0\r\n");
    for (const char c : elements) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    using U1 = std::uint8_t;
    using I2 = std::int16_t;
    add(text, U1{255}, 0.0, 0.0F, U1{0}, -0.0F);
    add(text, U1{1}, 1.0, 0.0F, U1{2}, I2{7}, I2{8}, 0.0F);
    add(text, U1{2}, 1.0, 1.0F, U1{1}, I2{5}, 0.0F);
    add(text, U1{3}, 0.0, 1.0F, U1{0}, 0.0F);
    add(text, U1{0}, 5, U1{2}, 1.5, std::nan(""), -7);
    add(text, U1{3}, 0, 1, 2, U1{9}, U1{3}, 0, 2, 3, U1{9});
    expect_square_alone(of_text("a.ply", text), "binary");
    EXPECT_TRUE(of_text("a.ply", text + "1").refusal.ends_with("the file goes on for 1 bytes after its last element"));
    for (std::size_t size = 0; size < text.size(); ++size)
      EXPECT_NE(of_text("a.ply", text.substr(0, size)).refusal, "") << size;
  }
  const std::string polygon =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar uint vertex_index\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  expect_split(of_text("a.ply", polygon), polygon);
}

TEST(mesh_files, of_ply_may_have_normals_and_a_texture) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
  const Loaded of_vertices = of_text("a.ply", head +
                                                  "property float nx\nproperty float ny\nproperty float nz\nproperty float s\n"
                                                  "property float t\n" +
                                                  faces +
                                                  "end_header\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n"
                                                  "0 1 0 0 0 1 0 1\n3 0 1 2\n3 0 2 3\n");
  expect_square(of_vertices, "of vertices");
  EXPECT_EQ(of_vertices.mesh.normals, kUp);
  EXPECT_EQ(of_vertices.mesh.texture, kFlat);
  const Loaded of_corners = of_text("a.ply", head + faces +
                                                 "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                                 "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0 1\n");
  expect_square(of_corners, "of corners");
  EXPECT_EQ(of_corners.mesh.texture, kFlat);
}

// As scanners of Cyberware and Stanford's repository write it.
TEST(mesh_files, of_ply_may_have_strips_of_triangles) {
  const std::string vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const auto head = [&](const std::string& format, const std::string& type, int strips) {
    return "ply\nformat " + format + " 1.0\n" + vertices + "element tristrips " + std::to_string(strips) +
           "\nproperty list int " + type + " vertex_indices\nend_header\n";
  };
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  for (const std::string body : {"7 0 1 2 -1 0 2 3\n", "8 0 1 2 -1 0 2 3 -1\n", "9 -1 0 1 2 -1 -1 0 2 3\n"})
    expect_square_alone(of_text("a.ply", head("ascii", "int", 1) + square + body), body);
  expect_square_alone(of_text("a.ply", head("ascii", "int", 2) + square + "3 0 1 2\n3 0 2 3\n"), "two lists");
  // Every second triangle is turned over, and a -1 turns none; a vertex twice joins two strips.
  const auto triangles_of = [&](const std::string& body) {
    return of_text("a.ply", head("ascii", "int", 1) + square + body).mesh.mesh.triangles;
  };
  EXPECT_EQ(triangles_of("4 1 2 0 3\n"), (std::vector<Triangle>{{1, 2, 0}, {0, 2, 3}}));
  EXPECT_EQ(triangles_of("8 1 2 0 3 -1 1 2 0\n"), (std::vector<Triangle>{{1, 2, 0}, {0, 2, 3}, {1, 2, 0}}));
  EXPECT_EQ(triangles_of("6 0 1 2 2 3 0\n"), (std::vector<Triangle>{{0, 1, 2}, {3, 2, 0}}));
  EXPECT_EQ(triangles_of("6 0 1 2 1 3 0\n"), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 1, 0}}));
  for (const std::endian order : {std::endian::little, std::endian::big})
    for (const std::string type : {"int", "uint"}) {
      std::string body;
      for (const Vertex& vertex : kSquare)
        for (const float x : vertex) body += bytes_of(x, order);
      for (const std::int32_t number : {7, 0, 1, 2, -1, 0, 2, 3}) body += bytes_of(number, order);
      const std::string format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
      expect_square_alone(of_text("a.ply", head(format, type, 1) + body), format + ' ' + type);
    }
}

// An element begins with a line and may go on in others; behind its end the line has nothing.
TEST(mesh_files, of_ply_may_have_blank_lines_and_elements_over_several) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (const std::string body :
       {"\n0 0 0\n1 0 0\n \n1 1 0\n0 1 0\n\n3 0 1 2\r\n\r\n3 0 2 3\n\n", "0 0 0\n1 0\n0\n1 1 0\n0\n\n1\n0\n3\n0 1 2\n3 0 2\n3"})
    expect_square_alone(of_text("a.ply", head + body), body);
  EXPECT_EQ(of_text("a.ply", head + "0 0 0\n1 0\n1 1 0 0\n0 1 0\n3 0 1 2\n3 0 2 3\n").refusal,
            "line 11: expected a coordinate, got the end of the line");
}

TEST(mesh_files, of_obj_and_ply_may_name_their_faces) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", quad = "f 1 2 3 4\n", three = "f 1 2 3\n";
  using Names = std::vector<std::string>;
  using Places = std::vector<std::uint32_t>;
  constexpr std::uint32_t kNone = FaceNames::kNone;
  const LoadedMesh its = of_text("a.obj", corners + three + "usemtl never\nusemtl  red paint \ng a b # c\n" + quad +
                                              "usemtl blue\ng\n" + three + "usemtl red paint\n" + three + "usemtl\n" + three)
                             .mesh;
  EXPECT_EQ(its.materials.names, (Names{"red paint", "blue"}));
  EXPECT_EQ(its.materials.of_triangle, (Places{kNone, 0, 0, 1, 0, kNone})) << "a face of 4 corners is two triangles";
  EXPECT_EQ(its.groups.names, Names{"a b"});
  EXPECT_EQ(its.groups.of_triangle, (Places{kNone, 0, 0, kNone, kNone, kNone}));
  const LoadedMesh unnamed = of_text("a.obj", corners + "usemtl red\nusemtl\n" + quad).mesh;
  EXPECT_TRUE(unnamed.materials.names.empty() && unnamed.materials.of_triangle.capacity() == 0);

  const auto ply = [](const std::string& property, const std::string& first, const std::string& second) {
    return of_text(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
        "property list uchar int vertex_indices\nproperty " +
            property + "\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 " + first + "\n3 0 2 3 " + second + '\n');
  };
  for (const char* property : {"int material", "short material_index"}) {
    const Loaded got = ply(property, "7", "-1");
    expect_square_alone(got, property);
    EXPECT_EQ(got.mesh.materials.names, (Names{"7", "-1"}));
    EXPECT_EQ(got.mesh.materials.of_triangle, (Places{0, 1}));
  }
  EXPECT_TRUE(ply("float material", "7", "1").mesh.materials.names.empty());
  EXPECT_TRUE(ply("int material", "7", "1.5").refusal.ends_with("expected the whole number of a material, got \"1.5\""));
  EXPECT_NE(ply("int material\nproperty int material_index", "7 1", "7 1").refusal.find("another name of the same"),
            std::string::npos);
  std::string binary =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "1\n"
      "property uint material\nproperty list uchar uchar vertex_indices\nend_header\n";
  for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F}) binary += bytes_of(x, std::endian::big);
  binary += bytes_of(std::uint32_t{4000000000}, std::endian::big) + std::string("\3\0\1\2", 4);
  EXPECT_EQ(of_text("a.ply", binary).mesh.materials.names, Names{"4000000000"});
}

std::string binary_stl(const std::string& head, const std::vector<Vertex>& corners) {
  std::string text = head;
  text.resize(80, ' ');
  text += bytes_of(static_cast<std::uint32_t>(corners.size() / 3), std::endian::little);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) text += std::string(12, '\xFF');  // a normal of NaN
    for (const float x : corners[i]) text += bytes_of(x, std::endian::little);
    if (i % 3 == 2) text += std::string(2, '\x7F');
  }
  return text;
}

TEST(mesh_files, of_stl_have_vertices_with_equal_coordinates_once) {
  const std::string words = "STL repeats its vertices: of 6, those with equal coordinates are one, 4 in all";
  std::string text;
  for (const std::string& head :
       {std::string("solid a\n"), std::string("SOLID\n\n"), std::string("\n \r\n\tsolid a\n"),
        std::string("\xEF\xBB\xBF\nsolid a\n"), std::string(200, '\n') + std::string(300, ' ') + "solid a\n"}) {
    text = head;
    for (const char* facet :
         {"vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n", "vertex 0 0 -0\n vertex\t1e0 1 1e-20\nVertex 0 1 0\n"})
      text += std::string(" facet normal 0 0 nan\n  outer loop\n") + facet + "endloop\n Endfacet\n";
    const Loaded got = of_text("a.stl", text + "endsolid a");
    expect_square(got, text);
    EXPECT_EQ(got.mesh.notes, std::vector<std::string>{words});
  }
  const std::vector<Vertex> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, -0.0F, 0}, {1, 1, 1e-20F}, {0, 1, 0}};
  for (const char* head : {"", "solid that is binary"}) {
    const Loaded got = of_text("a.stl", binary_stl(head, corners));
    expect_square(got, head);
    EXPECT_EQ(got.mesh.notes, std::vector<std::string>{words});
  }
  // More vertices than the first table has room for.
  std::vector<Vertex> many;
  for (int i = 0; i < 5000; ++i)
    for (const Vertex& vertex : {Vertex{0, 0, 0}, Vertex{static_cast<float>(i + 1), 0, 0}, Vertex{static_cast<float>(i), 1, 0}})
      many.push_back(vertex);
  const Loaded got = of_text("a.stl", binary_stl("", many));
  EXPECT_EQ(got.mesh.mesh.vertices.size(), 10001U);
  ASSERT_EQ(got.mesh.mesh.triangles.size(), 5000U);
  for (std::size_t i = 0; i < many.size(); ++i)
    EXPECT_EQ(got.mesh.mesh.vertices[got.mesh.mesh.triangles[i / 3][i % 3]], many[i]) << i;
}

// Line ends mean nothing to STL, but that the name of a solid ends with its line, unless "facet normal" ends it.
TEST(mesh_files, of_stl_are_words_between_white_space) {
  const std::string first = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 endloop endfacet",
                    second = "facet normal\n0 0 1\nouter\nloop vertex 0\n0 0 vertex 1 1\n0\nvertex 0 1 0 endloop\nendfacet";
  for (const std::string& text :
       {"solid a " + first + ' ' + second + " endsolid a\n", "solid a\n" + first + "\n" + second + "\nendsolid a",
        "solid\n" + first + "\nendsolid\nsolid b facet " + second + " endsolid b # last\n"}) {
    const Loaded got = of_text("a.stl", text);
    expect_square(got, text);
    EXPECT_EQ(got.mesh.lines.size(), 2U) << text;
  }
  for (const std::string& text :
       {"solid a " + first + "\n" + second + "\nendsolid\n", "solid a\n" + first + ' ' + second + "\nendsolid\n"}) {
    const Loaded got = of_text("a.stl", text);
    expect_square(got, text);
    EXPECT_EQ(got.mesh.lines.size(), 2U) << text;
  }
  EXPECT_EQ(of_text("a.stl", "solid a " + first + " endsolid a solid b " + first + " endsolid b\n").refusal,
            "line 1: expected the end of the line, got \"facet\"")
      << "no solid is left out";
}

}  // namespace
}  // namespace forceshade::mesh
