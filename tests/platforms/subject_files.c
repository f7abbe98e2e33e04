/* SPDX-License-Identifier: BSD-3-Clause */
/* Subject files, and the maps and meshes that they name, by the C interface of any build: writes them into this folder, and
 * compares their forces, to the bit, with those of the same numbers. Exit code 1 where something differs. */
#include <stdio.h>
#include <string.h>

#include "forceshade.h"

enum { kColumns = 4, kRows = 3, kSamples = kColumns * kRows };

/* In quarters of a millimetre, the row of the smallest y first. */
static const unsigned char kHeights[kSamples] = {0, 1, 0, 2, 3, 1, 0, 0, 0, 0, 4, 1};

static const float kCorners[12] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9};
static const uint32_t kTriangles[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
static const char kObj[] =
    "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n";
static const char kOff[] = "OFF\n4 4 6\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
static const char kStl[] =
    "solid\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 9 0\nvertex 9 0 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 0 9\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 9\nvertex 0 9 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 9 0 0\nvertex 0 9 0\nvertex 0 0 9\nendloop\nendfacet\n"
    "endsolid\n";
static const char kPly[] =
    "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar uint vertex_indices\nend_header\n";
static const char kTextPly[] =
    "ply\nformat ascii 1.0\nelement vertex %s\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uint uint vertex_indices\nend_header\n0 0 0\n9 0 0\n0 9 0\n%s\n";

static int faults = 0;

static int fails(const char* what) {
  printf("%s: %s\n", what, forceshade_message());
  return ++faults;
}

static void write(const char* name, const void* bytes, size_t count) {
  FILE* const file = fopen(name, "wb");
  if (file == NULL || fwrite(bytes, 1, count, file) != count || fclose(file) != 0) fails("a file cannot be written");
}

static void write_text(const char* name, const char* text) {
  write(name, text, strlen(text));
}

/* The smallest byte first, as the files say. */
static size_t put(unsigned char* at, uint32_t word) {
  for (int i = 0; i < 4; ++i) at[i] = (unsigned char)(word >> 8 * i);
  return 4;
}

static size_t put_float(unsigned char* at, float number) {
  uint32_t word;
  memcpy(&word, &number, sizeof word);
  return put(at, word);
}

static forceshade_result parse(const char* text, forceshade_subject* made) {
  return forceshade_subject_parse(text, strlen(text), "subject.toml", made);
}

/* An array of kSamples bytes, the row of the largest y first, whatever its head says. */
static void write_npy(const char* name, const char* head, const unsigned char* numbers) {
  unsigned char bytes[128] = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0, (unsigned char)strlen(head), 0};
  memcpy(bytes + 10, head, strlen(head));
  memcpy(bytes + 10 + strlen(head), numbers, kSamples);
  write(name, bytes, 10 + strlen(head) + kSamples);
}

static void write_maps(void) {
  unsigned char from_above[kSamples], pfm[64];
  for (size_t row = 0; row < kRows; ++row)
    memcpy(from_above + row * kColumns, kHeights + (kRows - 1 - row) * kColumns, kColumns);
  write_npy("map.npy", "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 4), }\n", from_above);
  const char beginning[] = "Pf\n4 3\n-1\n";
  memcpy(pfm, beginning, sizeof beginning - 1);
  size_t size = sizeof beginning - 1;
  for (size_t i = 0; i < kSamples; ++i) size += put_float(pfm + size, kHeights[i]);
  write("map.pfm", pfm, size);
}

static void write_meshes(void) {
  write_text("solid.obj", kObj);
  write_text("solid.off", kOff);
  write_text("solid.stl", kStl);
  unsigned char ply[512];
  size_t size = sizeof kPly - 1;
  memcpy(ply, kPly, size);
  for (size_t i = 0; i < 12; ++i) size += put_float(ply + size, kCorners[i]);
  for (size_t i = 0; i < 12; ++i) {
    if (i % 3 == 0) ply[size++] = 3;
    size += put(ply + size, kTriangles[i]);
  }
  write("solid.ply", ply, size);
}

/* Over the map and beyond its edges; some positions are in contact. */
static void expect_same_forces(const char* what, forceshade_subject a, forceshade_subject b) {
  int contacts = 0;
  for (float x = -5; x <= 5; x += 0.625f)
    for (float y = -4; y <= 4; y += 0.625f) {
      const float position[3] = {x, y, 0.125f};
      float one[3], other[3];
      forceshade_status status;
      if (forceshade_force(a, position, one, &status) != FORCESHADE_OK) fails(what);
      if (forceshade_force(b, position, other, NULL) != FORCESHADE_OK) fails(what);
      if (memcmp(one, other, sizeof one) != 0) fails(what);
      contacts += status == FORCESHADE_CONTACT;
    }
  if (contacts == 0) fails("no position is in contact");
}

static void expect_map(const char* file, const char* interpolant) {
  char text[512];
  sprintf(text,
          "render = \"height-map\"\n[[part]]\nshape = \"grid\"\nfile = \"%s\"\npitch_mm = 2\nscale_mm = 0.25\ninterpolant = "
          "\"%s\"\n",
          file, interpolant);
  write_text("map.toml", text);
  float heights[kSamples];
  for (size_t i = 0; i < kSamples; ++i) heights[i] = 0.25f * (float)kHeights[i];
  const forceshade_height_map numbers = {sizeof numbers, heights, kColumns, kRows, 4, 4 * kColumns, 2,
                                         interpolant,    NULL,    NULL,     0.5f};
  forceshade_subject read, made;
  if (parse("height-map = \"map.toml\"\nstiffness = \"0.5N/mm\"\n", &read) != FORCESHADE_OK ||
      forceshade_height_map_new(&numbers, &made) != FORCESHADE_OK) {
    fails(file);
    return;
  }
  expect_same_forces(file, read, made);
}

/* With U = 3 exp(-(9 + 1)/50) the exact force is 0.48640946567638..., 0.16213648855879..., 1.65028295270096... N. */
static void expect_analytic_map(void) {
  write_text("hill.toml", "render = \"height-map\"\n[[part]]\nshape = \"gaussian\"\nheight_mm = 3\nsigma_mm = 5\n");
  write_text("hill_subject.toml", "height-map = \"hill.toml\"\nstiffness = 0.5\n");
  forceshade_subject hill;
  const float position[3] = {3, 1, -1}, expected[3] = {0x1.f21552p-2f, 0x1.4c0e38p-3f, 0x1.a678f2p+0f};
  float force[3];
  if (forceshade_subject_read("hill_subject.toml", &hill) != FORCESHADE_OK) {
    fails("an analytic map");
    return;
  }
  if (forceshade_force(hill, position, force, NULL) != FORCESHADE_OK || memcmp(force, expected, sizeof force) != 0)
    fails("the force of an analytic map");
}

static void expect_mesh(const char* file) {
  char text[128];
  sprintf(text, "mesh = \"%s\"\nunit = \"mm\"\nshading = \"vertex\"\nstiffness = 0.5\n", file);
  const forceshade_mesh numbers = {.size = sizeof numbers,
                                   .vertices = kCorners,
                                   .vertex_count = 4,
                                   .triangles = kTriangles,
                                   .triangle_count = 4,
                                   .crease = 180,
                                   .stiffness = 0.5f};
  forceshade_subject read, made;
  forceshade_session one, other;
  if (parse(text, &read) != FORCESHADE_OK || forceshade_mesh_new(&numbers, &made) != FORCESHADE_OK ||
      forceshade_session_open(read, &one) != FORCESHADE_OK || forceshade_session_open(made, &other) != FORCESHADE_OK) {
    fails(file);
    return;
  }
  int contacts = 0;
  for (float x = -1; x < 2; x += 0.25f) {
    const float position[3] = {x, 1 + x, 2};
    float force[3], expected[3];
    forceshade_status status;
    if (forceshade_session_step(one, position, force, &status) != FORCESHADE_OK) fails(file);
    if (forceshade_session_step(other, position, expected, NULL) != FORCESHADE_OK) fails(file);
    if (memcmp(force, expected, sizeof force) != 0) fails(file);
    contacts += status == FORCESHADE_CONTACT;
  }
  if (contacts == 0) fails("no step is in contact");
}

/* The message names what is at fault: the file, and the number or the feature. */
static void expect_refused(forceshade_result expected, const char* file, const char* part, const char* subject) {
  forceshade_subject none;
  const forceshade_result result = parse(subject, &none);
  if (result != expected || strstr(forceshade_message(), file) == NULL || strstr(forceshade_message(), part) == NULL)
    fails(file);
}

static void expect_map_refused(forceshade_result expected, const char* file, const char* part) {
  char text[256];
  sprintf(text, "render = \"height-map\"\n[[part]]\nshape = \"grid\"\nfile = \"%s\"\npitch_mm = 2\nscale_mm = 0.25\n", file);
  write_text("map.toml", text);
  expect_refused(expected, file, part, "height-map = \"map.toml\"\n");
}

static void expect_mesh_refused(const char* file, const char* bytes, const char* part) {
  char text[128];
  write_text(file, bytes);
  sprintf(text, "mesh = \"%s\"\nunit = \"mm\"\n", file);
  expect_refused(FORCESHADE_BAD_INPUT, file, part, text);
}

/* A size_t of 32 bits would take each of these numbers for one that fits: 4294967299 for 3. */
static void expect_large_numbers_refused(void) {
  char text[512];
  write_text("wide.pfm", "Pf\n4294967300 3\n-1\n            ");
  expect_map_refused(FORCESHADE_BAD_INPUT, "wide.pfm", "4294967300");
  write_npy("wide.npy", "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 4294967300), }\n", kHeights);
  expect_map_refused(FORCESHADE_BAD_INPUT, "wide.npy", "4294967300");
  expect_mesh_refused("vertices.off", "OFF\n4294967299 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n", "4294967299");
  expect_mesh_refused("faces.off", "OFF\n3 4294967297 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n", "4294967297");
  expect_mesh_refused("corner.off", "OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 4294967298\n", "4294967298");
  expect_mesh_refused("corner.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 4294967299\n", "4294967299");
  sprintf(text, kTextPly, "4294967299", "3 0 1 2");
  expect_mesh_refused("vertices.ply", text, "4294967299");
  sprintf(text, kTextPly, "3", "4294967299 0 1 2");
  expect_mesh_refused("corners.ply", text, "4294967299");
}

/* With the feature, the beginning of a picture is refused as any bad file is. */
static void expect_left_out(void) {
  const forceshade_result pictures = forceshade_has("image-files") ? FORCESHADE_BAD_INPUT : FORCESHADE_LEFT_OUT;
  const char* const feature = forceshade_has("image-files") ? "" : "image-files";
  write("picture.png", "\x89PNG\r\n\x1a\n", 8);
  write("picture.tiff", "II*\0\0\0\0\0", 8);
  expect_map_refused(pictures, "picture.tiff", feature);
  expect_map_refused(pictures, "picture.png", feature);
  expect_refused(pictures, "picture.png", feature,
                 "mesh = \"solid.obj\"\nunit = \"mm\"\nshading = \"texture:map.toml\"\ntexture-scale = 1\n");
  write_text("poses.csv", "time_s,x_mm\n");
  write_text("scene.toml", "[[object]]\nname = \"it\"\nmotion = \"poses.csv\"\nmesh = \"solid.off\"\nunit = \"mm\"\n");
  const int has_csv = forceshade_has("csv-files");
  expect_refused(has_csv ? FORCESHADE_BAD_INPUT : FORCESHADE_LEFT_OUT, "poses.csv", has_csv ? "y_mm" : "csv-files",
                 "scene = \"scene.toml\"\n");
}

int main(void) {
  forceshade_subject law, bump;
  const forceshade_law parameters = {sizeof parameters, 15.24f, 25.4f, 0.5f};
  if (parse("law = \"bump-2p\"\nradius = \"600mil\"\nwidth = \"1in\"\n", &law) != FORCESHADE_OK) return fails("a law");
  if (forceshade_law_new("bump-2p", &parameters, &bump) != FORCESHADE_OK) return fails("a law");
  expect_same_forces("a law", law, bump);

  write_maps();
  write_meshes();
  expect_analytic_map();
  const char* const maps[] = {"map.npy", "map.pfm"};
  for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i) {
    expect_map(maps[i], "bilinear");
    expect_map(maps[i], "cubic-spline");
  }
  const char* const meshes[] = {"solid.obj", "solid.off", "solid.ply", "solid.stl"};
  for (size_t i = 0; i < sizeof meshes / sizeof *meshes; ++i) expect_mesh(meshes[i]);
  expect_map_refused(FORCESHADE_BAD_INPUT, "none.npy", "cannot be opened");
  expect_large_numbers_refused();
  expect_left_out();
  printf("%d faults\n", faults);
  return faults == 0 ? 0 : 1;
}
