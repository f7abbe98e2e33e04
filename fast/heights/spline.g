# SPDX-License-Identifier: BSD-3-Clause
# The absolute errors of the B-spline's first stage (SplineValues in fast/heights/spline.h): of U - c in steps, of U_x and U_y in
# steps per pitch; a step is the largest difference of coefficients side by side. The form and use of the scripts:
# docs/proofs.md.
#
# All that is used of an operation is that it is within 2^-53 of its result, relative (rel=: tests/fast/gappa_pieces.sh):
# multiply_add, rounded once or twice, is a product and a sum of that kind. So step and pitch may be taken as 1. Hypotheses
# proved by hand: t, of a difference, 1/p and a product, is within 3.003·2^-53, relative; column k of the window is at most
# |k - 1| + T + (1 - T)^3/3 <= |k - 1| + 1 steps from c, for the weights along y are the B-splines; the sizes of the weights of the
# three steps sum to 2 - 2T/3 in BEND, to 2 in TILT and TWICE_SLOPE, to 4 - 2T in TWICE_BEND. The place may be 2^-36 outside of
# its cell (docs/proofs.md), where each of these grows by less than 2^-34, which their .0001 covers.

t = t_; a0 = a0_; a3 = a3_;
outer_3 rel= a3 * t; outer_2 rel= outer_3 + A2; outer_2t rel= outer_2 * t; outer_1 rel= outer_2t + A1; outer_1t rel= outer_1 * t;
outer rel= outer_1t + a0;
OUTER = ((A3 * T + A2) * T + A1) * T + A0;
# It has no linear term.
inner_3 rel= A3 * t; inner_2 rel= inner_3 + A2; inner_2t rel= inner_2 * t; inner_2tt rel= inner_2t * t; inner rel= inner_2tt + a0;
INNER = ((A3 * T + A2) * T) * T + A0;
cube_1 rel= a3 * t; cube_2 rel= cube_1 * t; cube rel= cube_2 * t;
CUBE = ((A3 * T) * T) * T;
slope_t rel= A2 * t; slope_1 rel= slope_t + A1; slope_1t rel= slope_1 * t; slope rel= slope_1t + A0;
SLOPE = (A2 * T + A1) * T + A0;

# One column: s are the steps from row to row, b from c to row 1.
s0 = s0_; s1 = s1_; s2 = s2_; b = b_; third = third_; sixth = sixth_;
two_steps rel= s0 + s1;
second rel= s1 - s0;
later rel= s2 - s1; difference rel= later - second;
t_2 = t / 2;
t_3 rel= t * third;
bend_t rel= t_3 * difference; bend rel= bend_t + second; tilt_t rel= t * bend; tilt rel= tilt_t + two_steps;
value_t rel= t_2 * tilt; value_s rel= second * sixth; value_b rel= value_s + b; value rel= value_t + value_b;
BEND = (T * THIRD) * ((S2 - S1) - (S1 - S0)) + (S1 - S0);
TILT = T * BEND + (S0 + S1);
VALUE = T / 2 * TILT + ((S1 - S0) * SIXTH + B);
twice_second = 2 * second;
twice_bend_t rel= t * difference; twice_bend rel= twice_bend_t + twice_second;
twice_slope_t rel= t * twice_bend; twice_slope rel= twice_slope_t + two_steps;
TWICE_BEND = T * ((S2 - S1) - (S1 - S0)) + 2 * (S1 - S0);
TWICE_SLOPE = T * TWICE_BEND + (S0 + S1);

# The sums of four columns with their weights, and what turns them into slopes.
w0 = w0_; w1 = w1_; w2 = w2_; w3 = w3_; h0 = h0_; h1 = h1_; h2 = h2_; h3 = h3_; p = p_;
p0 rel= w0 * h0; p1 rel= w1 * h1; p2 rel= w2 * h2; p3 rel= w3 * h3;
rise_02 rel= p0 + p2; rise_13 rel= p1 + p3; rise rel= rise_02 + rise_13;
RISE = (W0 * H0 + W2 * H2) + (W1 * H1 + W3 * H3);
sum_01 rel= p0 + p1; sum_23 rel= p2 + p3; sum rel= sum_01 + sum_23;
SUM = (W0 * H0 + W1 * H1) + (W2 * H2 + W3 * H3);
scaled rel= sum * p;
#! piece weight_0
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = 1 / 6 /\ A1 = -1 / 2 /\ A2 = 1 / 2 /\ A3 = -1 / 6
/\ |a0 -/ A0| <= 1b-53 /\ |a3 -/ A3| <= 1b-53 -> outer - OUTER in ? }
#! piece weight_1
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = 2 / 3 /\ A2 = -1 /\ A3 = 1 / 2 /\ |a0 -/ A0| <= 1b-53
-> inner - INNER in ? }
#! piece weight_2
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = 1 / 6 /\ A1 = 1 / 2 /\ A2 = 1 / 2 /\ A3 = -1 / 2
/\ |a0 -/ A0| <= 1b-53 /\ a3 = A3 -> outer - OUTER in ? }
#! piece weight_3
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A3 = 1 / 6 /\ |a3 -/ A3| <= 1b-53 -> cube - CUBE in ? }
#! piece slope_0
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = -1 / 2 /\ A1 = 1 /\ A2 = -1 / 2 -> slope - SLOPE in ? }
#! piece slope_1
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = 0 /\ A1 = -2 /\ A2 = 3 / 2 -> slope - SLOPE in ? }
#! piece slope_2
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = 1 / 2 /\ A1 = 1 /\ A2 = -3 / 2 -> slope - SLOPE in ? }
#! piece slope_3
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ A0 = 0 /\ A1 = 0 /\ A2 = 1 / 2 -> slope - SLOPE in ? }
#! piece value
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ |S0| <= 1 /\ |S1| <= 1 /\ |S2| <= 1 /\ |B| <= 2
/\ |BEND| <= 2.0001 /\ |TILT| <= 2.0001 /\ |VALUE| <= 3.0001
/\ |s0 -/ S0| <= 1b-53 /\ |s1 -/ S1| <= 1b-53 /\ |s2 -/ S2| <= 1b-53 /\ |b -/ B| <= 1b-53
/\ THIRD in [0.333, 0.334] /\ SIXTH in [0.166, 0.167] /\ |third -/ THIRD| <= 1b-53 /\ |sixth -/ SIXTH| <= 1b-53 -> value - VALUE in ? }
bend ~ BEND;
#! piece twice_slope
{ T in [-1b-36, 1.0001] /\ |t -/ T| <= 0x1.81p-52 /\ |S0| <= 1 /\ |S1| <= 1 /\ |S2| <= 1 /\
  |TWICE_BEND| <= 4.0001 /\ |TWICE_SLOPE| <= 2.0001
/\ |s0 -/ S0| <= 1b-53 /\ |s1 -/ S1| <= 1b-53 /\ |s2 -/ S2| <= 1b-53 -> twice_slope - TWICE_SLOPE in ? }
twice_bend ~ TWICE_BEND;
#! piece rise
{ |W0| <= 0.1667 /\ |W1| <= 0.6667 /\ |W2| <= 0.6667 /\ |W3| <= 0.1667
/\ |H0| <= 2.0001 /\ |H1| <= 1.0001 /\ |H2| <= 2.0001 /\ |H3| <= 3.0001 /\ |RISE| <= 2.0001
/\ |w0 - W0| <= 0x1.961p-51 # from spline weight_0
/\ |w1 - W1| <= 0x1.8b6p-50 # from spline weight_1
/\ |w2 - W2| <= 0x1.5b5p-50 # from spline weight_2
/\ |w3 - W3| <= 0x1.15fp-52 # from spline weight_3
/\ |h0 - H0| <= 0x1.cb6p-49 # from spline value
/\ |h1 - H1| <= 0x1.cb6p-49 # from spline value
/\ |h2 - H2| <= 0x1.cb6p-49 # from spline value
/\ |h3 - H3| <= 0x1.cb6p-49 # from spline value
-> rise - RISE in ? }
#! piece along
{ |W0| <= 0.5001 /\ |W1| <= 0.6667 /\ |W2| <= 0.6667 /\ |W3| <= 0.5001
/\ |H0| <= 2.0001 /\ |H1| <= 1.0001 /\ |H2| <= 2.0001 /\ |H3| <= 3.0001 /\ |SUM| <= 1.0001 /\ |p - 1| <= 1b-53
/\ |w0 - W0| <= 0x1.e1p-51 # from spline slope_0
/\ |w1 - W1| <= 0x1.208p-49 # from spline slope_1
/\ |w2 - W2| <= 0x1.90bp-50 # from spline slope_2
/\ |w3 - W3| <= 0x1.40ap-51 # from spline slope_3
/\ |h0 - H0| <= 0x1.cb6p-49 # from spline value
/\ |h1 - H1| <= 0x1.cb6p-49 # from spline value
/\ |h2 - H2| <= 0x1.cb6p-49 # from spline value
/\ |h3 - H3| <= 0x1.cb6p-49 # from spline value
-> scaled - SUM in ? }
scaled - SUM -> (scaled - sum * p) + sum * (p - 1) + (sum - SUM);
#! piece aside
{ |W0| <= 0.1667 /\ |W1| <= 0.6667 /\ |W2| <= 0.6667 /\ |W3| <= 0.1667
/\ |H0| <= 2.0001 /\ |H1| <= 2.0001 /\ |H2| <= 2.0001 /\ |H3| <= 2.0001 /\ |SUM| <= 2.0001 /\ |p - 1| <= 1b-53
/\ |w0 - W0| <= 0x1.961p-51 # from spline weight_0
/\ |w1 - W1| <= 0x1.8b6p-50 # from spline weight_1
/\ |w2 - W2| <= 0x1.5b5p-50 # from spline weight_2
/\ |w3 - W3| <= 0x1.15fp-52 # from spline weight_3
/\ |h0 - H0| <= 0x1.f0ap-48 # from spline twice_slope
/\ |h1 - H1| <= 0x1.f0ap-48 # from spline twice_slope
/\ |h2 - H2| <= 0x1.f0ap-48 # from spline twice_slope
/\ |h3 - H3| <= 0x1.f0ap-48 # from spline twice_slope
-> (scaled - SUM) / 2 in ? }
scaled - SUM -> (scaled - sum * p) + sum * (p - 1) + (sum - SUM);
