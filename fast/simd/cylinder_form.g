# SPDX-License-Identifier: BSD-3-Clause
# cylinder_form.inl: the relative error of the components, and the sign of v = R² - ρ².
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
# v. The factors (w/2 - |x|) and (w/2 + |x|) are exact, and so is z + 2·d_head where |z| is neither tiny nor far beyond the cylinder.
z any= float<ieee_32, ne>(z_);
product any= near_half * far_half;
factor any= z + twice_head;
z_factor = z * factor;
zt any= z * twice_tail;  # and zD is what 2d lacks then, times z
p rel= z_factor;
e rel= z_factor - p;
q rel= product - p;
t rel= zt + e;
v rel= q - t;
Q = product - p;
T = zt + e;
W = q - t;
V = product - z_factor - zt - zD;

# The binary32 part, with ρ = 1: then R² - ρ² = TRUE_T·(R + 1), and TRUE_T = R - 1.
rho any= sqrt(square);
W_TRUE = R + 1;
w_sum = R_rho + square;

# The step of Newton, where every number is relative: t = T(1 + delta), v to ev, ρ² to es, K/(2R²) to ec; e1 to e6 are the roundings
# of t·ρ², t + 2, the fused difference, t·K, the fused sum and K/(2R²)·(1 + t). tau is T/(2(1 + T)), at most 3/10, so that K(1 + t)/(2R²)
# is K/(2Rρ)·(1 + eta). Then what the step gives is K·T·(1 + step).
turn = 2 * tau * delta;
eta = turn + (1 + turn) * (ec + e6 + ec * e6);
q1 = es + e1 + e2 + es * e1 + es * e2 + e1 * e2 + es * e1 * e2;
correction = (1 - tau) * (ev - q1) - delta * (1 + q1) * (1 + delta * tau);
rest = (1 - tau) * (ev - q1) - delta * q1 - delta * delta * (1 + q1) * tau;  # correction + delta
sum = correction * (eta + e3 + e3 * eta) + rest + (1 + delta) * e4;
step = sum + (1 + sum) * e5;

# The components.
x = float<ieee_32, ne>(x_);
scale = rnd(scale_);
l = rnd(l_);
plane = rnd(plane_);  # K·(-z), exact
fx rnd= scale * x;
fz rnd= scale * l;
both = rnd(scale * l + plane);
FX = TRUE_SCALE * x;
FZ = TRUE_SCALE * TRUE_L;
BOTH = TRUE_SCALE * TRUE_L + plane;

# The region where the force acts, scaled to R = 1: |z| <= R + d <= 2.
#! piece v_inside
{ |z_factor| <= 0x8.01p0 /\ |zt| <= 0x1.01p-27 /\ |zD| <= 0x1.01p-80 /\ v in [1b-24, 0x1.01p0] -> (v - V) / V in ? }
(W - V) / W -> ((q - Q) / q) * (1 + t / W) + ((z_factor - p - e) + (T - t) + zD) / W { W <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
V -> W * (1 - (W - V) / W) { W <> 0 };
(v - V) / V -> ((v - W) / W + (W - V) / W) / (1 - (W - V) / W) { W <> 0, V <> 0 };
# The same, as a part of R²: ρ² = R² - v, at least 4/25, is good to 2^-49 and a rounding.
#! piece part_of_square
{ |z_factor| <= 0x8.01p0 /\ |zt| <= 0x1.01p-27 /\ |zD| <= 0x1.01p-80 /\ v in [1b-24, 0x1.01p0] -> v - V in ? }
v - V -> (v - W) + (q - Q) + (T - t) + (z_factor - p - e) + zD;
# Outside, but within x² + z² <= 8R²: an error below 1 keeps the sign.
#! piece sign_near
{ |z_factor| <= 0xe.p0 /\ |zt| <= 0x1.01p-26 /\ |zD| <= 0x1.01p-79 /\ v in [-32, -1b-24] -> (v - V) / V in ? }
(W - V) / W -> ((q - Q) / q) * (1 + t / W) + ((z_factor - p - e) + (T - t) + zD) / W { W <> 0, q <> 0 };
(q - Q) / q -> ((q - Q) / Q) / (1 + (q - Q) / Q) { Q <> 0, q <> 0 };
V -> W * (1 - (W - V) / W) { W <> 0 };
(v - V) / V -> ((v - W) / W + (W - V) / W) / (1 - (W - V) / W) { W <> 0, V <> 0 };
# x² + z² = r² > 8R², the larger of x² and z² scaled to [1, 4]: V <= R² - (r - d)² <= -r²(1 - 2/√8). Here the factor may be rounded:
# w/2 ± |x| are exact in all the domain.
#! piece sign_far
{ |product| <= 5 /\ |z_true| <= 9 /\ |z_factor -/ z_true| <= 1b-53 /\ |zt| <= 1b-26 /\ |zD| <= 1b-79 /\
  product - z_true - zt - zD in [-64, -0.29]
-> (v - (product - z_true - zt - zD)) / (product - z_true - zt - zD) in ? }
v - (product - z_true - zt - zD) -> (v - W) + (q - Q) + (T - t) + (z_factor - p - e) + (z_true - z_factor) + zD;

# ρ² and t in binary32, v rounded from binary64, with ρ = 1. A position beyond the cylinder has R < 1 and T < 0.
#! piece part_sum
{ |v_32 -/ (R * R - 1)| <= 0x1.001p-24 /\ |s_32 -/ (R * R - tail - v_32)| <= 1b-24 /\ |square -/ (s_32 + tail)| <= 1b-24 /\
  |tail| <= 0x1.ap-22 /\ R in [1b-18, 2.51] /\ |rho -/ sqrt(square)| <= 1b-24 /\ |R_rho -/ (R * rho)| <= 1b-24 /\ |w_32 -/ w_sum| <= 1b-24
-> (w_32 - W_TRUE) / W_TRUE in ? }
square - 1 -> (square - (s_32 + tail)) + (s_32 - (R * R - tail - v_32)) + ((R * R - 1) - v_32);
(R_rho - R) / R -> ((R_rho - R * rho) / (R * rho)) * rho + (rho - 1) { R <> 0, rho <> 0 };
(w_sum - W_TRUE) / W_TRUE -> ((R_rho - R) / R) * (R / W_TRUE) + (square - 1) / W_TRUE { R <> 0, W_TRUE <> 0 };
R / W_TRUE -> 1 - 1 / W_TRUE { W_TRUE <> 0 };
(w_32 - W_TRUE) / W_TRUE -> ((w_32 - w_sum) / w_sum) * (1 + (w_sum - W_TRUE) / W_TRUE) + (w_sum - W_TRUE) / W_TRUE
  { w_sum <> 0, W_TRUE <> 0 };
$ R in 16;
#! piece part_quotient
{ |v_32 -/ (TRUE_T * W_TRUE)| <= 0x1.001p-24 /\ |w_32 -/ W_TRUE| <= 0x7.3ep-24 # from cylinder_form part_sum
/\ |t_32 -/ (v_32 / w_32)| <= 1b-24 /\ R in [1b-18, 2.51]
-> t_32 -/ ((TRUE_T * W_TRUE) / W_TRUE) in ? }
#! piece step
{ |delta| <= 0x9.41p-24 # from cylinder_form part_quotient
/\ |ev| <= 0x1p-50 # from cylinder_form v_inside
/\ |es| <= 0x1.2p-49 /\ |ec| <= 1b-53 /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\
  |e6| <= 1b-53 /\ tau in [0, 0.301]
-> step in ? }
# Beyond the cylinder an error below 1 keeps the sign. There tau is 1/2 - ρ/(2R), and ρ at most 2^18·R.
#! piece sign_of_step
{ |delta| <= 0x9.41p-24 # from cylinder_form part_quotient
/\ |ev| <= 0x1p-46 # from cylinder_form sign_far
/\ |es| <= 1b-45 /\ |ec| <= 1b-53 /\ |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\
  |e6| <= 1b-53 /\ tau in [-1b17, 0]
-> step in ? }
#! piece force_x
{ |scale -/ TRUE_SCALE| <= 0x13.ap-46 # from cylinder_form step
/\ TRUE_SCALE in [1b-50, 1b50] /\ x in [1b-30, 10000] -> fx -/ FX in ? }
#! piece force_z
{ |scale -/ TRUE_SCALE| <= 0x13.ap-46 # from cylinder_form step
/\ |l -/ TRUE_L| <= 0x1.01p-52 # from cylinder l_
/\ TRUE_SCALE in [1b-50, 1b50] /\ TRUE_L in [1b-43, 10001] -> fz -/ FZ in ? }
#! piece both_z
{ |scale -/ TRUE_SCALE| <= 0x13.ap-46 # from cylinder_form step
/\ |l -/ TRUE_L| <= 0x1.01p-52 # from cylinder l_
/\ TRUE_SCALE in [1b-50, 1b50] /\ TRUE_L in [1b-43, 10001] /\ plane in [0, 1b24] -> both -/ BOTH in ? }
