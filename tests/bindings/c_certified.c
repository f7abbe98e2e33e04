/* SPDX-License-Identifier: BSD-3-Clause */
/* c_certified CERTIFICATE: gives the force of a bump where the certificate covers it, and else the reason. */
#include <stdio.h>

#include "forceshade.h"

int main(int argc, char** argv) {
  forceshade_law parameters = {sizeof parameters, 15.24f, 25.4f, 0.5f};
  forceshade_subject bump;
  float position[3] = {3, 0, -0.5f}, force[3];
  if (argc == 2 && forceshade_law_new("bump-2p", &parameters, &bump) == FORCESHADE_OK &&
      forceshade_certificate_covers(argv[1], bump) == FORCESHADE_OK &&
      forceshade_force(bump, position, force, NULL) == FORCESHADE_OK) {
    printf("%g N\n", (double)force[2]);
    return 0;
  }
  puts(forceshade_message());
  return 1;
}
