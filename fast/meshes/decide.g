# SPDX-License-Identifier: BSD-3-Clause
# The absolute errors of the god-object's polynomials in binary64 (fast/meshes/decide.h): of cross products, and of products of
# two vectors, beside the bounds that the compiler computes (fast/meshes/rounding_bound.h). How the scripts are written and
# run: docs/proofs.md.
#
# All that is used of an operation is that it is within 2^-53 of its result, relative. So each vector may be taken with a largest
# component of 1. A difference of coordinates is rounded once; an offset is within 2^-52 of its largest component.

ax = ax_; ay = ay_; az = az_;
bx = bx_; by = by_; bz = bz_;
cx = cx_; cy = cy_; cz = cz_;
dx = dx_; dy = dy_; dz = dz_;
# n = a x b, m = c x d.
nx = sub_rel<53>(mul_rel<53>(ay, bz), mul_rel<53>(az, by));
NX = AY * BZ - AZ * BY;
ny = sub_rel<53>(mul_rel<53>(az, bx), mul_rel<53>(ax, bz));
NY = AZ * BX - AX * BZ;
nz = sub_rel<53>(mul_rel<53>(ax, by), mul_rel<53>(ay, bx));
NZ = AX * BY - AY * BX;
mx = sub_rel<53>(mul_rel<53>(cy, dz), mul_rel<53>(cz, dy));
MX = CY * DZ - CZ * DY;
my = sub_rel<53>(mul_rel<53>(cz, dx), mul_rel<53>(cx, dz));
MY = CZ * DX - CX * DZ;
mz = sub_rel<53>(mul_rel<53>(cx, dy), mul_rel<53>(cy, dx));
MZ = CX * DY - CY * DX;
short = add_rel<53>(add_rel<53>(mul_rel<53>(ax, bx), mul_rel<53>(ay, by)), mul_rel<53>(az, bz));
SHORT = (AX * BX + AY * BY) + AZ * BZ;
across = add_rel<53>(add_rel<53>(mul_rel<53>(nx, cx), mul_rel<53>(ny, cy)), mul_rel<53>(nz, cz));
ACROSS = (NX * CX + NY * CY) + NZ * CZ;
inside = add_rel<53>(add_rel<53>(mul_rel<53>(mx, nx), mul_rel<53>(my, ny)), mul_rel<53>(mz, nz));
INSIDE = (MX * NX + MY * NY) + MZ * NZ;
all = all_; second = second_; other = other_;
third = sub_rel<53>(all, add_rel<53>(second, other));
THIRD = ALL - (SECOND + OTHER);
# Of two differences: a triangle's normal.
#! piece normal
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
-> nx - NX in ? }
# Of an offset and a difference; of two differences; of two offsets.
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
# Two normals.
#! piece area
{ |ax| <= 1 /\ |ay| <= 1 /\ |az| <= 1 /\ |ax - AX| <= 1b-53 /\ |ay - AY| <= 1b-53 /\ |az - AZ| <= 1b-53
/\ |bx| <= 1 /\ |by| <= 1 /\ |bz| <= 1 /\ |bx - BX| <= 1b-53 /\ |by - BY| <= 1b-53 /\ |bz - BZ| <= 1b-53
/\ |cx| <= 1 /\ |cy| <= 1 /\ |cz| <= 1 /\ |cx - CX| <= 1b-53 /\ |cy - CY| <= 1b-53 /\ |cz - CZ| <= 1b-53
/\ |dx| <= 1 /\ |dy| <= 1 /\ |dz| <= 1 /\ |dx - DX| <= 1b-53 /\ |dy - DY| <= 1b-53 /\ |dz - DZ| <= 1b-53
-> inside - INSIDE in ? }
# What is left of n·n without the weights of two corners, whose sizes and errors the pieces area and inside bound.
#! piece third
{ |all| <= 12.0001 /\ |second| <= 12.0001 /\ |other| <= 12.0001 /\ |all - ALL| <= 128b-53 /\ |second - SECOND| <= 140b-53
/\ |other - OTHER| <= 140b-53 -> third - THIRD in ? }
