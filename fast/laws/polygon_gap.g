# SPDX-License-Identifier: BSD-3-Clause
# The relative error of height - slope·|x| - z (fast/laws/polygon_gap.h), where it is at least 2^-27 of the height in size; so its
# sign is right too. All that is used of an operation is that it is within 2^-53 of its result, relative (rel=:
# tests/fast/gappa_pieces.sh), so lengths may be scaled by any number: nothing here comes near 2^-1022.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
z any= float<ieee_32, ne>(z_);
ax any= float<ieee_32, ne>(ax_);
height any= rnd(height_);
height_tail any= rnd(height_tail_);
slope any= float<29, -1074, ne>(slope_);
slope_tail any= rnd(slope_tail_);
H = height + height_tail + dH;  # the exact height
slope_ax = slope * ax;
tail_ax = slope_tail * ax;
S_AX = slope_ax + tail_ax + dS_AX;  # the exact slope times |x|; at most H. On a flat top all three parts are 0.

# slope·ax is exact, 29 + 24 bits, and `error` is what (height - surface) - slope·ax gives (Dekker).
surface rel= height - slope_ax;
error = (height - slope_ax) - surface;
tail_rounded rel= slope_tail * ax;
tails rel= height_tail - tail_rounded;
q rel= surface - z;
t rel= error + tails;
value rel= q + t;
Q = surface - z;
T = error + (height_tail - tail_ax);
V = q + t;
GAP = H - z - S_AX;

# |z| at most 8 times the height, which is scaled to 1; gap > 0.
#! piece near_inside
{ height in [1, 1] /\ |z| <= 16 /\ value in [1b-27, 32] /\ |height_tail| <= 1b-53 /\ |dH| <= 1b-94 /\
  |slope_ax| <= 0x1.01p0 /\ |tail_ax| <= 0x1.01p-29 /\ |dS_AX| <= 0x1.01p-82
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - dH + dS_AX) / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };
# The same, gap < 0: its sign is right.
#! piece near_outside
{ height in [1, 1] /\ |z| <= 16 /\ value in [-32, -1b-27] /\ |height_tail| <= 1b-53 /\ |dH| <= 1b-94 /\
  |slope_ax| <= 0x1.01p0 /\ |tail_ax| <= 0x1.01p-29 /\ |dS_AX| <= 0x1.01p-82
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - dH + dS_AX) / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };

# |z|, scaled to [1, 2], at least 4 times the height.
#! piece far_above
{ height in [0, 0.25] /\ z in [1, 2] /\ |height_tail| <= 1b-55 /\ |dH| <= 1b-96 /\
  |slope_ax| <= 0x1.01p-2 /\ |tail_ax| <= 0x1.01p-31 /\ |dS_AX| <= 0x1.01p-84
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - dH + dS_AX) / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };
V -> -z + (height - slope_ax) - error + (q - Q) + t;
#! piece far_below
{ height in [0, 0.25] /\ z in [-2, -1] /\ |height_tail| <= 1b-55 /\ |dH| <= 1b-96 /\
  |slope_ax| <= 0x1.01p-2 /\ |tail_ax| <= 0x1.01p-31 /\ |dS_AX| <= 0x1.01p-84
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - dH + dS_AX) / V { V <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
GAP -> V * (1 - (V - GAP) / V) { V <> 0 };
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V) { V <> 0, GAP <> 0 };
V -> -z + (height - slope_ax) - error + (q - Q) + t;
