/* SPDX-License-Identifier: BSD-3-Clause */
/* The renderer of a project of one's own: the law bump-1p-shaded in binary64, rounded at the end. */
#include <forceshade.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Bump {
  double radius, width, stiffness;
} Bump;

#ifdef WITHOUT_ITS_EDGE
static int is_on_bump(const Bump* its, double x) { return 2 * fabs(x) < its->width; } /* wrong: the edge belongs to it */
#else
static int is_on_bump(const Bump* its, double x) { return 2 * fabs(x) <= its->width; }
#endif

/* A coordinate below the position quantum is read as 0 (docs/laws.md). */
static double coordinate(float value) { return fabsf(value) < 0x1p-30f ? 0 : value; }

static void force_of(const Bump* its, const float at[3], float force[3]) {
  const double x = coordinate(at[0]), z = coordinate(at[2]), R = its->radius;
  const int is_valid = fabsf(at[0]) <= 1e4f && fabsf(at[1]) <= 1e4f && fabsf(at[2]) <= 1e4f; /* NaN is not */
  const double size = is_valid && z < 0 ? its->stiffness * -z : 0;
  const int is_shaded = is_on_bump(its, x);
  force[0] = (float)(is_shaded ? size * x / R : 0);
  force[1] = 0;
  force[2] = (float)(is_shaded ? size * sqrt((R - x) * (R + x)) / R : size);
}

/* Functions for `forceshade conform --command FILE.so`. Numbers of the scene are found by their keys, which a JSON library does, too. */
static double number(const char* scene, const char* key) {
  const char* found = strstr(scene, key);
  return found ? strtod(found + strlen(key), NULL) : 0;
}

#define NAME "{\"forceshade\":\"conform 1\",\"kind\":\"renderer\",\"name\":\"our bump\",\"version\":\"1\""

static int32_t open_bump(const char* scene, void** state, const char** hello) {
  const Bump bump = {number(scene, "\"radius_mm\":"), number(scene, "\"width_mm\":"), number(scene, "\"stiffness_N_per_mm\":")};
  *hello = strstr(scene, "\"name\":\"bump-1p-shaded\"")
               ? NAME ",\"memory\":\"none\",\"answers\":\"force\",\"claims\":\"definition\",\"length_unit\":\"mm\",\"force_unit\":\"N\","
                      "\"frame\":[\"x\",\"y\",\"z\"],\"domain_mm\":10000,\"rate_Hz\":null,\"loop_energy_mJ\":null}"
               : NAME ",\"accepts\":false,\"reason\":\"it renders the law bump-1p-shaded alone\"}";
  *state = malloc(sizeof bump);
  if (*state == NULL) return 1;
  memcpy(*state, &bump, sizeof bump);
  return 0;
}

static int32_t answer(void* state, const float* positions, float* answers, size_t count, int32_t is_reset) {
  (void)is_reset; /* it remembers nothing */
  for (size_t i = 0; i < count; ++i) force_of(state, positions + 3 * i, answers + 3 * i);
  return 0;
}

FORCESHADE_API const forceshade_renderer* forceshade_renderer_entry(void) {
  static const forceshade_renderer kTable = {sizeof kTable, open_bump, answer, free};
  return &kTable;
}
