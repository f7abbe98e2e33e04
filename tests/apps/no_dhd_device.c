/* SPDX-License-Identifier: BSD-3-Clause */
/* The vendor's library where nothing is plugged in: the rest of it is that of the stand-in, with which this is linked. */

__attribute__((visibility("default"))) int dhdGetDeviceCount(void) {
  return 0;
}
