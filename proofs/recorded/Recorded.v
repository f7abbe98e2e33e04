(* SPDX-License-Identifier: BSD-3-Clause *)
(* Double-double's values and the first stage of each law, as the headers have them. Written by a program,
   tests/proofs/recorded_terms.cpp:
   ninja -C build/release recorded_terms && build/release/tests/recorded_terms > proofs/recorded/Recorded.v *)
From Coq Require Import ZArith Bool.
From Flocq Require Import BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations.

(* fast/numbers/double_double.h: hi and lo *)
Definition two_sum (a b : binary64) : binary64 * binary64 :=
  let t1 := plus a b in
  let t2 := minus t1 a in
  let t3 := minus t1 t2 in
  let t4 := minus a t3 in
  let t5 := minus b t2 in
  let t6 := plus t4 t5 in
  (t1, t6).
Definition fast_two_sum (a b : binary64) : binary64 * binary64 :=
  let t1 := plus a b in
  let t2 := minus t1 a in
  let t3 := minus b t2 in
  (t1, t3).
Definition two_product (a b : binary64) : binary64 * binary64 :=
  let t1 := times a b in
  let t2 := opp t1 in
  let t3 := fused a b t2 in
  (t1, t3).
Definition sum_of (a_hi a_lo b_hi b_lo : binary64) : binary64 * binary64 :=
  let t1 := plus a_hi b_hi in
  let t2 := minus t1 a_hi in
  let t3 := minus t1 t2 in
  let t4 := minus a_hi t3 in
  let t5 := minus b_hi t2 in
  let t6 := plus t4 t5 in
  let t7 := plus a_lo b_lo in
  let t8 := plus t6 t7 in
  let t9 := plus t1 t8 in
  let t10 := minus t7 a_lo in
  let t11 := minus t7 t10 in
  let t12 := minus a_lo t11 in
  let t13 := minus b_lo t10 in
  let t14 := plus t12 t13 in
  let t15 := minus t9 t1 in
  let t16 := minus t8 t15 in
  let t17 := plus t14 t16 in
  let t18 := plus t9 t17 in
  let t19 := minus t18 t9 in
  let t20 := minus t17 t19 in
  (t18, t20).
Definition product_of (a_hi a_lo b_hi b_lo : binary64) : binary64 * binary64 :=
  let t1 := times a_hi b_hi in
  let t2 := opp t1 in
  let t3 := fused a_hi b_hi t2 in
  let t4 := times a_lo b_lo in
  let t5 := fused a_lo b_hi t4 in
  let t6 := fused a_hi b_lo t5 in
  let t7 := plus t3 t6 in
  let t8 := plus t1 t7 in
  let t9 := minus t8 t1 in
  let t10 := minus t7 t9 in
  (t8, t10).
Definition quotient_of (a_hi a_lo b_hi b_lo : binary64) : binary64 * binary64 :=
  let t1 := over a_hi b_hi in
  let t2 := times t1 b_hi in
  let t3 := minus a_hi t2 in
  let t4 := opp t2 in
  let t5 := fused t1 b_hi t4 in
  let t6 := minus t3 t5 in
  let t7 := opp t1 in
  let t8 := fused t7 b_lo a_lo in
  let t9 := plus t6 t8 in
  let t10 := over t9 b_hi in
  let t11 := plus t1 t10 in
  let t12 := minus t11 t1 in
  let t13 := minus t10 t12 in
  (t11, t13).
Definition square_root_of (a_hi a_lo : binary64) : binary64 * binary64 :=
  let t1 := square_root a_hi in
  let t2 := opp t1 in
  let t3 := fused t2 t1 a_hi in
  let t4 := plus t3 a_lo in
  let t5 := plus t1 t1 in
  let t6 := over t4 t5 in
  let t7 := plus t1 t6 in
  let t8 := minus t7 t1 in
  let t9 := minus t6 t8 in
  (t7, t9).

(* fast/laws/wall.h *)
Definition wall (is_fused : bool)
    (K x z : binary64) : FirstStage :=
  let t1 := times (opp K) z in
  let t2 := larger t1 zero64 in
  let t3 := is_less z zero64 in
  {| first_x := zero64; first_z := t2; first_contact := t3; first_doubt := false |}.
Definition wall_window : Z := 0.  (* doubt_window(kErrorBound) *)

(* fast/laws/cylinder.h *)
Definition cylinder (is_fused : bool)
    (K R anchor anchored rest d_head d_tail axis x z : binary64) : FirstStage :=
  let t1 := multiply_subtract is_fused x x anchored in
  let t2 := multiply_subtract is_fused z z t1 in
  let t3 := minus t2 anchor in
  let t4 := multiply_subtract is_fused z (times (two_to (1)) d_head) t3 in
  let t5 := minus anchored t1 in
  let t6 := multiply_subtract is_fused x x t5 in
  let t7 := minus t1 t2 in
  let t8 := multiply_subtract is_fused z z t7 in
  let t9 := plus t6 t8 in
  let t10 := times z (times (two_to (1)) d_tail) in
  let t11 := minus rest t10 in
  let t12 := plus t9 t11 in
  let t13 := plus t4 t12 in
  let t14 := times K t13 in
  let t15 := larger t14 zero64 in
  let t16 := plus z d_head in
  let t17 := plus t16 d_tail in
  let t18 := times t17 t17 in
  let t19 := multiply_add is_fused x x t18 in
  let t20 := square_root t19 in
  let t21 := plus R t20 in
  let t22 := times t21 t20 in
  let t23 := over t15 t22 in
  let t24 := times t23 x in
  let t25 := times t23 t17 in
  let t26 := is_less zero64 t13 in
  let t27 := absolute t13 in
  let t28 := absolute z in
  let t29 := multiply_add is_fused t28 (times (two_to (-25)) d_head) (times (two_to (-50)) anchor) in
  let t30 := is_less t27 t29 in
  let t31 := is_equal z axis in
  let t32 := orb t30 t31 in
  {| first_x := t24; first_z := t25; first_contact := t26; first_doubt := t32 |}.
Definition cylinder_window : Z := 19.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_cylinder.h *)
Definition bump_cylinder (is_fused : bool)
    (K R anchor anchored rest d_head d_tail axis x z : binary64) : FirstStage :=
  let t1 := multiply_subtract is_fused x x anchored in
  let t2 := multiply_subtract is_fused z z t1 in
  let t3 := minus t2 anchor in
  let t4 := multiply_subtract is_fused z (times (two_to (1)) d_head) t3 in
  let t5 := minus anchored t1 in
  let t6 := multiply_subtract is_fused x x t5 in
  let t7 := minus t1 t2 in
  let t8 := multiply_subtract is_fused z z t7 in
  let t9 := plus t6 t8 in
  let t10 := times z (times (two_to (1)) d_tail) in
  let t11 := minus rest t10 in
  let t12 := plus t9 t11 in
  let t13 := plus t4 t12 in
  let t14 := times K t13 in
  let t15 := larger t14 zero64 in
  let t16 := plus z d_head in
  let t17 := plus t16 d_tail in
  let t18 := times t17 t17 in
  let t19 := multiply_add is_fused x x t18 in
  let t20 := square_root t19 in
  let t21 := plus R t20 in
  let t22 := times t21 t20 in
  let t23 := over t15 t22 in
  let t24 := times t23 x in
  let t25 := times t23 t17 in
  let t26 := times (opp K) z in
  let t27 := larger t26 zero64 in
  let t28 := plus t25 t27 in
  let t29 := is_less zero64 t13 in
  let t30 := is_less z zero64 in
  let t31 := orb t29 t30 in
  let t32 := absolute t13 in
  let t33 := absolute z in
  let t34 := multiply_add is_fused t33 (times (two_to (-25)) d_head) (times (two_to (-50)) anchor) in
  let t35 := is_less t32 t34 in
  let t36 := is_at_most z axis in
  let t37 := andb t29 t36 in
  let t38 := orb t35 t37 in
  {| first_x := t24; first_z := t28; first_contact := t31; first_doubt := t38 |}.
Definition bump_cylinder_window : Z := 19.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_1p.h *)
Definition bump_1p (is_fused : bool)
    (K x z : binary64) : FirstStage :=
  let t1 := times (opp K) z in
  let t2 := larger t1 zero64 in
  let t3 := is_less z zero64 in
  {| first_x := zero64; first_z := t2; first_contact := t3; first_doubt := false |}.
Definition bump_1p_window : Z := 0.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_2p.h *)
Definition bump_2p (is_fused : bool)
    (height height_tail slope slope_tail K K_sine K_cosine half_width x z : binary64) : FirstStage :=
  let t1 := absolute x in
  let t2 := is_at_most t1 half_width in
  let t3 := multiply_subtract is_fused slope t1 height in
  let t4 := minus t3 z in
  let t5 := minus height t3 in
  let t6 := multiply_subtract is_fused slope t1 t5 in
  let t7 := times slope_tail t1 in
  let t8 := minus height_tail t7 in
  let t9 := plus t6 t8 in
  let t10 := plus t4 t9 in
  let t11 := opp z in
  let t12 := if t2 then t10 else t11 in
  let t13 := larger t12 zero64 in
  let t14 := is_less x zero64 in
  let t15 := if t14 then (opp K_sine) else K_sine in
  let t16 := if t2 then t15 else zero64 in
  let t17 := times t13 t16 in
  let t18 := if t2 then K_cosine else K in
  let t19 := times t13 t18 in
  let t20 := is_less zero64 t13 in
  let t21 := absolute t10 in
  let t22 := times (two_to (-27)) height in
  let t23 := is_less t21 t22 in
  let t24 := andb t2 t23 in
  {| first_x := t17; first_z := t19; first_contact := t20; first_doubt := t24 |}.
Definition bump_2p_window : Z := 9.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_3p.h *)
Definition bump_3p (is_fused : bool)
    (top_height top_height_tail side_height side_height_tail side_slope side_slope_tail K K_sine K_cosine half_width half_top x z : binary64) : FirstStage :=
  let t1 := absolute x in
  let t2 := is_at_most t1 half_width in
  let t3 := is_at_most t1 half_top in
  let t4 := if t3 then zero64 else side_slope in
  let t5 := if t3 then top_height else side_height in
  let t6 := multiply_subtract is_fused t4 t1 t5 in
  let t7 := minus t6 z in
  let t8 := minus t5 t6 in
  let t9 := multiply_subtract is_fused t4 t1 t8 in
  let t10 := if t3 then top_height_tail else side_height_tail in
  let t11 := if t3 then zero64 else side_slope_tail in
  let t12 := times t11 t1 in
  let t13 := minus t10 t12 in
  let t14 := plus t9 t13 in
  let t15 := plus t7 t14 in
  let t16 := opp z in
  let t17 := if t2 then t15 else t16 in
  let t18 := larger t17 zero64 in
  let t19 := negb t3 in
  let t20 := andb t2 t19 in
  let t21 := is_less x zero64 in
  let t22 := if t21 then (opp K_sine) else K_sine in
  let t23 := if t20 then t22 else zero64 in
  let t24 := times t18 t23 in
  let t25 := if t20 then K_cosine else K in
  let t26 := times t18 t25 in
  let t27 := is_less zero64 t18 in
  let t28 := absolute t15 in
  let t29 := times (two_to (-27)) t5 in
  let t30 := is_less t28 t29 in
  let t31 := andb t2 t30 in
  {| first_x := t24; first_z := t26; first_contact := t27; first_doubt := t31 |}.
Definition bump_3p_window : Z := 9.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_1p_shaded.h *)
Definition bump_1p_shaded (is_fused : bool)
    (R K_over_R half_width x z : binary64) : FirstStage :=
  let t1 := opp z in
  let t2 := larger t1 zero64 in
  let t3 := times t2 K_over_R in
  let t4 := absolute x in
  let t5 := is_at_most t4 half_width in
  let t6 := if t5 then x else zero64 in
  let t7 := times t3 t6 in
  let t8 := minus R t6 in
  let t9 := plus R t6 in
  let t10 := times t8 t9 in
  let t11 := square_root t10 in
  let t12 := times t3 t11 in
  let t13 := is_less z zero64 in
  {| first_x := t7; first_z := t12; first_contact := t13; first_doubt := false |}.
Definition bump_1p_shaded_window : Z := 9.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_2p_shaded.h *)
Definition bump_2p_shaded (is_fused : bool)
    (height height_tail slope slope_tail R K_over_R half_width x z : binary64) : FirstStage :=
  let t1 := absolute x in
  let t2 := is_at_most t1 half_width in
  let t3 := multiply_subtract is_fused slope t1 height in
  let t4 := minus t3 z in
  let t5 := minus height t3 in
  let t6 := multiply_subtract is_fused slope t1 t5 in
  let t7 := times slope_tail t1 in
  let t8 := minus height_tail t7 in
  let t9 := plus t6 t8 in
  let t10 := plus t4 t9 in
  let t11 := opp z in
  let t12 := if t2 then t10 else t11 in
  let t13 := larger t12 zero64 in
  let t14 := times t13 K_over_R in
  let t15 := if t2 then x else zero64 in
  let t16 := times t14 t15 in
  let t17 := minus R t15 in
  let t18 := plus R t15 in
  let t19 := times t17 t18 in
  let t20 := square_root t19 in
  let t21 := times t14 t20 in
  let t22 := is_less zero64 t13 in
  let t23 := absolute t10 in
  let t24 := times (two_to (-27)) height in
  let t25 := is_less t23 t24 in
  let t26 := andb t2 t25 in
  {| first_x := t16; first_z := t21; first_contact := t22; first_doubt := t26 |}.
Definition bump_2p_shaded_window : Z := 13.  (* doubt_window(kErrorBound) *)

(* fast/laws/bump_3p_shaded.h *)
Definition bump_3p_shaded (is_fused : bool)
    (top_height top_height_tail side_height side_height_tail side_slope side_slope_tail R K_over_R half_width half_top x z : binary64) : FirstStage :=
  let t1 := absolute x in
  let t2 := is_at_most t1 half_width in
  let t3 := is_at_most t1 half_top in
  let t4 := if t3 then zero64 else side_slope in
  let t5 := if t3 then top_height else side_height in
  let t6 := multiply_subtract is_fused t4 t1 t5 in
  let t7 := minus t6 z in
  let t8 := minus t5 t6 in
  let t9 := multiply_subtract is_fused t4 t1 t8 in
  let t10 := if t3 then top_height_tail else side_height_tail in
  let t11 := if t3 then zero64 else side_slope_tail in
  let t12 := times t11 t1 in
  let t13 := minus t10 t12 in
  let t14 := plus t9 t13 in
  let t15 := plus t7 t14 in
  let t16 := opp z in
  let t17 := if t2 then t15 else t16 in
  let t18 := larger t17 zero64 in
  let t19 := times t18 K_over_R in
  let t20 := if t2 then x else zero64 in
  let t21 := times t19 t20 in
  let t22 := minus R t20 in
  let t23 := plus R t20 in
  let t24 := times t22 t23 in
  let t25 := square_root t24 in
  let t26 := times t19 t25 in
  let t27 := is_less zero64 t18 in
  let t28 := absolute t15 in
  let t29 := times (two_to (-27)) t5 in
  let t30 := is_less t28 t29 in
  let t31 := andb t2 t30 in
  {| first_x := t21; first_z := t26; first_contact := t27; first_doubt := t31 |}.
Definition bump_3p_shaded_window : Z := 13.  (* doubt_window(kErrorBound) *)
