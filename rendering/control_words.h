// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The control words of this thread's floating-point units on x86: MXCSR of SSE and AVX, and that of the x87, which computes a
// long double. Any library can set them, also while it is loaded. Other processors have none: there nothing here does anything.

#if defined(__x86_64__) && defined(__GNUC__)
#include <xmmintrin.h>
#define FORCESHADE_HAS_CONTROL_WORDS 1
#else
#define FORCESHADE_HAS_CONTROL_WORDS 0
#endif

namespace forceshade {

struct ControlWords {
  unsigned mxcsr = 0x1F80;     // as a program starts: rounding to nearest, subnormals, no exception that traps
  unsigned short x87 = 0x37F;  // the same, and 64 bits of precision

  bool operator==(const ControlWords&) const = default;
};

inline constexpr unsigned kNoTraps = 0x1F80;  // of MXCSR

inline ControlWords control_words() noexcept {
  ControlWords words;
#if FORCESHADE_HAS_CONTROL_WORDS
  words.mxcsr = _mm_getcsr();
  asm volatile("fnstcw %0" : "=m"(words.x87));
#endif
  return words;
}

inline void set_control_words([[maybe_unused]] const ControlWords& words) noexcept {
#if FORCESHADE_HAS_CONTROL_WORDS
  _mm_setcsr(words.mxcsr);
  // An exception that is pending would trap as soon as a word says that it may.
  asm volatile("fnclex\n\tfldcw %0" : : "m"(words.x87) : "memory");
#endif
}

// Puts back at its end what was set at its beginning: around code of others, such as a vendor's library.
class KeptControlWords {
 public:
  KeptControlWords() noexcept : before_(control_words()) {}
  ~KeptControlWords() { set_control_words(before_); }
  KeptControlWords(const KeptControlWords&) = delete;
  KeptControlWords& operator=(const KeptControlWords&) = delete;

 private:
  ControlWords before_;
};

// While it lives, a long double has all of its bits, and no exception traps. Around whatever is exact: that of WSL 1 begins
// with 53 bits. Rounding and subnormals of MXCSR stay as they are, because the look at the arithmetic
// (fast/numbers/arithmetic.h) refuses others than the usual ones. A thread that is made meanwhile begins with the same words.
class ExactArithmetic {
 public:
  ExactArithmetic() noexcept : before_(control_words()) {
    ControlWords exact;
    exact.mxcsr = before_.mxcsr | kNoTraps;
    if (exact == before_) return;
    is_changed_ = true;
    set_control_words(exact);
  }
  ~ExactArithmetic() {
    if (is_changed_) set_control_words(before_);
  }
  ExactArithmetic(const ExactArithmetic&) = delete;
  ExactArithmetic& operator=(const ExactArithmetic&) = delete;

 private:
  ControlWords before_;
  bool is_changed_ = false;
};

}  // namespace forceshade
