# SPDX-License-Identifier: BSD-3-Clause
# The absolute errors of the B-spline's first stage (fast/height_spline.h): of 12(U - c) and 12 p U_x. The largest difference of
# coefficients side by side is between 1/2 and 1, so relative to it an error is at most twice as large: hence the 2 in the goals.
# How the scripts are written and run: docs/proofs.md. Hypotheses proved by hand: capital weights are those of the B-splines,
# which are not negative and sum to 6 and to 2, so sums of numbers with them are at most 6 and 2 times the largest number; a
# coefficient is at most 3, 2, 3 and 4 steps away from c, row by row.
# The weights here are those at t as computed. That t and its like along y are off by 3/2^53 at most (place) moves 12 U by less
# than 12 steps times that, and 12 p U_x by less than 24, each way: a slope is at most a step, a second difference two. Together
# at most 48·3/2^53 = 0x1.2p-46, twice which the header's constant pays for too.

@rnd = float<ieee_64, ne>;

# t from the distance to the cell's start, pitch between 1 and 2.
r = rnd(R);
inverse = rnd(INVERSE);

t = rnd(t_);
s rnd= 1 - t;
S = 1 - t;
b0 rnd= (s * s) * s;
b1 rnd= 4 - (3 * (t * t)) * (2 - t);
b2 rnd= 4 - (3 * (s * s)) * (1 + t);
b3 rnd= (t * t) * t;
q0 rnd= s * s;
q1 rnd= 1 + (2 * t) * s;
q2 rnd= t * t;
B0 = (S * S) * S;
B1 = 4 - (3 * (t * t)) * (2 - t);
B2 = 4 - (3 * (S * S)) * (1 + t);
B3 = (t * t) * t;
Q0 = S * S;
Q1 = 1 + (2 * t) * S;
Q2 = t * t;

# A coefficient less c, d, is rounded; so is the difference of two of those, e, whose exact value is a step. Weights w, v.
w0 = rnd(w0_); w1 = rnd(w1_); w2 = rnd(w2_); w3 = rnd(w3_);
v0 = rnd(v0_); v1 = rnd(v1_); v2 = rnd(v2_);
d0 = rnd(D0); d1 = rnd(D1); d2 = rnd(D2); d3 = rnd(D3);
e0 rnd= d1 - d0; e1 rnd= d2 - d1; e2 rnd= d3 - d2;
column rnd= (w0 * d0 + w1 * d1) + (w2 * d2 + w3 * d3);
COLUMN = (W0 * D0 + W1 * D1) + (W2 * D2 + W3 * D3);
across_column rnd= (v0 * e0 + v1 * e1) + v2 * e2;
ACROSS_COLUMN = (V0 * (D1 - D0) + V1 * (D2 - D1)) + V2 * (D3 - D2);

# Columns as computed, and their sums with the weights along the other axis.
h0 = rnd(h0_); h1 = rnd(h1_); h2 = rnd(h2_); h3 = rnd(h3_);
a0 = rnd(a0_); a1 = rnd(a1_); a2 = rnd(a2_); a3 = rnd(a3_);
per_36 = rnd(1 / 36);
height_sum rnd= (w0 * h0 + w2 * h2) + (w1 * h1 + w3 * h3);
height = rnd(height_sum * per_36);
HEIGHT = (W0 * H0 + W2 * H2) + (W1 * H1 + W3 * H3);
scale = rnd(SCALE);  # 1/12p, between 1 and 2
g0 rnd= h1 - h0; g1 rnd= h2 - h1; g2 rnd= h3 - h2;
along_sum rnd= (v0 * g0 + v2 * g2) + v1 * g1;
along = rnd(along_sum * scale);
ALONG = (V0 * (H1 - H0) + V2 * (H3 - H2)) + V1 * (H2 - H1);
across_sum rnd= (w0 * a0 + w2 * a2) + (w1 * a1 + w3 * a3);
across = rnd(across_sum * scale);
ACROSS = (W0 * A0 + W2 * A2) + (W1 * A1 + W3 * A3);
#! piece place
{ R in [0, 2] /\ INVERSE in [0.5, 1] /\ R * INVERSE in [0, 1] -> rnd(r * inverse) - R * INVERSE in ? }
#! piece outer_weight
{ t in [0, 1] -> b0 - B0 in ? /\ b3 - B3 in ? }
#! piece inner_weight
{ t in [0, 1] -> b1 - B1 in ? /\ b2 - B2 in ? }
#! piece quadratic_weight
{ t in [0, 1] -> q0 - Q0 in ? /\ q1 - Q1 in ? /\ q2 - Q2 in ? }
#! piece column
{ W0 in [0, 1] /\ W1 in [1, 4] /\ W2 in [1, 4] /\ W3 in [0, 1] /\ |D0| <= 3 /\ |D1| <= 2 /\ |D2| <= 3 /\ |D3| <= 4
/\ |COLUMN| <= 24
/\ |w0 - W0| <= 0x1.41p-52
/\ |w3 - W3| <= 0x1.41p-52 # from height_spline outer_weight
/\ |w1 - W1| <= 0x1.61p-49
/\ |w2 - W2| <= 0x1.61p-49 # from height_spline inner_weight
-> column - COLUMN in ? }
#! piece across_column
{ V0 in [0, 1] /\ V1 in [1, 1.5] /\ V2 in [0, 1] /\ |D0| <= 3 /\ |D1| <= 2 /\ |D2| <= 3 /\ |D3| <= 4
/\ |D1 - D0| <= 1 /\ |D2 - D1| <= 1 /\ |D3 - D2| <= 1 /\ |ACROSS_COLUMN| <= 2
/\ |v0 - V0| <= 0x1.01p-51 /\ |v1 - V1| <= 0x1.01p-51
/\ |v2 - V2| <= 0x1.01p-51 # from height_spline quadratic_weight
-> across_column - ACROSS_COLUMN in ? }
#! piece patch
{ W0 in [0, 1] /\ W1 in [1, 4] /\ W2 in [1, 4] /\ W3 in [0, 1] /\ V0 in [0, 1] /\ V1 in [1, 1.5] /\ V2 in [0, 1]
/\ |H0| <= 24 /\ |H1| <= 24 /\ |H2| <= 24 /\ |H3| <= 24 /\ |A0| <= 2 /\ |A1| <= 2 /\ |A2| <= 2 /\ |A3| <= 2
/\ |H1 - H0| <= 6 /\ |H2 - H1| <= 6 /\ |H3 - H2| <= 6
/\ |HEIGHT| <= 144 /\ |ALONG| <= 12 /\ |ACROSS| <= 12 /\ SCALE in [1, 2]
/\ |w0 - W0| <= 0x1.41p-52
/\ |w3 - W3| <= 0x1.41p-52 # from height_spline outer_weight
/\ |w1 - W1| <= 0x1.61p-49
/\ |w2 - W2| <= 0x1.61p-49 # from height_spline inner_weight
/\ |v0 - V0| <= 0x1.01p-51 /\ |v1 - V1| <= 0x1.01p-51
/\ |v2 - V2| <= 0x1.01p-51 # from height_spline quadratic_weight
/\ |h0 - H0| <= 0x1.ap-46 /\ |h1 - H1| <= 0x1.ap-46 /\ |h2 - H2| <= 0x1.ap-46
/\ |h3 - H3| <= 0x1.ap-46 # from height_spline column
/\ |a0 - A0| <= 0x1.2p-48 /\ |a1 - A1| <= 0x1.2p-48 /\ |a2 - A2| <= 0x1.2p-48
/\ |a3 - A3| <= 0x1.2p-48 # from height_spline across_column
-> 2 * (height * 12 - HEIGHT / 3) in ? /\ 2 * (along / SCALE - ALONG) in ? /\ 2 * (across / SCALE - ACROSS) in ? }
height * 12 - HEIGHT / 3 ->
  (height - height_sum * per_36) * 12 + (12 * per_36 - 1 / 3) * height_sum + (height_sum - HEIGHT) / 3;
along / SCALE - ALONG ->
  (along - along_sum * scale) / SCALE + along_sum * ((scale - SCALE) / SCALE) + (along_sum - ALONG);
across / SCALE - ACROSS ->
  (across - across_sum * scale) / SCALE + across_sum * ((scale - SCALE) / SCALE) + (across_sum - ACROSS);
