/* SPDX-License-Identifier: BSD-3-Clause */
/* The example of include/forceshade.h, as a C11 program. */
#include <stdio.h>

#include "forceshade.h"

int main(void) {
  forceshade_law parameters = {sizeof parameters, 15.24f, 25.4f, 0.5f};
  forceshade_subject bump;
  float position[3] = {3, 0, -0.5f}, force[3];
  forceshade_status status;
  if (forceshade_law_new("bump-2p", &parameters, &bump) != FORCESHADE_OK ||
      forceshade_force(bump, position, force, &status) != FORCESHADE_OK) {
    puts(forceshade_message());
    return 1;
  }
  printf("%g N, %s\n", (double)force[2], status == FORCESHADE_CONTACT ? "contact" : "no contact");
  return forceshade_subject_free(bump) == FORCESHADE_OK ? 0 : 1;
}
