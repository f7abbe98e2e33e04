// SPDX-License-Identifier: BSD-3-Clause
// The law bump-2p in C, in binary32, as one writes it at first, for `forceshade conform` (docs/conformance-protocol.md):
// cc -O2 naive.c -lm.
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* const kHello =
    "{\"forceshade\":\"conform 1\",\"kind\":\"renderer\",\"name\":\"a bump in naive C\",\"version\":\"1\",\"memory\":\"none\","
    "\"answers\":\"force\",\"claims\":\"definition\",\"length_unit\":\"mm\",\"force_unit\":\"N\",\"frame\":[\"x\",\"y\",\"z\"],"
    "\"domain_mm\":10000,\"rate_Hz\":null,\"loop_energy_mJ\":null";

struct Bump {
  float stiffness, half_width, height, slope;
};

static void force(const struct Bump* bump, const float at[3], float answer[3]) {
  const bool beside = fabsf(at[0]) > bump->half_width;
  const float surface = beside ? 0 : bump->height * (1 - fabsf(at[0]) / bump->half_width);
  const float slope = beside ? 0 : at[0] < 0 ? -bump->slope : bump->slope;
  const float size = surface > at[2] ? bump->stiffness * (surface - at[2]) : 0;
  const float length = sqrtf(1 + slope * slope);
  answer[0] = size * slope / length;
  answer[1] = 0;
  answer[2] = size / length;
}

static float parameter(const char* scene, const char* name) {
  const char* found = strstr(scene, name);
  return found == NULL ? 0 : strtof(strchr(found, ':') + 1, NULL);
}

static struct Bump bump_of(const char* scene) {
  const float radius = parameter(scene, "\"radius_mm\""), width = parameter(scene, "\"width_mm\"");
  const float height = radius - sqrtf(radius * radius - width * width / 4);
  return (struct Bump){parameter(scene, "\"stiffness_N_per_mm\""), width / 2, height, 2 * height / width};
}

static float number(const char* digits) {
  char eight[9] = {0};
  memcpy(eight, digits, 8);
  const uint32_t bits = (uint32_t)strtoul(eight, NULL, 16);
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static void answer(const struct Bump* bump, const char* positions) {
  const char* separator = "";
  printf("{\"answers\":[");
  for (const char* at = strchr(positions, '[');
       (at = strchr(at, '"')) != NULL && at[1] != '\0' && strspn(at + 1, "0123456789abcdef") == 24; at += 26) {
    const float position[3] = {number(at + 1), number(at + 9), number(at + 17)};
    float found[3];
    force(bump, position, found);
    uint32_t bits[3];
    memcpy(bits, found, sizeof bits);
    printf("%s\"%08" PRIx32 "%08" PRIx32 "%08" PRIx32 "\"", separator, bits[0], bits[1], bits[2]);
    separator = ",";
  }
  puts("]}");
}

int main(void) {
  char* line = NULL;
  size_t room = 0;
  struct Bump bump = {0};
  while (getline(&line, &room, stdin) > 0 && strstr(line, "\"goodbye\"") == NULL) {
    const char* positions = strstr(line, "\"positions\"");
    if (positions != NULL) {
      answer(&bump, positions);
    } else {
      bump = bump_of(line);
      const bool known = strstr(line, "\"bump-2p\"") != NULL;
      printf("%s%s}\n", kHello, known ? "" : ",\"accepts\":false,\"reason\":\"it renders the law bump-2p alone\"");
    }
    fflush(stdout);
  }
  free(line);
}
