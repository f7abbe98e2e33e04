/* SPDX-License-Identifier: BSD-3-Clause */
/* The example of include/forceshade_reference.h, as a C11 program; with a FILE it certifies the bump, and writes what was found. */
#include <stdio.h>

#include "forceshade_reference.h"

static int32_t print(void* user, const char* name, int32_t held, uint64_t cases, const char* counterexample) {
  (void)counterexample;
  if (cases == 0) return 1;
  printf("%s: %s\n", name, held ? "holds" : "does not hold");
  ++*(int*)user;
  return 0;
}

int main(int argc, char** argv) {
  const char text[] = "law = \"bump-2p\"\nradius = \"15.24mm\"\nwidth = \"25.4mm\"\nstiffness = \"0.5N/mm\"\n";
  forceshade_reference bump;
  float position[3] = {3, 0, -0.5f};
  char force[100];
  if (forceshade_reference_parse(text, sizeof text - 1, "bump.toml", &bump) != FORCESHADE_OK ||
      forceshade_reference_decimals(bump, position, 20, force, sizeof force, NULL, NULL) != FORCESHADE_OK) {
    puts(forceshade_reference_message());
    return 1;
  }
  printf("%s N\n", force);
  if (argc == 2) {
    const forceshade_reference_plan plan = {sizeof plan, 2000, 50, 1, 1};
    int32_t standing = -1;
    int finished = 0;
    if (forceshade_reference_properties(bump, 20, 1, print, &finished) != FORCESHADE_OK ||
        forceshade_reference_certify(bump, &plan, argv[1], NULL, NULL, &standing) != FORCESHADE_OK) {
      puts(forceshade_reference_message());
      return 1;
    }
    printf("%d properties, standing %d\n", finished, (int)standing);
  }
  return forceshade_reference_free(bump) == FORCESHADE_OK ? 0 : 1;
}
