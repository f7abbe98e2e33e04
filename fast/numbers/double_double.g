# SPDX-License-Identifier: BSD-3-Clause
# The relative errors of double-double product, quotient and root as fast/numbers/double_double.h computes them, on operands scaled by
# powers of two. The sum is Joldes, Muller and Popescu's algorithm 6, and its bound their theorem: docs/proofs.md.

@rnd = float<ieee_64, ne>;
a_hi = rnd(a_hi_);
a_lo = rnd(a_lo_);
b_hi = rnd(b_hi_);
b_lo = rnd(b_lo_);
A = a_hi + a_lo;
B = b_hi + b_lo;

# two_product and fast_two_sum lose nothing, so the result of the product is p + s, of the quotient q + e, of the root r + f.
p rnd= a_hi * b_hi;
p_low = a_hi * b_hi - p;
low0 rnd= a_lo * b_lo;
low1 = rnd(a_lo * b_hi + low0);
low2 = rnd(a_hi * b_lo + low1);
s rnd= p_low + low2;

# a_hi - q·b_hi is a binary64 number, and so what (a_hi - p.hi) - p.lo gives.
q rnd= a_hi / b_hi;
q_high = a_hi - q * b_hi;
q_low = a_lo - q * b_lo;
q_fma = rnd(q_low);
q_remainder rnd= q_high + q_fma;
e rnd= q_remainder / b_hi;
E = q_high + q_low;

# a_hi - r² is a binary64 number, and so what fma gives.
r rnd= sqrt(a_hi);
r_high = a_hi - r * r;
r_remainder rnd= r_high + a_lo;
f rnd= r_remainder / (2 * r);
F = r_high + a_lo;
ROOT = sqrt(A);

#! piece product
{ a_hi in [1, 2] /\ b_hi in [1, 2] /\ |a_lo| <= 1b-53 /\ |b_lo| <= 1b-53 -> ((p + s) - A * B) / (A * B) in ? }
(p + s) - A * B -> (s - (p_low + low2)) + (low2 - (a_hi * b_lo + low1)) + (low1 - (a_lo * b_hi + low0)) + (low0 - a_lo * b_lo);
#! piece quotient
{ a_hi in [1, 2] /\ b_hi in [1, 2] /\ |a_lo| <= 1b-53 /\ |b_lo| <= 1b-53 -> ((q + e) - A / B) / (A / B) in ? }
q_high -> -(q - a_hi / b_hi) * b_hi { b_hi <> 0 };
(q + e) - A / B -> (e - E / b_hi) + (E / b_hi) * ((b_lo / b_hi) / (1 + b_lo / b_hi)) { b_hi <> 0, B <> 0 };
e - E / b_hi -> (e - q_remainder / b_hi) + ((q_remainder - (q_high + q_fma)) + (q_fma - q_low)) / b_hi { b_hi <> 0 };
# Gappa knows no √a·√a = a, and takes two rewritings for granted. Coq proves them, as it does all others, and docs/proofs.md too.
#! piece root
{ a_hi in [1, 4] /\ |a_lo| <= 1b-52 -> ((r + f) - ROOT) / ROOT in ? }
r_high -> -(r - sqrt(a_hi)) * (r + sqrt(a_hi)) { a_hi >= 0 };  # by Coq
(r + f) - ROOT -> (f - F / (2 * r)) + F * F / (2 * r * ((ROOT + r) * (ROOT + r))) { A >= 0, r <> 0, ROOT + r <> 0 };  # by Coq
f - F / (2 * r) -> (f - r_remainder / (2 * r)) + (r_remainder - (r_high + a_lo)) / (2 * r) { r <> 0 };
