/* SPDX-License-Identifier: BSD-3-Clause */
/* What a build of the C interface has, and that what it has not is a result and no crash. Prints the force of the header's example
 * and "features: " with those of cmake/features.cmake. Exit code 1 where an answer is wrong. */
#include <stdio.h>
#include <string.h>

#include "forceshade.h"

static const char* const kOptional[] = {"device-loop", "subject-files", "image-files", "csv-files", "certificates", "exact-side"};

static int wrong(const char* what) {
  printf("%s: %s\n", what, forceshade_message());
  return 1;
}

/* Without the feature a function says that it is left out, and why; with it, another error of these arguments. */
static int is_left_out_like(const char* feature, forceshade_result result) {
  const int is_left_out = result == FORCESHADE_LEFT_OUT && strstr(forceshade_message(), feature) != NULL;
  return forceshade_has(feature) ? result != FORCESHADE_LEFT_OUT : is_left_out;
}

int main(void) {
  const char* always[] = {"laws", "height-maps", "meshes", "corner-normals", "states", "scenes"};
  for (size_t i = 0; i < sizeof always / sizeof *always; ++i)
    if (forceshade_has(always[i]) != 1) return wrong(always[i]);

  forceshade_law parameters = {sizeof parameters, 15.24f, 25.4f, 0.5f};
  forceshade_subject bump, map, solid, none;
  float position[3] = {3, 0, -0.5f}, force[3];
  if (forceshade_law_new("bump-2p", &parameters, &bump) != FORCESHADE_OK) return wrong("law");
  if (forceshade_force(bump, position, force, NULL) != FORCESHADE_OK) return wrong("force");
  printf("%g N\n", (double)force[2]);

  const float heights[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0};
  const forceshade_height_map grid = {sizeof grid, heights, 3, 3, 4, 12, 2, NULL, NULL, NULL, 0.5f};
  if (forceshade_height_map_new(&grid, &map) != FORCESHADE_OK) return wrong("height map");
  if (forceshade_force(map, position, force, NULL) != FORCESHADE_OK) return wrong("force of the height map");

  const float corners[12] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9};
  const uint32_t triangles[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  forceshade_mesh tetrahedron = {0};
  tetrahedron.size = sizeof tetrahedron;
  tetrahedron.vertices = corners;
  tetrahedron.vertex_count = 4;
  tetrahedron.triangles = triangles;
  tetrahedron.triangle_count = 4;
  tetrahedron.shading = "edge";
  tetrahedron.stiffness = 0.5f;
  forceshade_session path;
  if (forceshade_mesh_new(&tetrahedron, &solid) != FORCESHADE_OK) return wrong("mesh");
  if (forceshade_session_open(solid, &path) != FORCESHADE_OK) return wrong("session");
  const float outside[3] = {-1, 1, 1}, inside[3] = {0.5f, 1, 1};
  forceshade_status status;
  if (forceshade_session_step(path, outside, force, NULL) != FORCESHADE_OK) return wrong("step");
  if (forceshade_session_step(path, inside, force, &status) != FORCESHADE_OK || status != FORCESHADE_CONTACT) return wrong("contact");
  printf("%g N\n", (double)force[0]);

  if (!is_left_out_like("subject-files", forceshade_subject_read("none.toml", &none))) return wrong("subject-files");
  if (!is_left_out_like("subject-files", forceshade_subject_parse("", 0, "none.toml", &none))) return wrong("subject-files");
  if (!is_left_out_like("certificates", forceshade_certificate_covers("none.json", bump))) return wrong("certificates");
  char digest[65];
  size_t length;
  if (forceshade_subject_text(map, FORCESHADE_DIGEST, digest, sizeof digest, &length) != FORCESHADE_OK) return wrong("digest");
  if (length != (forceshade_has("certificates") ? 64u : 0u)) return wrong("the length of a digest");
  /* At each vertex of an octahedron two components of the normal are sums that cancel, so that binary64 leaves them in doubt, and
     intervals decide. */
  const float ends[18] = {5, 0, 0, -5, 0, 0, 0, 5, 0, 0, -5, 0, 0, 0, 5, 0, 0, -5};
  const uint32_t faces[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  forceshade_mesh octahedron = tetrahedron;
  octahedron.vertices = ends;
  octahedron.vertex_count = 6;
  octahedron.triangles = faces;
  octahedron.triangle_count = 8;
  octahedron.shading = "vertex";
  octahedron.crease = 180;
  if (forceshade_mesh_new(&octahedron, &solid) != FORCESHADE_OK) return wrong("mesh with normals that binary64 leaves in doubt");

  printf("features:");
  for (size_t i = 0; i < sizeof kOptional / sizeof *kOptional; ++i)
    if (forceshade_has(kOptional[i])) printf(" %s", kOptional[i]);
  puts("");
  return 0;
}
