# SPDX-License-Identifier: BSD-3-Clause
# cylinder: the relative error of the first stage (fast/laws/cylinder.h), and that its `contact` is exact where not in doubt.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
x = float<ieee_32, ne>(x_);
z = float<ieee_32, ne>(z_);
K = float<ieee_32, ne>(K_);
R = float<ieee_32, ne>(R_);
d_head = float<29, -1074, ne>(d_head_);
d_tail = rnd(d_tail_);
D = d_head + d_tail + dD;  # the exact d

# v. x², z² and 2z·d_head are exact (48, 48 and 53 bits); so are 8R² and (w/2)², whose sum is anchored + rest. a_error and b_error
# are what (anchored - a) - x² and (a - b) - z² give, where each difference is from the larger (Dekker): x² + z² <= 8R². All that
# is used of another operation is that it is within 2^-53 of its result, relative (rel=: tests/fast/gappa_pieces.sh).
anchored any= rnd(anchored_);
rest any= rnd(rest_);
xx any= x * x;
zz any= z * z;
zd any= 2 * z * d_head;
zt any= 2 * z * d_tail;  # and zD is 2z·dD
a rel= anchored - xx;
a_error = (anchored - xx) - a;
b rel= a - zz;
b_error = (a - zz) - b;
zt_rounded rel= zt;
errors rel= a_error + b_error;
tails rel= rest - zt_rounded;
low rel= errors + tails;
LOW = a_error + b_error + (rest - zt);
b_anchor = b - anchor;
P = b_anchor - zd;
p rel= b_anchor - zd;
v rel= p + low;
W = p + low;
V = anchored + rest - anchor - xx - zz - zd - zt - zD;

# The same where b - anchor may have to be rounded.
g rel= b - anchor;
P_rough = g - zd;
p_rough rel= g - zd;
v_rough rel= p_rough + low;
W_rough = p_rough + low;

# The same where x² + z² > 8R², and a_error and b_error are just numbers.
a_back rel= anchored - a;
b_back rel= a - b;
a_far rel= a_back - xx;
b_far rel= b_back - zz;
errors_far rel= a_far + b_far;
low_far rel= errors_far + tails;
v_far rel= p_rough + low_far;

l1 rnd= z + d_head;
l rnd= l1 + d_tail;
L = z + D;
Q = l1 + d_tail;

# The numbers that follow l and v, from their bounds alone.
near_v = rnd(near_v_);
near_l = rnd(near_l_);
XX = x * x;
LL = TRUE_L * TRUE_L;
ll rnd= near_l * near_l;
rho rnd= sqrt(XX + ll);
RHO = sqrt(XX + LL);
R_rho rnd= R + rho;
scale rnd= (K * near_v) / (R_rho * rho);
fx rnd= scale * x;
fz rnd= scale * near_l;
SCALE = (K * TRUE_V) / ((R + RHO) * RHO);
FX = SCALE * x;
FZ = SCALE * TRUE_L;

# v > 0. Where the force acts x² + z² <= (w/2)² + 2(R + d)d, so 4R² <= b <= 9R² and b - anchor is exact (Sterbenz). Scaled so
# that 1 is least_v = 2^-26·|zd| + 2^-47·R², less 2^-50 of it for its own rounding; share is the part of it that is 2^-47·R².
#! piece v_inside
{ share in [0, 1] /\ A in [0, 0x9.01p47] /\ a = A * share /\ B in [0, 0x9.01p47] /\ b = B * share /\
  |REST| <= 0x9.01p-6 /\ rest = REST * share /\ |ZT| <= 0x1.01p-3 /\ zt = ZT * (1 - share) /\ |ZD| <= 0x1.01p-56 /\ zD = ZD * (1 - share) /\
  v in [1, 1b53]
-> (v - V) / V in ? }
(W - V) / W -> ((p - P) / p) * (1 - low / W) + ((low - LOW) + zD) / W { W <> 0, p <> 0 };
(p - P) / p -> ((p - P) / P) / (1 + (p - P) / P) { P <> 0, p <> 0 };
V -> W * (1 - (W - V) / W) { W <> 0 };
(v - V) / V -> ((v - W) / W + (W - V) / W) / (1 - (W - V) / W) { W <> 0, V <> 0 };
$ share in 8;

# Anywhere within x² + z² <= 8R²: an error below 1 keeps the sign, so `contact` is exact.
#! piece sign_near_inside
{ share in [0, 1] /\ A in [0, 0x9.01p47] /\ a = A * share /\ B in [0, 0x9.01p47] /\ b = B * share /\
  |REST| <= 0x9.01p-6 /\ rest = REST * share /\ |ZT| <= 0x1.01p-3 /\ zt = ZT * (1 - share) /\ |ZD| <= 0x1.01p-56 /\ zD = ZD * (1 - share) /\
  |G| <= 0x8.01p47 /\ b - anchor = G * share /\ v_rough in [1, 1b53]
-> (v_rough - V) / V in ? }
(W_rough - V) / W_rough -> ((p_rough - P_rough) / p_rough) * (1 - low / W_rough) + ((low - LOW) + (g - (b - anchor)) + zD) / W_rough
  { W_rough <> 0, p_rough <> 0 };
(p_rough - P_rough) / p_rough -> ((p_rough - P_rough) / P_rough) / (1 + (p_rough - P_rough) / P_rough) { P_rough <> 0, p_rough <> 0 };
V -> W_rough * (1 - (W_rough - V) / W_rough) { W_rough <> 0 };
(v_rough - V) / V -> ((v_rough - W_rough) / W_rough + (W_rough - V) / W_rough) / (1 - (W_rough - V) / W_rough) { W_rough <> 0, V <> 0 };
$ share in 8;
#! piece sign_near_outside
{ share in [0, 1] /\ A in [0, 0x9.01p47] /\ a = A * share /\ B in [0, 0x9.01p47] /\ b = B * share /\
  |REST| <= 0x9.01p-6 /\ rest = REST * share /\ |ZT| <= 0x1.01p-3 /\ zt = ZT * (1 - share) /\ |ZD| <= 0x1.01p-56 /\ zD = ZD * (1 - share) /\
  |G| <= 0x8.01p47 /\ b - anchor = G * share /\ v_rough in [-1b53, -1]
-> (v_rough - V) / V in ? }
(W_rough - V) / W_rough -> ((p_rough - P_rough) / p_rough) * (1 - low / W_rough) + ((low - LOW) + (g - (b - anchor)) + zD) / W_rough
  { W_rough <> 0, p_rough <> 0 };
(p_rough - P_rough) / p_rough -> ((p_rough - P_rough) / P_rough) / (1 + (p_rough - P_rough) / P_rough) { P_rough <> 0, p_rough <> 0 };
V -> W_rough * (1 - (W_rough - V) / W_rough) { W_rough <> 0 };
(v_rough - V) / V -> ((v_rough - W_rough) / W_rough + (W_rough - V) / W_rough) / (1 - (W_rough - V) / W_rough) { W_rough <> 0, V <> 0 };
$ share in 8;

# x² + z² = r² > 8R², the larger of x² and z² scaled to [1, 4]: V <= R² - (r - d)² <= -r²(1 - 2/√8).
#! piece sign_far
{ anchored in [0, 9] /\ anchor in [0, 8] /\ |rest| <= 1b-49 /\ xx in [0, 4] /\ zz in [0, 4] /\ |zd| <= 4 /\ |zt| <= 1b-26 /\
  |zD| <= 1b-79 /\ V in [-64, -0.29]
-> (v_far - V) / V in ? }
v_far - V -> (v_far - (p_rough + low_far)) + (p_rough - (g - zd)) + (g - (b - anchor)) + (b - (a - zz))
  + (a - (anchored - xx)) + (low_far - (rest - zt)) + zD;
a_back - xx -> (a_back - (anchored - a)) - (a - (anchored - xx));
b_back - zz -> (b_back - (a - b)) - (b - (a - zz));

# l, where z and d cancel: their sum is exact. Every z but the binary32 nearest to -d, which is in doubt, leaves |l| above
# 2^-25.1·d. d_head is scaled to [1, 2]; l < 0 likewise.
#! piece l_cancelling_above
{ d_head in [1, 2] /\ z in [-4, -0.25] /\ |TAIL| <= 0x1.01p-29 /\ d_tail = TAIL * d_head /\ |DD| <= 0x1.01p-82 /\ dD = DD * d_head /\
  l / d_head in [1b-26, 0.5]
-> (l - L) / L in ? }
Q - L -> (l1 - (z + d_head)) - dD;
(l - L) / L -> (l - Q) / Q + (Q - L) / L + ((l - Q) / Q) * ((Q - L) / L) { Q <> 0, L <> 0 };
$ d_head in 4;
#! piece l_cancelling_below
{ d_head in [1, 2] /\ z in [-4, -0.25] /\ |TAIL| <= 0x1.01p-29 /\ d_tail = TAIL * d_head /\ |DD| <= 0x1.01p-82 /\ dD = DD * d_head /\
  l / d_head in [-0.5, -1b-26]
-> (l - L) / L in ? }
Q - L -> (l1 - (z + d_head)) - dD;
(l - L) / L -> (l - Q) / Q + (Q - L) / L + ((l - Q) / Q) * ((Q - L) / L) { Q <> 0, L <> 0 };
$ d_head in 4;

# l, where |l| is more than half of d_head, d = 0 included; l is scaled to [1, 2], its sign immaterial.
#! piece l_far_above
{ l in [1, 2] /\ d_head in [0, 4] /\ |d_tail| <= 0x1.01p-27 /\ |dD| <= 0x1.01p-80 -> (l - L) / L in ? }
Q - L -> (l1 - (z + d_head)) - dD;
(l - L) / L -> (l - Q) / Q + (Q - L) / L + ((l - Q) / Q) * ((Q - L) / L) { Q <> 0, L <> 0 };
(Q - L) / L -> ((l1 - (z + d_head)) / (z + d_head)) * ((z + d_head) / L) - dD / L { L <> 0, z + d_head <> 0 };
(z + d_head) / L -> 1 - (d_tail + dD) / L { L <> 0 };
z + d_head -> L - (d_tail + dD);
#! piece l_far_below
{ l in [-2, -1] /\ d_head in [0, 4] /\ |d_tail| <= 0x1.01p-27 /\ |dD| <= 0x1.01p-80 -> (l - L) / L in ? }
Q - L -> (l1 - (z + d_head)) - dD;
(l - L) / L -> (l - Q) / Q + (Q - L) / L + ((l - Q) / Q) * ((Q - L) / L) { Q <> 0, L <> 0 };
(Q - L) / L -> ((l1 - (z + d_head)) / (z + d_head)) * ((z + d_head) / L) - dD / L { L <> 0, z + d_head <> 0 };
(z + d_head) / L -> 1 - (d_tail + dD) / L { L <> 0 };
z + d_head -> L - (d_tail + dD);

# The force, inside (rho < R), in the units of docs/laws.md; x > 0 and l > 0, the other signs being mirror images. x = 0, for
# which F_x is exactly 0, is in force_z.
#! piece force_x
{ |near_v -/ TRUE_V| <= 0x1.cp-52 # from cylinder v_
/\ |near_l -/ TRUE_L| <= 0x1.01p-52 # from cylinder l_
/\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ TRUE_V in [1b-55, 1b27] /\ TRUE_L in [1b-43, 10001] /\ x in [1b-30, 10000]
/\ XX / LL in [0, 1b140] /\ R / RHO in [1, 1b60] /\ RHO in [1b-43, 10001]
-> (fx - FX) / FX in ? }
#! piece force_z
{ |near_v -/ TRUE_V| <= 0x1.cp-52 # from cylinder v_
/\ |near_l -/ TRUE_L| <= 0x1.01p-52 # from cylinder l_
/\ K in [1b-10, 1000] /\ R in [0x1.9p-4, 10000] /\ TRUE_V in [1b-55, 1b27] /\ TRUE_L in [1b-43, 10001] /\ x in [0, 10000]
/\ XX / LL in [0, 1b140] /\ R / RHO in [1, 1b60] /\ RHO in [1b-43, 10001]
-> (fz - FZ) / FZ in ? }
