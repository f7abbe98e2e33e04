# SPDX-License-Identifier: BSD-3-Clause
# The absolute errors of the god-object's polynomials in binary64 (fast/meshes/decide.h): of cross products, and of products of
# two vectors, beside the bounds that the compiler computes (fast/meshes/rounding_bound.h). How the scripts are written and
# run: docs/proofs.md.
#
# All that is used of an operation is that it is within 2^-53 of its result, relative (rel=: tests/fast/gappa_pieces.sh). So each
# vector may be taken with a largest component of 1. A difference of coordinates is rounded once; an offset is within 2^-52 of
# its largest component.

ax = ax_; ay = ay_; az = az_;
bx = bx_; by = by_; bz = bz_;
cx = cx_; cy = cy_; cz = cz_;
dx = dx_; dy = dy_; dz = dz_;
# n = a x b, m = c x d.
nx_plus rel= ay * bz; nx_minus rel= az * by; nx rel= nx_plus - nx_minus;
NX = AY * BZ - AZ * BY;
ny_plus rel= az * bx; ny_minus rel= ax * bz; ny rel= ny_plus - ny_minus;
NY = AZ * BX - AX * BZ;
nz_plus rel= ax * by; nz_minus rel= ay * bx; nz rel= nz_plus - nz_minus;
NZ = AX * BY - AY * BX;
mx_plus rel= cy * dz; mx_minus rel= cz * dy; mx rel= mx_plus - mx_minus;
MX = CY * DZ - CZ * DY;
my_plus rel= cz * dx; my_minus rel= cx * dz; my rel= my_plus - my_minus;
MY = CZ * DX - CX * DZ;
mz_plus rel= cx * dy; mz_minus rel= cy * dx; mz rel= mz_plus - mz_minus;
MZ = CX * DY - CY * DX;
# p = n x d: a component.
px_plus rel= ny * dz; px_minus rel= nz * dy; px rel= px_plus - px_minus;
PX = NY * DZ - NZ * DY;
# Products of two vectors.
short_x rel= ax * bx; short_y rel= ay * by; short_z rel= az * bz; short_xy rel= short_x + short_y; short rel= short_xy + short_z;
SHORT = (AX * BX + AY * BY) + AZ * BZ;
across_x rel= nx * cx; across_y rel= ny * cy; across_z rel= nz * cz; across_xy rel= across_x + across_y; across rel= across_xy + across_z;
ACROSS = (NX * CX + NY * CY) + NZ * CZ;
inside_x rel= mx * nx; inside_y rel= my * ny; inside_z rel= mz * nz; inside_xy rel= inside_x + inside_y; inside rel= inside_xy + inside_z;
INSIDE = (MX * NX + MY * NY) + MZ * NZ;
all = all_; second = second_; other = other_;
others rel= second + other; third rel= all - others;
THIRD = ALL - (SECOND + OTHER);
# Friction's decisions by parameters (fast/meshes/quick_slips.h): ck and cl are theirs, ee, ef and ff the products of the edges
# a and b, whose errors the piece length bounds.
ck = ck_; cl = cl_; lift = lift_;
ee = ee_; ef = ef_; ff = ff_;
along_k_1 rel= ck * ee; along_k_2 rel= cl * ef; along_k rel= along_k_1 + along_k_2;
along_l_1 rel= ck * ef; along_l_2 rel= cl * ff; along_l rel= along_l_1 + along_l_2;
pull_k rel= ck * along_k; pull_l rel= cl * along_l; pull rel= pull_k + pull_l;
PULL = ck * (ck * EE + cl * EF) + cl * (ck * EF + cl * FF);
twice rel= along_k + along_k; gain rel= ee - twice;
GAIN = EE - ((ck * EE + cl * EF) + (ck * EE + cl * EF));
way_1 rel= ck * ax; way_2 rel= cl * bx; way_12 rel= way_1 + way_2; way_n rel= lift * nx; way rel= way_12 + way_n;
WAY = (ck * AX + cl * BX) + lift * NX;
# A product of two differences: a triangle's normal.
#! piece normal
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
-> nx - NX in ? }
# Products of an offset and a difference; of two differences; of two offsets.
#! piece along
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-52 /\ |ay - AY| <= 1b-52 /\ |az - AZ| <= 1b-52
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
-> short - SHORT in ? }
#! piece length
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
-> short - SHORT in ? }
#! piece offset_length
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-52 /\ |ay - AY| <= 1b-52 /\ |az - AZ| <= 1b-52
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-52 /\ |by - BY| <= 1b-52 /\ |bz - BZ| <= 1b-52
-> short - SHORT in ? }
# A normal and an offset: on which side of a plane a point is.
#! piece across
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
/\ |cx| <= 1 /\ |cy| <= 1 /\ |cz| <= 1 /\ |cx - CX| <= 1b-52 /\ |cy - CY| <= 1b-52 /\ |cz - CZ| <= 1b-52
-> across - ACROSS in ? }
# The product of a difference and an offset, and a difference: on which side of an edge a flight passes.
#! piece passes
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-52 /\ |by - BY| <= 1b-52 /\ |bz - BZ| <= 1b-52
/\ |cx| <= 1 /\ |cy| <= 1 /\ |cz| <= 1 /\ |cx - CX| <= 1b-53 /\ |cy - CY| <= 1b-53 /\ |cz - CZ| <= 1b-53
-> across - ACROSS in ? }
# The product of a difference and an offset, and a normal: whether a foot is inside a triangle.
#! piece inside
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
/\ |cx| <= 1 /\ |cy| <= 1 /\ |cz| <= 1 /\ |cx - CX| <= 1b-53 /\ |cy - CY| <= 1b-53 /\ |cz - CZ| <= 1b-53
/\ |dx| <= 1 /\ |dy| <= 1 /\ |dz| <= 1 /\ |dx - DX| <= 1b-52 /\ |dy - DY| <= 1b-52 /\ |dz - DZ| <= 1b-52
-> inside - INSIDE in ? }
# A difference times an offset, and a normal times an offset, as vectors: how far a hand is off an edge, and how strongly it pulls
# along a triangle (fast/meshes/friction.h).
#! piece pressed
{ |cx| <= 1 /\ |cy| <= 1 /\ |cz| <= 1 /\ |cx - CX| <= 1b-53 /\ |cy - CY| <= 1b-53 /\ |cz - CZ| <= 1b-53
/\ |dx| <= 1 /\ |dy| <= 1 /\ |dz| <= 1 /\ |dx - DX| <= 1b-52 /\ |dy - DY| <= 1b-52 /\ |dz - DZ| <= 1b-52
-> mx - MX in ? }
#! piece pulled
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
/\ |dx| <= 1 /\ |dy| <= 1 /\ |dz| <= 1 /\ |dx - DX| <= 1b-52 /\ |dy - DY| <= 1b-52 /\ |dz - DZ| <= 1b-52
-> px - PX in ? }
# Two normals.
#! piece area
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
/\ |cx| <= 1 /\ |cy| <= 1 /\ |cz| <= 1 /\ |cx - CX| <= 1b-53 /\ |cy - CY| <= 1b-53 /\ |cz - CZ| <= 1b-53
/\ |dx| <= 1 /\ |dy| <= 1 /\ |dz| <= 1 /\ |dx - DX| <= 1b-53 /\ |dy - DY| <= 1b-53 /\ |dz - DZ| <= 1b-53
-> inside - INSIDE in ? }
# The rest of n·n without the weights of two corners, whose sizes and errors the pieces area and inside bound.
#! piece third
{ |all| <= 12.0001 /\ |second| <= 12.0001 /\ |other| <= 12.0001 /\ |all - ALL| <= 128b-53 /\ |second - SECOND| <= 140b-53
/\ |other - OTHER| <= 140b-53 -> third - THIRD in ? }
# The square of a pull, what a step of the grid adds to it, and a component of the way to the hand.
#! piece pull
{ |ck| <= 1 /\ |cl| <= 1 /\ |ee| <= 3 /\ |ef| <= 3 /\ |ff| <= 3 /\ |ee - EE| <= 14b-53 /\ |ef - EF| <= 14b-53
/\ |ff - FF| <= 14b-53 -> pull - PULL in ? }
#! piece gain
{ |ck| <= 1 /\ |cl| <= 1 /\ |ee| <= 3 /\ |ef| <= 3 /\ |ee - EE| <= 14b-53 /\ |ef - EF| <= 14b-53 -> gain - GAIN in ? }
#! piece way
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
/\ |ck| <= 1 /\ |cl| <= 1 /\ |lift| <= 1 -> way - WAY in ? }
