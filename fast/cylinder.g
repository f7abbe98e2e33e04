# SPDX-License-Identifier: BSD-3-Clause
# cylinder: the relative error of the first stage (fast/cylinder.h), and that its `contact` is exact where not in doubt.
# How the scripts are written and run, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
x = float<ieee_32, ne>(x_);
z = float<ieee_32, ne>(z_);
K = float<ieee_32, ne>(K_);
R = float<ieee_32, ne>(R_);
d_head = float<29, -1074, ne>(d_head_);
d_tail = rnd(d_tail_);
half_width_squared = rnd(half_width_squared_);  # (w/2)², exact: 48 bits
D = d_head + d_tail + dD;                       # the exact d

# v, with the rounding errors that exact_sum returns; xx, zz and zd are exact: 48, 48 and 53 bits.
xx = x * x;
zz = z * z;
zd = (z + z) * d_head;
a rnd= half_width_squared - xx;
a_error = (half_width_squared - xx) - a;
b rnd= zz + zd;
b_error = (zz + zd) - b;
c rnd= a - b;
c_error = (a - b) - c;
t rnd= ((a_error - b_error) + c_error) - (z + z) * d_tail;
v rnd= c + t;
T = ((a_error - b_error) + c_error) - (z + z) * d_tail;
W = c + t;
V = half_width_squared - xx - zz - (z + z) * D;
m = rnd(m_);  # the sum (w/2)² + |2zd|, as computed, that v is compared with

l1 rnd= z + d_head;
l rnd= l1 + d_tail;
L = z + D;
P = l1 + d_tail;

# What follows l and v, from their bounds alone.
near_v = rnd(near_v_);
near_l = rnd(near_l_);
XX = xx;
LL = TRUE_L * TRUE_L;
ll rnd= near_l * near_l;
rho rnd= sqrt(xx + ll);
RHO = sqrt(XX + LL);
R_rho rnd= R + rho;
scale rnd= (K * near_v) / (R_rho * rho);
fx rnd= scale * x;
fz rnd= scale * near_l;
SCALE = (K * TRUE_V) / ((R + RHO) * RHO);
FX = SCALE * x;
FZ = SCALE * TRUE_L;

# v, where x² and z² are at most 64 times m, which is scaled to [1, 4]; v > 0.
#! piece v_near_inside
{ m in [1, 4] /\ half_width_squared / m in [0, 0x1.01p0] /\ |zd / m| <= 0x1.01p0 /\ xx in [0, 256] /\ zz in [0, 256] /\
  |(z + z) * d_tail / m| <= 0x1.01p-29 /\ |(z + z) * dD / m| <= 0x1.01p-82 /\ v / m in [1b-26, 1024]
-> (v - V) / V in ? }
half_width_squared -> (half_width_squared / m) * m;
zd -> (zd / m) * m;
(z + z) * d_tail -> ((z + z) * d_tail / m) * m;
v -> (v / m) * m;
W -> v / (1 + (v - W) / W);
W - V -> (t - T) + ((z + z) * dD / m) * m;
V -> W - (W - V);
(v - V) / V -> (v - W) / W + (W - V) / V + ((v - W) / W) * ((W - V) / V);
$ m in 16;

# The same, v < 0: its sign is right.
#! piece v_near_outside
{ m in [1, 4] /\ half_width_squared / m in [0, 0x1.01p0] /\ |zd / m| <= 0x1.01p0 /\ xx in [0, 256] /\ zz in [0, 256] /\
  |(z + z) * d_tail / m| <= 0x1.01p-29 /\ |(z + z) * dD / m| <= 0x1.01p-82 /\ v / m in [-1024, -1b-26]
-> (v - V) / V in ? }
half_width_squared -> (half_width_squared / m) * m;
zd -> (zd / m) * m;
(z + z) * d_tail -> ((z + z) * d_tail / m) * m;
v -> (v / m) * m;
W -> v / (1 + (v - W) / W);
W - V -> (t - T) + ((z + z) * dD / m) * m;
V -> W - (W - V);
(v - V) / V -> (v - W) / W + (W - V) / V + ((v - W) / W) * ((W - V) / V);
$ m in 16;

# The larger of x² and z² is scaled to [1, 4] and at least 16 times m: far outside.
#! piece v_far_in_x
{ m in [1b-60, 1b-4] /\ half_width_squared in [0, 1b-4] /\ |zd| <= 1b-4 /\ xx in [1, 4] /\ zz in [0, 4] /\
  |(z + z) * d_tail| <= 0x1.01p-33 /\ |(z + z) * dD| <= 0x1.01p-86
-> (v - V) / V in ? }
W - V -> (t - T) + (z + z) * dD;
W -> V + (W - V);
V -> half_width_squared - xx - zz - zd - (z + z) * d_tail - (z + z) * dD;
(v - V) / V -> (v - W) / W + (W - V) / V + ((v - W) / W) * ((W - V) / V);
#! piece v_far_in_z
{ m in [1b-60, 1b-4] /\ half_width_squared in [0, 1b-4] /\ |zd| <= 1b-4 /\ xx in [0, 4] /\ zz in [1, 4] /\
  |(z + z) * d_tail| <= 0x1.01p-33 /\ |(z + z) * dD| <= 0x1.01p-86
-> (v - V) / V in ? }
W - V -> (t - T) + (z + z) * dD;
W -> V + (W - V);
V -> half_width_squared - xx - zz - zd - (z + z) * d_tail - (z + z) * dD;
(v - V) / V -> (v - W) / W + (W - V) / V + ((v - W) / W) * ((W - V) / V);

# l, where z and d cancel: their sum is exact. d_head is scaled to [1, 2]; l < 0 likewise.
#! piece l_cancelling_above
{ d_head in [1, 2] /\ z in [-4, -0.25] /\ |d_tail / d_head| <= 0x1.01p-29 /\ |dD / d_head| <= 0x1.01p-82 /\ l / d_head in [1b-26, 0.5]
-> (l - L) / L in ? }
d_tail -> (d_tail / d_head) * d_head;
l -> (l / d_head) * d_head;
P -> l / (1 + (l - P) / P);
P - L -> (l1 - (z + d_head)) - (dD / d_head) * d_head;
L -> P - (P - L);
(l - L) / L -> (l - P) / P + (P - L) / L + ((l - P) / P) * ((P - L) / L);
$ d_head in 4;
#! piece l_cancelling_below
{ d_head in [1, 2] /\ z in [-4, -0.25] /\ |d_tail / d_head| <= 0x1.01p-29 /\ |dD / d_head| <= 0x1.01p-82 /\ l / d_head in [-0.5, -1b-26]
-> (l - L) / L in ? }
d_tail -> (d_tail / d_head) * d_head;
l -> (l / d_head) * d_head;
P -> l / (1 + (l - P) / P);
P - L -> (l1 - (z + d_head)) - (dD / d_head) * d_head;
L -> P - (P - L);
(l - L) / L -> (l - P) / P + (P - L) / L + ((l - P) / P) * ((P - L) / L);
$ d_head in 4;

# l, where |l| is more than half of d_head, d = 0 included; l is scaled to [1, 2], its sign immaterial.
#! piece l_far_above
{ l in [1, 2] /\ d_head in [0, 4] /\ |d_tail| <= 0x1.01p-27 /\ |dD| <= 0x1.01p-80 -> (l - L) / L in ? }
P -> l - (l - P);
L -> P - (P - L);
P - L -> (l1 - (z + d_head)) - dD;
(l - L) / L -> (l - P) / P + (P - L) / L + ((l - P) / P) * ((P - L) / L);
(P - L) / L -> ((l1 - (z + d_head)) / (z + d_head)) * ((z + d_head) / L) - dD / L;
(z + d_head) / L -> 1 - (d_tail + dD) / L;
z + d_head -> L - (d_tail + dD);
#! piece l_far_below
{ l in [-2, -1] /\ d_head in [0, 4] /\ |d_tail| <= 0x1.01p-27 /\ |dD| <= 0x1.01p-80 -> (l - L) / L in ? }
P -> l - (l - P);
L -> P - (P - L);
P - L -> (l1 - (z + d_head)) - dD;
(l - L) / L -> (l - P) / P + (P - L) / L + ((l - P) / P) * ((P - L) / L);
(P - L) / L -> ((l1 - (z + d_head)) / (z + d_head)) * ((z + d_head) / L) - dD / L;
(z + d_head) / L -> 1 - (d_tail + dD) / L;
z + d_head -> L - (d_tail + dD);

# The force, inside (rho < R), in the units of docs/laws.md; x > 0 and l > 0, the other signs being mirror images. x = 0, for
# which F_x is exactly 0, is in force_z.
#! piece force_x
{ |near_v -/ TRUE_V| <= 0x1.9p-53 # from cylinder v_
/\ |near_l -/ TRUE_L| <= 0x1.01p-52 # from cylinder l_
/\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ TRUE_V in [1b-49, 1b27] /\ TRUE_L in [1b-43, 10001] /\ x in [1b-30, 10000]
/\ XX / LL in [0, 1b140] /\ R / RHO in [1, 1b60] /\ RHO in [1b-43, 10001]
-> (fx - FX) / FX in ? }
(xx + ll - (XX + LL)) / (XX + LL) -> ((ll - LL) / LL) * (1 / (1 + XX / LL));
(R + rho - (R + RHO)) / (R + RHO) -> ((rho - RHO) / RHO) * (1 / (1 + R / RHO));
#! piece force_z
{ |near_v -/ TRUE_V| <= 0x1.9p-53 # from cylinder v_
/\ |near_l -/ TRUE_L| <= 0x1.01p-52 # from cylinder l_
/\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ TRUE_V in [1b-49, 1b27] /\ TRUE_L in [1b-43, 10001] /\ x in [0, 10000]
/\ XX / LL in [0, 1b140] /\ R / RHO in [1, 1b60] /\ RHO in [1b-43, 10001]
-> (fz - FZ) / FZ in ? }
(xx + ll - (XX + LL)) / (XX + LL) -> ((ll - LL) / LL) * (1 / (1 + XX / LL));
(R + rho - (R + RHO)) / (R + RHO) -> ((rho - RHO) / RHO) * (1 / (1 + R / RHO));
