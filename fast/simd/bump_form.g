# SPDX-License-Identifier: BSD-3-Clause
# bump_form.inl: the relative error of slope·(w/2 - |x|) - z by two fused operations, where it is at least 2^-20 of the height in size, so
# that its sign is right too; and of the shaded force with R² - x² by one. The products with the constants are those of the laws' own
# scripts, which take any gap good to 0x1.bp-52. All that is used of an operation is that it is within 2^-53 of its result, relative
# (rel=: tests/fast/gappa_pieces.sh), so lengths may be scaled by any number: nothing here comes near 2^-1022.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
z any= float<ieee_32, ne>(z_);
distance any= rnd(distance_);  # w/2 - |x|, exact; on a flat top w/2 less its last binary32
slope any= float<29, -1074, ne>(slope_);
tail any= rnd(tail_);
slope_distance = slope * distance;
tail_distance = tail * distance;
H = slope_distance + tail_distance + dH;  # the exact height at x

q rel= slope_distance - z;
value rel= tail_distance + q;
Q = slope_distance - z;
V = tail_distance + q;
GAP = H - z;

# The shaded force's z, in the units of docs/laws.md: R² - x² is rounded once, for its terms are exact, and is 0 or not below 2^-46.
K = float<ieee_32, ne>(K_);
R = float<ieee_32, ne>(R_);
gap = rnd(gap_);
square = rnd(square_);
K_over_R rnd= K / R;
scale rnd= gap * K_over_R;
fz rnd= scale * sqrt(square);
FZ = TRUE_GAP * (K / R) * sqrt(TRUE_SQUARE);

# |z| at most 8 times the bump's height, which is scaled to 1; gap > 0. The tail is below 2^-28·slope on a side; on a top, whose last
# binary32 is within 2^-23·w′/2 of w′/2 <= w/2 - w′/2, below 2^-22·slope.
#! piece near_inside
{ |slope_distance| <= 0x1.01p0 /\ |z| <= 16 /\ value in [1b-20, 32] /\ |tail_distance| <= 0x1.01p-22 /\ |dH| <= 1b-74
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - tail_distance / V) - dH / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };
# The same, gap < 0: its sign is right.
#! piece near_outside
{ |slope_distance| <= 0x1.01p0 /\ |z| <= 16 /\ value in [-32, -1b-20] /\ |tail_distance| <= 0x1.01p-22 /\ |dH| <= 1b-74
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - tail_distance / V) - dH / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };

# |z|, scaled to [1, 2], at least 4 times the height.
#! piece far_above
{ |slope_distance| <= 0x1.01p-2 /\ z in [1, 2] /\ |tail_distance| <= 0x1.01p-24 /\ |dH| <= 1b-76 -> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - tail_distance / V) - dH / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };
V -> -z + slope_distance + (q - Q) + tail_distance;
#! piece far_below
{ |slope_distance| <= 0x1.01p-2 /\ z in [-2, -1] /\ |tail_distance| <= 0x1.01p-24 /\ |dH| <= 1b-76 -> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - tail_distance / V) - dH / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };
V -> -z + slope_distance + (q - Q) + tail_distance;
#! piece shaded_z
{ |gap -/ TRUE_GAP| <= 0x1.bp-52 # from bump_form near_inside|far_
/\ |square -/ TRUE_SQUARE| <= 1b-53 /\ TRUE_SQUARE in [1b-46, 1b27]
/\ TRUE_GAP in [1b-66, 20001] /\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] -> fz -/ FZ in ? }
