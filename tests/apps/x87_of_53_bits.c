// SPDX-License-Identifier: BSD-3-Clause
// A library that is loaded with a program and leaves the x87 at 53 bits, as WSL 1 starts every process.

__attribute__((constructor)) static void at_load(void) {
#if defined(__x86_64__)
  const unsigned short word = 0x27F;
  __asm__ volatile("fldcw %0" : : "m"(word));
#endif
}
