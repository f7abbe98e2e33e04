# SPDX-License-Identifier: BSD-3-Clause
# bump-3p: the relative error of the first stage (fast/laws/bump_3p.h), over side faces, flat top and plane.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
K = float<ieee_32, ne>(K_);
p = float<ieee_32, ne>(p_);  # -z, a binary32 number as z is
gap = rnd(gap_);
K_sine = rnd(K_sine_);
K_cosine = rnd(K_cosine_);
fx rnd= gap * K_sine;
fz rnd= gap * K_cosine;
FX = GAP * TRUE_K_SINE;
FZ = GAP * TRUE_K_COSINE;
#! piece side
{ |gap -/ GAP| <= 0x1.bp-52 # from polygon_gap
/\ |K_sine -/ TRUE_K_SINE| <= 0x1.00001p-53 /\ |K_cosine -/ TRUE_K_COSINE| <= 0x1.00001p-53
/\ GAP in [1b-66, 20001] /\ TRUE_K_SINE in [1b-36, 1000] /\ TRUE_K_COSINE in [1b-12, 1000]
-> fx -/ FX in ? /\ fz -/ FZ in ? }
# The flat top: F_x = 0.
#! piece top
{ |gap -/ GAP| <= 0x1.bp-52 # from polygon_gap
/\ GAP in [1b-66, 20001] /\ K in [1b-10, 1000] -> rnd(gap * K) -/ (GAP * K) in ? }
# Beside the bump: F_x = 0, F_z = Kp, without error.
#! piece plane
{ K in [1b-10, 1000] /\ p in [1b-30, 10000] -> rnd(p * K) - (p * K) in ? }
