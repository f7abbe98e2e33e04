// SPDX-License-Identifier: BSD-3-Clause
// A vendor's library that was linked with -ffast-math: its loading switches subnormals off, and leaves the x87 at 53 bits. It
// stands in front of the stand-in's library.

__attribute__((constructor)) static void at_load(void) {
#if defined(__x86_64__)
  unsigned mxcsr = 0;
  const unsigned short x87 = 0x27F;
  __asm__ volatile("stmxcsr %0" : "=m"(mxcsr));
  mxcsr |= 0x8040;
  __asm__ volatile("ldmxcsr %0\n\tfldcw %1" : : "m"(mxcsr), "m"(x87));
#endif
}
