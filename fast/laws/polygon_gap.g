# SPDX-License-Identifier: BSD-3-Clause
# The relative error of height - slope·|x| - z (fast/laws/polygon_gap.h), where it is at least 2^-27 of the height in size; so its
# sign is right too. Lengths are scaled by a power of two, which commutes with rounding: nothing here comes near 2^-1022.
# How the scripts are written and run, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
z = float<ieee_32, ne>(z_);
ax = float<ieee_32, ne>(ax_);
height = rnd(height_);
height_tail = rnd(height_tail_);
slope = float<29, -1074, ne>(slope_);
slope_tail = rnd(slope_tail_);
H = height + height_tail + dH;  # the exact height
S = slope + slope_tail + dS;    # the exact slope; S·|x| <= H. On a flat top all of slope is 0.

# slope·ax is exact, 29 + 24 bits, and `error` is what (height - surface) - slope·ax gives (Dekker).
surface rnd= height - slope * ax;
error = (height - slope * ax) - surface;
q rnd= surface - z;
t rnd= error + (height_tail - slope_tail * ax);
value rnd= q + t;
Q = surface - z;
T = error + (height_tail - slope_tail * ax);
V = q + t;
GAP = H - z - S * ax;

# |z| at most 8 times the height, gap > 0. Q = 0 would leave value = t, which is below 2^-28 of the height.
#! piece near_inside
{ height in [1, 2] /\ |z| <= 16 /\ value / height in [1b-27, 32] /\
  |height_tail / height| <= 1b-53 /\ |dH / height| <= 1b-94 /\ |Q| in [1b-200, 64] /\
  |slope * ax / height| <= 0x1.01p0 /\ |slope_tail * ax / height| <= 0x1.01p-29 /\ |dS * ax / height| <= 0x1.01p-82
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - (dH / height) * height + (dS * ax / height) * height) / V;
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q);
slope * ax -> (slope * ax / height) * height;
slope_tail * ax -> (slope_tail * ax / height) * height;
height_tail -> (height_tail / height) * height;
value -> (value / height) * height;
V -> value / (1 + (value - V) / V);
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V);
$ height in 16;

# The same, gap < 0: its sign is right.
#! piece near_outside
{ height in [1, 2] /\ |z| <= 16 /\ value / height in [-32, -1b-27] /\
  |height_tail / height| <= 1b-53 /\ |dH / height| <= 1b-94 /\ |Q| in [1b-200, 64] /\
  |slope * ax / height| <= 0x1.01p0 /\ |slope_tail * ax / height| <= 0x1.01p-29 /\ |dS * ax / height| <= 0x1.01p-82
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - (dH / height) * height + (dS * ax / height) * height) / V;
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q);
slope * ax -> (slope * ax / height) * height;
slope_tail * ax -> (slope_tail * ax / height) * height;
height_tail -> (height_tail / height) * height;
value -> (value / height) * height;
V -> value / (1 + (value - V) / V);
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V);
$ height in 16;

# |z|, scaled to [1, 2], at least 4 times the height.
#! piece far_above
{ height in [1b-60, 0.25] /\ z in [1, 2] /\
  |height_tail / height| <= 1b-53 /\ |dH / height| <= 1b-94 /\ |Q| in [1b-200, 64] /\
  |slope * ax / height| <= 0x1.01p0 /\ |slope_tail * ax / height| <= 0x1.01p-29 /\ |dS * ax / height| <= 0x1.01p-82
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - (dH / height) * height + (dS * ax / height) * height) / V;
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q);
slope * ax -> (slope * ax / height) * height;
slope_tail * ax -> (slope_tail * ax / height) * height;
height_tail -> (height_tail / height) * height;
V -> -z + (height - slope * ax) - error + (q - Q) + t;
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V);
#! piece far_below
{ height in [1b-60, 0.25] /\ z in [-2, -1] /\
  |height_tail / height| <= 1b-53 /\ |dH / height| <= 1b-94 /\ |Q| in [1b-200, 64] /\
  |slope * ax / height| <= 0x1.01p0 /\ |slope_tail * ax / height| <= 0x1.01p-29 /\ |dS * ax / height| <= 0x1.01p-82
-> (value - GAP) / GAP in ? }
(V - GAP) / V -> ((q - Q) / q) * (1 - t / V) + ((t - T) - (dH / height) * height + (dS * ax / height) * height) / V;
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q);
slope * ax -> (slope * ax / height) * height;
slope_tail * ax -> (slope_tail * ax / height) * height;
height_tail -> (height_tail / height) * height;
V -> -z + (height - slope * ax) - error + (q - Q) + t;
(value - GAP) / GAP -> ((value - V) / V + (V - GAP) / V) / (1 - (V - GAP) / V);
