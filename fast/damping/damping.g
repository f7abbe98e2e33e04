# SPDX-License-Identifier: BSD-3-Clause
# The absolute errors of damping in binary64 (fast/damping/filter.h). How the scripts are written and run: docs/proofs.md.
#
# All that is used of an operation is that it is within 2^-53 of its result, relative (rel=: tests/fast/gappa_pieces.sh), so that every
# factor may be scaled. Products of two binary32 numbers are exact.

a = a_; b = b_; c = c_;
sum_ab rel= a + b; sum rel= sum_ab + c;
SUM = (a + b) + c;
along = along_; square = square_; damping = damping_; margin = margin_;
v = v_; f = f_; scale = scale_; drag = drag_; per_square = per_square_; keep = keep_; gain = gain_;
per rel= damping / square; moved rel= along + margin; turn rel= per * moved;
TURN = (damping / SQUARE) * (ALONG + margin);
part rel= square * per_square; full rel= scale * part;
FULL = scale * (SQUARE * PER_SQUARE);
inverse rel= 1 / square; ratio rel= along * inverse; pull rel= drag * ratio; both rel= scale + pull;
pressed rel= both * f; dragged rel= drag * v; force rel= pressed - dragged;
FORCE = (scale + drag * (ALONG * (1 / SQUARE))) * f - drag * v;
x any= float<ieee_32, ne>(x_);
before any= float<ieee_32, ne>(before_);
way rel= x - before; kept rel= keep * v; gained rel= gain * way; after rel= kept + gained;
GAINED = gain * (x - before);
AFTER = keep * v + GAINED;
# A sum of three products, beside the sum of their sizes, 1. Of squares it is relative.
#! piece part_sum
{ |a + b| <= 1 /\ |(a + b) + c| <= 1 -> sum - SUM in ? }
# B (v·f)/f², beside B times the sum of the sizes of v·f over f²; the margin is 16 units of 2^-53 of that sum.
#! piece turn
{ |ALONG| <= 1 /\ SQUARE in [1, 1] /\ damping in [1, 1] /\ |margin| <= 0x1.001p-49
/\ |along - ALONG| <= 0x1.001p-52  # from damping part_sum
/\ |square - SQUARE| <= 0x1.001p-52  # from damping part_sum
-> turn - TURN in ? }
# s f²/F₀², relative; s as it was computed.
#! piece full
{ scale in [1, 1] /\ SQUARE in [1, 1] /\ PER_SQUARE in [1, 1]
/\ |square - SQUARE| <= 0x1.001p-52  # from damping part_sum
/\ |per_square - PER_SQUARE| <= 1b-53 -> full - FULL in ? }
# A component of the force with drag, beside the largest of s|f|, q times the sum of the sizes of v·f over f² times |f|, and q|v|.
#! piece force
{ |scale| <= 1 /\ drag in [1, 1] /\ |f| <= 1 /\ |v| <= 1 /\ |ALONG| <= 1 /\ SQUARE in [1, 1]
/\ |along - ALONG| <= 0x1.001p-52  # from damping part_sum
/\ |square - SQUARE| <= 0x1.001p-52  # from damping part_sum
-> force - FORCE in ? }
# The velocity after a period, beside the larger of what is kept and what is gained.
#! piece velocity
{ |keep * v| <= 1 /\ |GAINED| <= 1 -> after - AFTER in ? }
