(* SPDX-License-Identifier: BSD-3-Clause *)
(* The form in which a batch evaluates each law, at one position, with what its watch looks at: fast/simd/, run on packs that
   write down what is done with them. Written by a program, tests/proofs/compiled/recorded_forms.cpp:
   ninja -C build/release recorded_forms && build/release/tests/recorded_forms coq > proofs/recorded/RecordedForms.v *)
From Coq Require Import ZArith List Bool.
From Flocq Require Import BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations SecondAlong Lanes.
Import ListNotations.

Definition wall_form
    (K : binary64)
    (x z : binary32) : Lane :=
  let t1 := rounded zero64 in
  let t2 := rounded (opp K) in
  let t3 := times32 t2 z in
  let t4 := larger32 t3 t1 in
  let t5 := absolute32 z in
  let t6 := absolute32 x in
  {| force_x := t1; force_z := t4; sizes := [t5; t6]; not_tiny := [t5]; distances := []; doubts := []; roundings := []; lane_window := 0;
     least_coordinate := quantum;
     least_distance := zero64 |}.

Definition cylinder_form
    (K R anchor anchored rest d_head d_tail axis : binary64)
    (x z : binary32) : Lane :=
  let t1 := widened x in
  let t2 := minus (square_root (plus (minus anchored anchor) rest)) t1 in
  let t3 := plus (square_root (plus (minus anchored anchor) rest)) t1 in
  let t4 := widened z in
  let t5 := plus t4 (times (two_to (1)) d_head) in
  let t6 := times t4 t5 in
  let t7 := opp t6 in
  let t8 := fused t2 t3 t7 in
  let t9 := fused t4 t5 t7 in
  let t10 := fused t4 (times (two_to (1)) d_tail) t9 in
  let t11 := minus t8 t10 in
  let t12 := rounded t11 in
  let t13 := rounded R in
  let t14 := rounded (times R R) in
  let t15 := minus32 t14 t12 in
  let t16 := rounded (minus (times R R) (widened (rounded (times R R)))) in
  let t17 := plus32 t15 t16 in
  let t18 := square_root32 t17 in
  let t19 := times32 t13 t18 in
  let t20 := plus32 t19 t17 in
  let t21 := over32 t12 t20 in
  let t22 := widened t21 in
  let t23 := minus (times R R) t11 in
  let t24 := times t22 t23 in
  let t25 := opp t24 in
  let t26 := plus t22 (two_to (1)) in
  let t27 := fused t25 t26 t11 in
  let t28 := fused t22 (over (times (two_to (-1)) K) (times R R)) (over (times (two_to (-1)) K) (times R R)) in
  let t29 := times t22 K in
  let t30 := fused t27 t28 t29 in
  let t31 := larger t30 zero64 in
  let t32 := fused t31 t1 zero64 in
  let t33 := rounded t32 in
  let t34 := plus t4 d_head in
  let t35 := plus t34 d_tail in
  let t36 := fused t31 t35 zero64 in
  let t37 := rounded t36 in
  let t38 := absolute32 z in
  let t39 := absolute32 x in
  let t40 := rounded (times (times sixteen_hundredths R) R) in
  let t41 := is_less32 t17 t40 in
  let t42 := rounded axis in
  let t43 := is_equal32 z t42 in
  let t44 := orb t41 t43 in
  {| force_x := t33; force_z := t37; sizes := [t38; t39]; not_tiny := [t38; t39]; distances := [t11]; doubts := [t44]; roundings := [t32;
    t36]; lane_window := 2561;
     least_coordinate := (greatest32 quantum (rounded (times (two_to (-27)) (greatest (square_root (plus (minus anchored anchor) rest))
    d_head))));
     least_distance := (times (times (two_to (-24)) R) R) |}.

Definition bump_cylinder_form
    (K R anchor anchored rest d_head d_tail axis : binary64)
    (x z : binary32) : Lane :=
  let t1 := widened x in
  let t2 := minus (square_root (plus (minus anchored anchor) rest)) t1 in
  let t3 := plus (square_root (plus (minus anchored anchor) rest)) t1 in
  let t4 := widened z in
  let t5 := plus t4 (times (two_to (1)) d_head) in
  let t6 := times t4 t5 in
  let t7 := opp t6 in
  let t8 := fused t2 t3 t7 in
  let t9 := fused t4 t5 t7 in
  let t10 := fused t4 (times (two_to (1)) d_tail) t9 in
  let t11 := minus t8 t10 in
  let t12 := rounded t11 in
  let t13 := rounded R in
  let t14 := rounded (times R R) in
  let t15 := minus32 t14 t12 in
  let t16 := rounded (minus (times R R) (widened (rounded (times R R)))) in
  let t17 := plus32 t15 t16 in
  let t18 := square_root32 t17 in
  let t19 := times32 t13 t18 in
  let t20 := plus32 t19 t17 in
  let t21 := over32 t12 t20 in
  let t22 := widened t21 in
  let t23 := minus (times R R) t11 in
  let t24 := times t22 t23 in
  let t25 := opp t24 in
  let t26 := plus t22 (two_to (1)) in
  let t27 := fused t25 t26 t11 in
  let t28 := fused t22 (over (times (two_to (-1)) K) (times R R)) (over (times (two_to (-1)) K) (times R R)) in
  let t29 := times t22 K in
  let t30 := fused t27 t28 t29 in
  let t31 := larger t30 zero64 in
  let t32 := fused t31 t1 zero64 in
  let t33 := rounded t32 in
  let t34 := plus t4 d_head in
  let t35 := plus t34 d_tail in
  let t36 := opp K in
  let t37 := times t36 t4 in
  let t38 := larger t37 zero64 in
  let t39 := fused t31 t35 t38 in
  let t40 := rounded t39 in
  let t41 := absolute32 z in
  let t42 := absolute32 x in
  let t43 := rounded (times (times sixteen_hundredths R) R) in
  let t44 := is_less32 t17 t43 in
  let t45 := rounded zero64 in
  let t46 := is_less32 t45 t12 in
  let t47 := rounded axis in
  let t48 := is_at_most32 z t47 in
  let t49 := andb t46 t48 in
  let t50 := orb t44 t49 in
  {| force_x := t33; force_z := t40; sizes := [t41; t42]; not_tiny := [t41; t42]; distances := [t11]; doubts := [t50]; roundings := [t32;
    t39]; lane_window := 2561;
     least_coordinate := (greatest32 quantum (rounded (times (two_to (-27)) (greatest (square_root (plus (minus anchored anchor) rest))
    d_head))));
     least_distance := (times (times (two_to (-24)) R) R) |}.

Definition bump_1p_form
    (K : binary64)
    (x z : binary32) : Lane :=
  let t1 := rounded zero64 in
  let t2 := rounded (opp K) in
  let t3 := times32 t2 z in
  let t4 := larger32 t3 t1 in
  let t5 := absolute32 z in
  let t6 := absolute32 x in
  {| force_x := t1; force_z := t4; sizes := [t5; t6]; not_tiny := [t5]; distances := []; doubts := []; roundings := []; lane_window := 0;
     least_coordinate := quantum;
     least_distance := zero64 |}.

Definition bump_2p_form
    (height height_tail slope slope_tail K K_sine K_cosine half_width : binary64)
    (x z : binary32) : Lane :=
  let t1 := absolute32 x in
  let t2 := rounded half_width in
  let t3 := is_at_most32 t1 t2 in
  let t4 := widened t1 in
  let t5 := minus half_width t4 in
  let t6 := widened z in
  let t7 := opp t6 in
  let t8 := fused slope t5 t7 in
  let t9 := fused slope_tail t5 t8 in
  let t10 := larger t9 zero64 in
  let t11 := times t10 K_sine in
  let t12 := rounded t11 in
  let t13 := rounded zero64 in
  let t14 := plus32 x t13 in
  let t15 := times_sign32 t12 t14 in
  let t16 := where32 t3 t15 in
  let t17 := plus32 t16 t13 in
  let t18 := times t10 K_cosine in
  let t19 := rounded t18 in
  let t20 := rounded (opp K) in
  let t21 := times32 t20 z in
  let t22 := larger32 t21 t13 in
  let t23 := choice32 t3 t19 t22 in
  let t24 := absolute32 z in
  {| force_x := t17; force_z := t23; sizes := [t24; t1]; not_tiny := [t24; t1]; distances := [t9]; doubts := []; roundings := [t11; t18];
    lane_window := 9;
     least_coordinate := (greatest32 quantum (rounded (times (two_to (-28)) half_width)));
     least_distance := (times (two_to (-20)) height) |}.

Definition bump_3p_form
    (top_height top_height_tail side_height side_height_tail side_slope side_slope_tail K K_sine K_cosine half_width half_top : binary64)
    (x z : binary32) : Lane :=
  let t1 := absolute32 x in
  let t2 := rounded half_width in
  let t3 := is_at_most32 t1 t2 in
  let t4 := rounded half_top in
  let t5 := is_less32 t4 t1 in
  let t6 := andb t3 t5 in
  let t7 := widened t1 in
  let t8 := is_at_most t7 half_top in
  let t9 := if t8 then (over (plus (fused (opp side_slope) (minus half_width half_top) top_height) top_height_tail) (minus half_width
    half_top)) else side_slope_tail in
  let t10 := larger32 t1 t4 in
  let t11 := widened t10 in
  let t12 := minus half_width t11 in
  let t13 := widened z in
  let t14 := opp t13 in
  let t15 := fused side_slope t12 t14 in
  let t16 := fused t9 t12 t15 in
  let t17 := larger t16 zero64 in
  let t18 := times t17 K_sine in
  let t19 := rounded t18 in
  let t20 := rounded zero64 in
  let t21 := plus32 x t20 in
  let t22 := times_sign32 t19 t21 in
  let t23 := where32 t6 t22 in
  let t24 := plus32 t23 t20 in
  let t25 := if t8 then K else K_cosine in
  let t26 := times t17 t25 in
  let t27 := rounded t26 in
  let t28 := rounded (opp K) in
  let t29 := times32 t28 z in
  let t30 := larger32 t29 t20 in
  let t31 := choice32 t3 t27 t30 in
  let t32 := absolute32 z in
  {| force_x := t24; force_z := t31; sizes := [t32; t1]; not_tiny := [t32; t1]; distances := [t16]; doubts := []; roundings := [t18; t26];
    lane_window := 9;
     least_coordinate := (greatest32 quantum (rounded (times (two_to (-28)) half_width)));
     least_distance := (times (two_to (-20)) side_height) |}.

Definition bump_1p_shaded_form
    (R K_over_R half_width : binary64)
    (x z : binary32) : Lane :=
  let t1 := absolute32 x in
  let t2 := rounded half_width in
  let t3 := is_at_most32 t1 t2 in
  let t4 := widened z in
  let t5 := opp t4 in
  let t6 := larger t5 zero64 in
  let t7 := times t6 K_over_R in
  let t8 := widened t1 in
  let t9 := times t7 t8 in
  let t10 := rounded t9 in
  let t11 := rounded zero64 in
  let t12 := plus32 x t11 in
  let t13 := times_sign32 t10 t12 in
  let t14 := where32 t3 t13 in
  let t15 := plus32 t14 t11 in
  let t16 := opp t8 in
  let t17 := fused t16 t8 (times R R) in
  let t18 := square_root t17 in
  let t19 := times t7 t18 in
  let t20 := rounded t19 in
  let t21 := rounded (opp (times K_over_R R)) in
  let t22 := times32 t21 z in
  let t23 := larger32 t22 t11 in
  let t24 := choice32 t3 t20 t23 in
  let t25 := absolute32 z in
  {| force_x := t15; force_z := t24; sizes := [t25; t1]; not_tiny := [t25; t1]; distances := []; doubts := []; roundings := [t9; t19];
    lane_window := 9;
     least_coordinate := quantum;
     least_distance := zero64 |}.

Definition bump_2p_shaded_form
    (height height_tail slope slope_tail R K_over_R half_width : binary64)
    (x z : binary32) : Lane :=
  let t1 := absolute32 x in
  let t2 := rounded half_width in
  let t3 := is_at_most32 t1 t2 in
  let t4 := widened t1 in
  let t5 := minus half_width t4 in
  let t6 := widened z in
  let t7 := opp t6 in
  let t8 := fused slope t5 t7 in
  let t9 := fused slope_tail t5 t8 in
  let t10 := larger t9 zero64 in
  let t11 := times t10 K_over_R in
  let t12 := times t11 t4 in
  let t13 := rounded t12 in
  let t14 := rounded zero64 in
  let t15 := plus32 x t14 in
  let t16 := times_sign32 t13 t15 in
  let t17 := where32 t3 t16 in
  let t18 := plus32 t17 t14 in
  let t19 := opp t4 in
  let t20 := fused t19 t4 (times R R) in
  let t21 := square_root t20 in
  let t22 := times t11 t21 in
  let t23 := rounded t22 in
  let t24 := rounded (opp (times K_over_R R)) in
  let t25 := times32 t24 z in
  let t26 := larger32 t25 t14 in
  let t27 := choice32 t3 t23 t26 in
  let t28 := absolute32 z in
  {| force_x := t18; force_z := t27; sizes := [t28; t1]; not_tiny := [t28; t1]; distances := [t9]; doubts := []; roundings := [t12; t22];
    lane_window := 13;
     least_coordinate := (greatest32 quantum (rounded (times (two_to (-28)) half_width)));
     least_distance := (times (two_to (-20)) height) |}.

Definition bump_3p_shaded_form
    (top_height top_height_tail side_height side_height_tail side_slope side_slope_tail R K_over_R half_width half_top : binary64)
    (x z : binary32) : Lane :=
  let t1 := absolute32 x in
  let t2 := rounded half_width in
  let t3 := is_at_most32 t1 t2 in
  let t4 := widened t1 in
  let t5 := is_at_most t4 half_top in
  let t6 := if t5 then (over (plus (fused (opp side_slope) (minus half_width half_top) top_height) top_height_tail) (minus half_width
    half_top)) else side_slope_tail in
  let t7 := rounded half_top in
  let t8 := larger32 t1 t7 in
  let t9 := widened t8 in
  let t10 := minus half_width t9 in
  let t11 := widened z in
  let t12 := opp t11 in
  let t13 := fused side_slope t10 t12 in
  let t14 := fused t6 t10 t13 in
  let t15 := larger t14 zero64 in
  let t16 := times t15 K_over_R in
  let t17 := times t16 t4 in
  let t18 := rounded t17 in
  let t19 := rounded zero64 in
  let t20 := plus32 x t19 in
  let t21 := times_sign32 t18 t20 in
  let t22 := where32 t3 t21 in
  let t23 := plus32 t22 t19 in
  let t24 := opp t4 in
  let t25 := fused t24 t4 (times R R) in
  let t26 := square_root t25 in
  let t27 := times t16 t26 in
  let t28 := rounded t27 in
  let t29 := rounded (opp (times K_over_R R)) in
  let t30 := times32 t29 z in
  let t31 := larger32 t30 t19 in
  let t32 := choice32 t3 t28 t31 in
  let t33 := absolute32 z in
  {| force_x := t23; force_z := t32; sizes := [t33; t1]; not_tiny := [t33; t1]; distances := [t14]; doubts := []; roundings := [t17; t27];
    lane_window := 13;
     least_coordinate := (greatest32 quantum (rounded (times (two_to (-28)) half_width)));
     least_distance := (times (two_to (-20)) side_height) |}.
