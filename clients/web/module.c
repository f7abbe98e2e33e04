/* SPDX-License-Identifier: BSD-3-Clause */
/* The C interface with arguments that JavaScript can give: numbers and addresses, and handles by the address of one.
 * include/forceshade.h describes each function and its result; interface.js is its only caller. */
#include <emscripten.h>
#include <stdlib.h>

#include "forceshade.h"

#define EXPORTED EMSCRIPTEN_KEEPALIVE

EXPORTED forceshade_result web_law(const char* law, float radius, float width, float stiffness, forceshade_subject* made) {
  const forceshade_law parameters = {sizeof parameters, radius, width, stiffness};
  return forceshade_law_new(law, &parameters, made);
}

EXPORTED forceshade_result web_height_map(const float* heights, uint32_t columns, uint32_t rows, float pitch,
                                          const char* interpolant, const char* edge, const char* render, float stiffness,
                                          forceshade_subject* made) {
  const forceshade_height_map map = {
      sizeof map, heights,     columns, rows,   sizeof(float), (ptrdiff_t)(columns * sizeof(float)),
      pitch,      interpolant, edge,    render, stiffness};
  return forceshade_height_map_new(&map, made);
}

/* materials: for each its stiffness, static and dynamic friction. */
EXPORTED forceshade_result web_mesh(const float* vertices, size_t vertex_count, const uint32_t* triangles,
                                    size_t triangle_count, const char* sides, const char* shading, const char* contact,
                                    double crease, float stiffness, int32_t self_intersecting, const float* materials,
                                    size_t material_count, const uint32_t* material_of_triangle, forceshade_subject* made) {
  forceshade_material* const list = malloc((material_count + 1) * sizeof *list);
  if (list == NULL) return FORCESHADE_NO_MEMORY;
  for (size_t i = 0; i < material_count; ++i)
    list[i] = (forceshade_material){sizeof *list, materials[3 * i], materials[3 * i + 1], materials[3 * i + 2]};
  const forceshade_mesh mesh = {.size = sizeof mesh,
                                .vertices = vertices,
                                .vertex_count = vertex_count,
                                .triangles = triangles,
                                .triangle_count = triangle_count,
                                .sides = sides,
                                .shading = shading,
                                .contact = contact,
                                .crease = crease,
                                .stiffness = stiffness,
                                .self_intersecting = self_intersecting,
                                .materials = list,
                                .material_count = material_count,
                                .material_of_triangle = material_of_triangle};
  const forceshade_result result = forceshade_mesh_new(&mesh, made);
  free(list);
  return result;
}

EXPORTED forceshade_result web_subject_free(const forceshade_subject* subject) {
  return forceshade_subject_free(*subject);
}

EXPORTED forceshade_result web_subject_text(const forceshade_subject* subject, int32_t what, char* text, size_t size,
                                            size_t* length) {
  return forceshade_subject_text(*subject, what, text, size, length);
}

/* Without gaps: three floats for each position and force, a byte for each status. */
static forceshade_batch batch_of(size_t count, const float* positions, float* forces, forceshade_status* statuses) {
  return (forceshade_batch){sizeof(forceshade_batch), count, positions, 12, 4, forces, 12, 4, statuses, 1, 1};
}

EXPORTED forceshade_result web_forces(const forceshade_subject* subject, size_t count, const float* positions, float* forces,
                                      forceshade_status* statuses) {
  const forceshade_batch batch = batch_of(count, positions, forces, statuses);
  return forceshade_forces(*subject, &batch, NULL);
}

EXPORTED forceshade_result web_session_open(const forceshade_subject* subject, forceshade_session* made) {
  return forceshade_session_open(*subject, made);
}

EXPORTED forceshade_result web_session_close(const forceshade_session* session) {
  return forceshade_session_close(*session);
}

EXPORTED forceshade_result web_session_steps(const forceshade_session* session, size_t count, const float* positions,
                                             float* forces, forceshade_status* statuses) {
  const forceshade_batch batch = batch_of(count, positions, forces, statuses);
  return forceshade_session_steps(*session, &batch, NULL);
}

EXPORTED forceshade_result web_session_reset(const forceshade_session* session) {
  return forceshade_session_reset(*session);
}

/* state: place, side, slipping, position, index, parameter, meeting, further and cell, fifteen numbers that are all exact. */
EXPORTED forceshade_result web_session_state(const forceshade_session* session, double* state) {
  forceshade_state its = {.size = sizeof its};
  const forceshade_result result = forceshade_session_state(*session, &its);
  if (result != FORCESHADE_OK) return result;
  *state++ = its.place;
  *state++ = its.side;
  *state++ = its.slipping;
  for (int i = 0; i < 3; ++i) *state++ = its.position[i];
  for (int i = 0; i < 2; ++i) *state++ = its.index[i];
  for (int i = 0; i < 2; ++i) *state++ = its.parameter[i];
  *state++ = its.meeting;
  for (int i = 0; i < 2; ++i) *state++ = its.further[i];
  for (int i = 0; i < 2; ++i) *state++ = its.cell[i];
  return result;
}

EXPORTED forceshade_result web_session_resume(const forceshade_session* session, const double* state) {
  forceshade_state its = {
      .size = sizeof its, .place = (uint8_t)state[0], .side = (uint8_t)state[1], .slipping = (uint8_t)state[2]};
  for (int i = 0; i < 3; ++i) its.position[i] = (float)state[3 + i];
  for (int i = 0; i < 2; ++i) its.index[i] = (uint32_t)state[6 + i];
  for (int i = 0; i < 2; ++i) its.parameter[i] = (uint32_t)state[8 + i];
  its.meeting = (uint8_t)state[10];
  for (int i = 0; i < 2; ++i) its.further[i] = (uint32_t)state[11 + i];
  for (int i = 0; i < 2; ++i) its.cell[i] = (uint32_t)state[13 + i];
  return forceshade_session_resume(*session, &its);
}

EXPORTED forceshade_result web_scene_open(const forceshade_subject* objects, size_t count, forceshade_scene* made) {
  return forceshade_scene_open(objects, count, made);
}

EXPORTED forceshade_result web_scene_close(const forceshade_scene* scene) {
  return forceshade_scene_close(*scene);
}

/* poses: seven floats for each object, translation and rotation. */
EXPORTED forceshade_result web_scene_step(const forceshade_scene* scene, const float* position, const float* poses,
                                          size_t count, float* force, forceshade_status* status) {
  _Static_assert(sizeof(forceshade_pose) == 7 * sizeof(float), "a pose has no gaps");
  return forceshade_scene_step(*scene, position, (const forceshade_pose*)poses, count, force, status);
}

EXPORTED forceshade_result web_scene_object(const forceshade_scene* scene, size_t object, float* force,
                                            forceshade_status* status) {
  return forceshade_scene_object(*scene, object, force, status);
}

/* numbers: rate, share, damping, most, drag and full_at. state: has_position, periods, position and velocity, eight numbers. */
EXPORTED forceshade_result web_damping_steps(const float* numbers, float* state, const uint32_t* periods, size_t count,
                                             const float* positions, float* forces, forceshade_status* statuses) {
  const forceshade_damping damping = {sizeof damping, numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
  forceshade_damping_state its = {.size = sizeof its, .has_position = (uint8_t)state[0], .periods = (uint8_t)state[1]};
  for (int i = 0; i < 3; ++i) its.position[i] = state[2 + i];
  for (int i = 0; i < 3; ++i) its.velocity[i] = state[5 + i];
  const forceshade_batch batch = batch_of(count, positions, forces, statuses);
  const forceshade_result result = forceshade_damping_steps(&damping, &its, periods, &batch, NULL);
  if (result != FORCESHADE_OK) return result;
  *state++ = its.has_position;
  *state++ = its.periods;
  for (int i = 0; i < 3; ++i) *state++ = its.position[i];
  for (int i = 0; i < 3; ++i) *state++ = its.velocity[i];
  return result;
}
