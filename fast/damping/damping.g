# SPDX-License-Identifier: BSD-3-Clause
# The absolute errors of damping in binary64 (fast/damping/filter.h). How the scripts are written and run: docs/proofs.md.
#
# All that is used of an operation is that it is within 2^-53 of its result, relative (rel=: tests/fast/gappa_pieces.sh), so that every
# factor may be scaled. Products of two binary32 numbers are exact.

a = a_; b = b_; c = c_;
sum_ab rel= a + b; sum rel= sum_ab + c;
SUM = (a + b) + c;
along = along_; square = square_; damping = damping_;
v = v_; f = f_; scale = scale_; per_square = per_square_; rate = rate_; share = share_;
inverse rel= 1 / square; ratio rel= along * inverse;
turn rel= damping * ratio;
TURN = damping * (ALONG * (1 / SQUARE));
pull rel= ratio * f; across rel= v - pull;
ACROSS = v - (ALONG * (1 / SQUARE)) * f;
pressed rel= scale * square; full rel= pressed * per_square;
FULL = scale * SQUARE * PER_SQUARE;
x any= float<ieee_32, ne>(x_);
before any= float<ieee_32, ne>(before_);
way rel= x - before; speed rel= rate * way;
gain rel= speed - v; part rel= share * gain; after rel= v + part;
SPEED = rate * (x - before);
AFTER = v + share * (SPEED - v);
# A sum of three products, beside the sum of their sizes, 1. Of squares it is relative.
#! piece part_sum
{ |a + b| <= 1 /\ |(a + b) + c| <= 1 -> sum - SUM in ? }
# B (v·f)/f², beside B times the sum of the sizes of v·f over f².
#! piece turn
{ |ALONG| <= 1 /\ SQUARE in [1, 1] /\ damping in [1, 1]
/\ |along - ALONG| <= 0x1.001p-52  # from damping part_sum
/\ |square - SQUARE| <= 0x1.001p-52  # from damping part_sum
-> turn - TURN in ? }
# v less its part along f: a component, beside the larger of v and the part's size.
#! piece across
{ |ALONG| <= 1 /\ SQUARE in [1, 1] /\ |f| <= 1 /\ |v| <= 1
/\ |along - ALONG| <= 0x1.001p-52  # from damping part_sum
/\ |square - SQUARE| <= 0x1.001p-52  # from damping part_sum
-> across - ACROSS in ? }
# s f²/F₀², relative; s as it was computed.
#! piece full
{ scale in [1, 1] /\ SQUARE in [1, 1] /\ PER_SQUARE in [1, 1]
/\ |square - SQUARE| <= 0x1.001p-52  # from damping part_sum
/\ |per_square - PER_SQUARE| <= 1b-53 -> full - FULL in ? }
# The velocity after a period, beside the larger of v and u.
#! piece velocity
{ |SPEED| <= 1 /\ rate in [1, 0x1p17] /\ |v| <= 1 /\ share in [1b-10, 1] -> after - AFTER in ? }
