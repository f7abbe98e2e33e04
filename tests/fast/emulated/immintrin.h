// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Stands before the compiler's header of this name in tests/fast/emulated_avx512_test.sh: the AVX-512 operations of fast/simd/
// on a processor that has none, by SIMDe (Debian package libsimde-dev), and here those that its version 0.7.4 lacks or does
// otherwise: its fused operations round twice.

#define SIMDE_NO_NATIVE
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/avx512.h>
#include <simde/x86/fma.h>

#undef __mmask8
#undef __mmask16
using __mmask8 = simde__mmask8;
using __mmask16 = simde__mmask16;

namespace forceshade::emulated {

template <class Lane>
simde__m512d fused(simde__m512d a, simde__m512d b, simde__m512d c, const Lane& lane) {
  const simde__m512d_private x = simde__m512d_to_private(a), y = simde__m512d_to_private(b), z = simde__m512d_to_private(c);
  simde__m512d_private result;
  for (int i = 0; i < 8; ++i) result.f64[i] = lane(x.f64[i], y.f64[i], z.f64[i]);
  return simde__m512d_from_private(result);
}
inline simde__m512d fmadd(simde__m512d a, simde__m512d b, simde__m512d c) {
  return fused(a, b, c, [](double x, double y, double z) { return __builtin_fma(x, y, z); });
}
inline simde__m512d fnmadd(simde__m512d a, simde__m512d b, simde__m512d c) {
  return fused(a, b, c, [](double x, double y, double z) { return __builtin_fma(-x, y, z); });
}
inline simde__m512d fmsub(simde__m512d a, simde__m512d b, simde__m512d c) {
  return fused(a, b, c, [](double x, double y, double z) { return __builtin_fma(x, y, -z); });
}

inline simde__m512d widened(simde__m256 a) {
  const simde__m256_private from = simde__m256_to_private(a);
  simde__m512d_private to;
  for (int i = 0; i < 8; ++i) to.f64[i] = static_cast<double>(from.f32[i]);
  return simde__m512d_from_private(to);
}
inline simde__m256 narrowed(simde__m512d a) {
  const simde__m512d_private from = simde__m512d_to_private(a);
  simde__m256_private to;
  for (int i = 0; i < 8; ++i) to.f32[i] = static_cast<float>(from.f64[i]);
  return simde__m256_from_private(to);
}
inline simde__m256 half(simde__m512 a, int which) {
  const simde__m512_private from = simde__m512_to_private(a);
  simde__m256_private to;
  for (int i = 0; i < 8; ++i) to.f32[i] = from.f32[8 * which + i];
  return simde__m256_from_private(to);
}

template <class Mask, int kLanes, class Holds>
Mask mask(const Holds& holds) {
  unsigned bits = 0;
  for (int i = 0; i < kLanes; ++i) bits |= static_cast<unsigned>(holds(i)) << i;
  return static_cast<Mask>(bits);
}
template <class Number>
bool compared(Number a, Number b, int how) {
  return how == _CMP_LT_OQ ? a < b : how == _CMP_LE_OQ ? a <= b : a == b;
}
inline __mmask8 compare(simde__m512d a, simde__m512d b, int how) {
  const simde__m512d_private x = simde__m512d_to_private(a), y = simde__m512d_to_private(b);
  return mask<__mmask8, 8>([&](int i) { return compared(x.f64[i], y.f64[i], how); });
}
inline __mmask16 compare(simde__m512 a, simde__m512 b, int how) {
  const simde__m512_private x = simde__m512_to_private(a), y = simde__m512_to_private(b);
  return mask<__mmask16, 16>([&](int i) { return compared(x.f32[i], y.f32[i], how); });
}
template <class Holds>
__mmask16 compare_unsigned(simde__m512i a, simde__m512i b, const Holds& holds) {
  const simde__m512i_private x = simde__m512i_to_private(a), y = simde__m512i_to_private(b);
  return mask<__mmask16, 16>([&](int i) { return holds(x.u32[i], y.u32[i]); });
}

}  // namespace forceshade::emulated

#undef _mm512_fmadd_pd
#undef _mm512_fnmadd_pd
#undef _mm512_fmsub_pd
#undef _mm512_cmp_pd_mask
#undef _mm512_cmp_ps_mask
#undef _mm512_cmpgt_epu32_mask
#undef _mm512_cmplt_epu32_mask
#undef _mm512_cmpge_epu32_mask
#undef _mm512_cmple_epu32_mask
#define _mm512_fmadd_pd forceshade::emulated::fmadd
#define _mm512_fnmadd_pd forceshade::emulated::fnmadd
#define _mm512_fmsub_pd forceshade::emulated::fmsub
#define _mm512_cvtps_pd forceshade::emulated::widened
#define _mm512_cvtpd_ps forceshade::emulated::narrowed
#define _mm512_extractf32x8_ps forceshade::emulated::half
#define _mm512_cmp_pd_mask forceshade::emulated::compare
#define _mm512_cmp_ps_mask forceshade::emulated::compare
#define _mm512_cmpgt_epu32_mask(a, b) forceshade::emulated::compare_unsigned(a, b, [](auto x, auto y) { return x > y; })
#define _mm512_cmplt_epu32_mask(a, b) forceshade::emulated::compare_unsigned(a, b, [](auto x, auto y) { return x < y; })
#define _mm512_cmpge_epu32_mask(a, b) forceshade::emulated::compare_unsigned(a, b, [](auto x, auto y) { return x >= y; })
#define _mm512_cmple_epu32_mask(a, b) forceshade::emulated::compare_unsigned(a, b, [](auto x, auto y) { return x <= y; })
