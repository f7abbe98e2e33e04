(* SPDX-License-Identifier: BSD-3-Clause *)
(* The first stages of the bumps of three polygons, shaded and not, given their constants. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded Gap Polygons.
Open Scope R_scope.

(* The linear pieces of top and sides, and half_top, which lies where the comparisons of binary32 numbers need it. *)
Record shape_3p (R w : binary32) (top_h top_ht side_h side_ht side_s side_st half_top : binary64) : Prop := {
  linear_top : linear top_h top_ht zero64 zero64 (top_height (value32 R) (value32 w)) 0;
  linear_side : linear side_h side_ht side_s side_st (slope_3p (value32 R) (value32 w) * (value32 w / 2))
    (slope_3p (value32 R) (value32 w));
  half_top_finite : is_finite 53 1024 half_top = true;
  half_top_decides : forall a, in_binary32 a -> (a <= value64 half_top <-> a <= top_width (value32 R) (value32 w) / 2)
}.

Lemma on_top_is : forall R w a b c d e f half_top xv X, shape_3p R w a b c d e f half_top -> coordinate xv X ->
  is_at_most (absolute xv) half_top = Rle_bool (Rabs X) (top_width (value32 R) (value32 w) / 2).
Proof.
  intros R w a b c d e f half_top xv X [_ _ Fin Dec] Hx. destruct (absolute_coordinate _ _ Hx) as (Ia & Fa & _).
  rewrite (at_most_is _ _ _ _ Ia (conj eq_refl Fin)). specialize (Dec _ Fa).
  case Rle_bool_spec; case Rle_bool_spec; intros H1 H2; try reflexivity; exfalso; apply Dec in H2 || apply Dec in H1; lra.
Qed.

(* What the first stage finds of the penetration. *)
Lemma penetration_of_three : forall is_fused R w K top_h top_ht side_h side_ht side_s side_st half_top xv X zv Z, parameters R w K ->
  shape_3p R w top_h top_ht side_h side_ht side_s side_st half_top -> coordinate xv X -> coordinate zv Z ->
  let inside := Rle_bool (Rabs X) (value32 w / 2) in
  let on_top := Rle_bool (Rabs X) (top_width (value32 R) (value32 w) / 2) in
  let h := if on_top then top_h else side_h in let ht := if on_top then top_ht else side_ht in
  let s := if on_top then zero64 else side_s in let st := if on_top then zero64 else side_st in
  let value := penetration_value is_fused inside h ht s st (absolute xv) zv in
  let unclear := is_less (absolute (gap_value is_fused h ht s st (absolute xv) zv)) (times (two_to (-27)) h) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  inside && unclear = false ->
  (is_less zero64 value = true <-> 0 < M) /\ (0 < M -> computes value (7 / 2) M (-66) 15).
Proof.
  intros is_fused R w K top_h top_ht side_h side_ht side_s side_st half_top xv X zv Z Hp [Lt Ls _ _] Hx Hz inside on_top h ht s st value
    unclear M Hclear.
  destruct (absolute_coordinate _ _ Hx) as (Ia & Fa & Ra). unfold M, penetration_3p. fold inside on_top.
    unfold value, unclear, h, ht, s, st in *.
  destruct on_top.
  - pose proof (linear_is_positive _ _ _ _ _ _ Lt) as HH.
    pose proof (penetration is_fused inside _ _ _ _ _ _ _ _ zv Z Lt Ia Fa Ra ltac:(intros _; lra) Hz Hclear) as P. cbv zeta in P.
    replace (top_height (value32 R) (value32 w) - 0 * Rabs X) with (top_height (value32 R) (value32 w)) in P by ring. exact P.
  - pose proof (linear_is_positive _ _ _ _ _ _ Ls) as HH.
    assert (HS : inside = true -> slope_3p (value32 R) (value32 w) * Rabs X <= slope_3p (value32 R) (value32 w) * (value32 w / 2)).
    { unfold inside. case Rle_bool_spec; [|discriminate]. intros Hin _. apply Rmult_le_compat_l; [|assumption].
      destruct Hp as (_ & _ & Hw & _). apply Rmult_le_reg_r with (value32 w / 2); lra. }
    pose proof (penetration is_fused inside _ _ _ _ _ _ _ _ zv Z Ls Ia Fa Ra HS Hz Hclear) as P. cbv zeta in P.
    replace (slope_3p (value32 R) (value32 w) * (value32 w / 2) - slope_3p (value32 R) (value32 w) * Rabs X) with
      (top_height (value32 R) (value32 w) * (value32 w / 2 - Rabs X) / (value32 w / 2 - top_width (value32 R) (value32 w) / 2)) in P
      by (unfold slope_3p, Rdiv; ring). exact P.
Qed.

Record factors_3p (R w K : binary32) (K_sine K_cosine : binary64) : Prop := {
  sine_3p : factor K_sine (value32 K * sine_of (slope_3p (value32 R) (value32 w)));
  cosine_3p : factor K_cosine (value32 K * cosine_of (slope_3p (value32 R) (value32 w)))
}.

Lemma flat : sine_of 0 = 0 /\ cosine_of 0 = 1.
Proof.
  unfold sine_of, cosine_of. replace (1 + Rsqr 0) with 1 by (unfold Rsqr; ring). rewrite sqrt_1. split; field.
Qed.

(* Every answer of the first stage of bump-3p is right, for every input of the domain, given its constants. *)
Theorem bump_3p_first_stage_answers_right :
  forall is_fused R w K top_h top_ht side_h side_ht side_s side_st K_sine K_cosine half_top later x y z,
  parameters R w K -> shape_3p R w top_h top_ht side_h side_ht side_s side_st half_top -> factors_3p R w K K_sine K_cosine ->
  valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  let S := slope_at (value32 R) (value32 w) X in
  right_or_later
    (evaluate bump_3p_window
       (bump_3p is_fused top_h top_ht side_h side_ht side_s side_st (to64 K) K_sine K_cosine (half_width w) half_top) later x y z)
    (later (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K top_h top_ht side_h side_ht side_s side_st K_sine K_cosine half_top later x y z Hp Hg [Hs Hc] Hv X Z M S.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz]. fold X in Hx. fold Z in Hz.
  apply (right_first_stage_gives_right_answers 8); [lia|assumption|].
  unfold is_right, bump_3p. cbv zeta. cbn [first_x first_z first_contact first_doubt]. intro Hclear.
  destruct (shaded_coordinate _ _ _ _ _ Hp Hx) as (Hi & _ & _). cbv zeta in Hi. pose proof (on_top_is _ _ _ _ _ _ _ _ _ _ _ Hg Hx) as Ht.
  rewrite Hi, Ht in Hclear |- *.
  pose proof (penetration_of_three is_fused R w K _ _ _ _ _ _ _ _ X _ Z Hp Hg Hx Hz) as P. cbv zeta in P.
  destruct (P Hclear) as [P1 P2]. clear P. split; [exact P1|]. intro HM. specialize (P2 HM). fold M in P2.
  unfold side_x, side_z. rewrite (less_is _ _ _ _ (coordinate_is _ _ Hx) zero_is). unfold S, slope_at.
  destruct (Rle_bool (Rabs X) (value32 w / 2)); destruct (Rle_bool (Rabs X) (top_width (value32 R) (value32 w) / 2));
    cbn [andb negb]; split.
  - destruct flat as [E _]. rewrite E. replace (value32 K * M * (if Rlt_bool X 0 then - 0 else 0)) with (M * 0) by
    (destruct (Rlt_bool X 0); ring).
    apply no_force_aside; [exact P2|apply zero_is].
  - destruct flat as [_ E]. rewrite E. replace (value32 K * M * 1) with (M * value32 K) by ring.
    apply unshaded_force with 0; [exact P2|now apply stiffness_computes with R w|lra].
  - set (slope := slope_3p (value32 R) (value32 w)) in *.
    replace (value32 K * M * (if Rlt_bool X 0 then - sine_of slope else sine_of slope)) with
      (M * (if Rlt_bool X 0 then - (value32 K * sine_of slope) else value32 K * sine_of slope)) by (destruct (Rlt_bool X 0); ring).
    apply unshaded_force with (101 / 100); [exact P2| |lra]. apply factor_computes in Hs. destruct (Rlt_bool X 0); [|assumption].
    destruct Hs as (v & H1 & H2 & H3). exists (- v). split; [now apply opp_is|]. split; [now apply near_opp|].
    unfold size in *. now rewrite Rabs_Ropp.
  - replace (value32 K * M * cosine_of (slope_3p (value32 R) (value32 w))) with
    (M * (value32 K * cosine_of (slope_3p (value32 R) (value32 w)))) by ring.
    apply unshaded_force with (101 / 100); [exact P2|now apply factor_computes|lra].
  - replace 0 with (M * 0) by ring. apply no_force_aside; [exact P2|apply zero_is].
  - replace (value32 K * M * 1) with (M * value32 K) by ring.
    apply unshaded_force with 0; [exact P2|now apply stiffness_computes with R w|lra].
  - replace 0 with (M * 0) by ring. apply no_force_aside; [exact P2|apply zero_is].
  - replace (value32 K * M * 1) with (M * value32 K) by ring.
    apply unshaded_force with 0; [exact P2|now apply stiffness_computes with R w|lra].
Qed.

(* The same of bump-3p-shaded. *)
Theorem bump_3p_shaded_first_stage_answers_right :
  forall is_fused R w K top_h top_ht side_h side_ht side_s side_st half_top later x y z,
  parameters R w K -> shape_3p R w top_h top_ht side_h side_ht side_s side_st half_top -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  right_or_later
    (evaluate bump_3p_shaded_window
       (bump_3p_shaded is_fused top_h top_ht side_h side_ht side_s side_st (to64 R) (K_over_R K R) (half_width w) half_top) later x y z)
    (later (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K top_h top_ht side_h side_ht side_s side_st half_top later x y z Hp Hg Hv X Z M.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz]. fold X in Hx. fold Z in Hz.
  apply (right_first_stage_gives_right_answers 12); [lia|assumption|].
  unfold is_right, bump_3p_shaded. cbv zeta. cbn [first_x first_z first_contact first_doubt]. intro Hclear.
  destruct (shaded_coordinate _ _ _ _ _ Hp Hx) as (Hi & Hs & HS). cbv zeta in Hi, Hs, HS.
  pose proof (on_top_is _ _ _ _ _ _ _ _ _ _ _ Hg Hx) as Ht. rewrite Hi in Hs. rewrite Hi, Ht in Hclear |- *.
  pose proof (penetration_of_three is_fused R w K _ _ _ _ _ _ _ _ X _ Z Hp Hg Hx Hz) as P. cbv zeta in P.
  destruct (P Hclear) as [P1 P2]. clear P. split; [exact P1|]. intro HM. specialize (P2 HM). fold M in P2.
  pose proof Hp as (_ & HR & Hw & _).
  destruct (shaded_force_is (value32 R) (value32 w) (value32 K) X M ltac:(lra) ltac:(lra)) as [<- <-].
  refine (shaded_force 12 R w K _ _ _ (7 / 2) M Hp Hs HS P2 ltac:(lra) _). unfold one. lra.
Qed.
