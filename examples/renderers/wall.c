/* SPDX-License-Identifier: BSD-3-Clause */
/* A wall at z = 0 for `forceshade conform --command FILE.so`, correctly rounded: a force is one product, which is rounded once. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "forceshade.h"

#define NAME "{\"forceshade\":\"conform 1\",\"kind\":\"renderer\",\"name\":\"a wall in C\",\"version\":\"1\""
static const char kHello[] =
    NAME ",\"memory\":\"none\",\"answers\":\"force\",\"claims\":\"definition\",\"length_unit\":\"mm\",\"force_unit\":\"N\","
         "\"frame\":[\"x\",\"y\",\"z\"],\"domain_mm\":10000,\"rate_Hz\":null,\"loop_energy_mJ\":0}";
static const char kRefusal[] = NAME ",\"accepts\":false,\"reason\":\"it renders the law wall alone\"}";

/* The scene is written without spaces between its words; a JSON library reads any. */
static int32_t wall_open(const char* scene, void** state, const char** hello) {
  static const char kStiffness[] = "\"stiffness_N_per_mm\":";
  const char* number = strstr(scene, kStiffness);
  float* stiffness = malloc(sizeof *stiffness);
  *hello = strstr(scene, "\"kind\":\"law\",\"name\":\"wall\"") && number ? kHello : kRefusal;
  if (stiffness == NULL) return 1;
  *stiffness = number ? strtof(number + sizeof kStiffness - 1, NULL) : 0;
  *state = stiffness;
  return 0;
}

static int32_t wall_answer(void* state, const float* positions, float* answers, size_t count, int32_t is_reset) {
  const float stiffness = *(const float*)state;
  (void)is_reset; /* it remembers nothing */
  for (size_t i = 0; i < count; ++i) {
    const float *at = positions + 3 * i, z = at[2];
    const int is_valid = fabsf(at[0]) <= 1e4f && fabsf(at[1]) <= 1e4f && fabsf(z) <= 1e4f; /* NaN is not */
    answers[3 * i] = answers[3 * i + 1] = 0;
    answers[3 * i + 2] = is_valid && z <= -0x1p-30f ? stiffness * -z : 0;
  }
  return 0;
}

FORCESHADE_API const forceshade_renderer* forceshade_renderer_entry(void) {
  static const forceshade_renderer kTable = {sizeof kTable, wall_open, wall_answer, free, NULL};
  return &kTable;
}
