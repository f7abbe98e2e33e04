# SPDX-License-Identifier: BSD-3-Clause
# bump-1p-shaded: the relative error of the first stage (fast/laws/bump_1p_shaded.h), over the whole bump and the plane beside it.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
K = float<ieee_32, ne>(K_);
R = float<ieee_32, ne>(R_);
x = float<ieee_32, ne>(x_);
z = float<ieee_32, ne>(z_);
gap = -z;
K_over_R rnd= K / R;
scale rnd= gap * K_over_R;
fx rnd= scale * x;
fz rnd= scale * sqrt((R - x) * (R + x));
fz_beside rnd= scale * sqrt(R * R);
FX = gap * (K / R) * x;
FZ = gap * (K / R) * sqrt((R - x) * (R + x));
FZ_BESIDE = gap * (K / R) * sqrt(R * R);
# F_x on the whole bump, the edge |x| = w/2 = R included: x > 0, the other side being its mirror image.
#! piece x
{ z in [-10000, -1b-30] /\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ x in [1b-30, 10000] -> fx -/ FX in ? }
# F_z on the same, but where |x| = R: there it is exactly 0, since R - x is.
#! piece z
{ z in [-10000, -1b-30] /\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ x in [1b-30, 10000] /\ R - x in [1b-28, 10000]
-> fz -/ FZ in ? }
# Beside the bump, and on x = 0: F_x = 0, and F_z goes through the same steps with 0 for x.
#! piece beside
{ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ z in [-10000, -1b-30] -> fz_beside -/ FZ_BESIDE in ? }
