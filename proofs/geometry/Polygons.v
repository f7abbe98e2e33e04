(* SPDX-License-Identifier: BSD-3-Clause *)
(* The first stages of the bumps of two and three polygons, shaded and not, given their constants. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded Gap.
Open Scope R_scope.

(* ---- The penetration ---- *)

Definition penetration_value (is_fused inside : bool) (height height_tail slope slope_tail ax z : binary64) : binary64 :=
  larger (if inside then gap_value is_fused height height_tail slope slope_tail ax z else opp z) zero64.

(* Where it is clear, its sign is right, and it is 7/2 units off at most. *)
Lemma penetration : forall is_fused inside height height_tail slope slope_tail H S axv AX zv Z,
  linear height height_tail slope slope_tail H S -> is64 axv AX -> in_binary32 AX -> 0 <= AX <= 10000 ->
  (inside = true -> S * AX <= H) -> coordinate zv Z ->
  let value := penetration_value is_fused inside height height_tail slope slope_tail axv zv in
  let unclear := is_less (absolute (gap_value is_fused height height_tail slope slope_tail axv zv)) (times (two_to (-27)) height) in
  let M := if inside then H - S * AX - Z else - Z in
  inside && unclear = false ->
  (is_less zero64 value = true <-> 0 < M) /\ (0 < M -> computes value (7 / 2) M (-66) 15).
Proof.
  intros is_fused inside height height_tail slope slope_tail H S axv AX zv Z L Hax Fax RAX HS Hz value unclear M Hclear.
  assert (K : exists v, is64 (if inside then gap_value is_fused height height_tail slope slope_tail axv zv else opp zv) v /\
                near (7 / 2) v M /\ (0 < M -> size (-66) 15 M)).
  { unfold M. destruct inside; cbn [andb] in Hclear.
    - destruct (gap_is_near is_fused _ _ _ _ axv AX zv Z H S L Hax Fax RAX (HS eq_refl) Hz) as (v & Hv & Hnear).
      destruct L as [(Fh & _) _ Rh Rht Rhe Rs Rst Rse].
      assert (Ih : is64 height (value64 height)) by now split.
      pose proof (two_to_is (-27) ltac:(lia)) as I2. change (bpow radix2 (-27)) with (/ 134217728) in I2.
      assert (It : is64 (times (two_to (-27)) height) (nearest64 (/ 134217728 * value64 height))).
      { apply times_is; try assumption. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14);
        [simpl; lra|apply bpow_le; lia]. }
      unfold unclear in Hclear. rewrite (less_is _ _ _ _ (absolute_is _ _ Hv) It) in Hclear.
      assert (Hlarge : nearest64 (/ 134217728 * value64 height) <= Rabs v).
      { revert Hclear. case Rlt_bool_spec; [discriminate|trivial]. }
      pose proof (product_is_close (/ 134217728 * value64 height)) as C. rewrite (Rabs_pos_eq (/ 134217728 * _)) in C by lra.
      pose proof tiny_is_tiny as Ht. apply Rabs_le_inv in C.
      assert (Hlarge2 : / 134217729 * value64 height <= Rabs v) by (unfold unit53 in *; lra).
      destruct (Hnear Hlarge2) as [N B]. exists v. split; [assumption|]. split; [assumption|]. intro HM.
      rewrite (Rabs_pos_eq (H - S * AX - Z)) in B by lra.
      assert (HS0 : 0 <= S).
      { apply Rabs_le_inv in Rst. apply Rabs_le_inv in Rse. unfold tail_share, slope_share in *. lra. }
      assert (0 <= S * AX) by (apply Rmult_le_pos; lra).
      pose proof (coordinate_range _ _ Hz) as Rz. apply Rabs_le_inv in Rz. apply Rabs_le_inv in Rht. apply Rabs_le_inv in Rhe.
      apply size_of; simpl; unfold unit53, height_share in *; lra.
    - exists (- Z). destruct Hz as [Hz _ Rz Sz]. split; [now apply opp_is|]. split.
      + apply near_more with 0; [apply near_exactly|lra].
      + intro HM. destruct Sz as [->|Sz]; [lra|]. apply size_more with (-30)%Z 14%Z; [|lia|lia]. unfold size in *. now rewrite Rabs_Ropp. }
  destruct K as (v & Hv & Hnear & Hsize). pose proof (larger_is _ _ _ _ Hv zero_is) as Hl.
  destruct (near_sign _ _ _ Hnear) as (S1 & S2 & S3). split.
  - unfold value, penetration_value. rewrite (less_is _ _ _ _ zero_is Hl). unfold Rmax. destruct (Rle_dec v 0).
    + rewrite Rlt_bool_false by lra. split; [discriminate|]. intro HM. specialize (S1 HM). lra.
    + rewrite Rlt_bool_true by lra. split; [intros _|reflexivity]. destruct (Rtotal_order M 0) as [C|[C|C]];
      [specialize (S2 C)|specialize (S3 C)|]; lra.
  - intro HM. exists v. split; [|split; [assumption|now apply Hsize]]. rewrite Rmax_left in Hl; [assumption|]. specialize (S1 HM). lra.
Qed.

(* ---- Without shading ---- *)

(* K_sine and K_cosine of the headers: within a unit and a little of K times the sine or cosine. *)
Definition factor (v : binary64) (exact : R) : Prop :=
  is_finite 53 1024 v = true /\ Rabs (value64 v - exact) <= unit53 * (1 + / 1000000) * Rabs exact /\ size (-50) 10 exact.

Lemma factor_computes : forall v exact, factor v exact -> computes v (101 / 100) exact (-50) 10.
Proof.
  intros v exact (Fv & Hv & Hs). exists (value64 v). split; [now split|]. split; [|assumption].
  apply near_more with (unit53 * (1 + / 1000000) * (1 + / 1000) / unit53); [|unfold unit53; lra].
  apply close_is_near; [assumption|unfold unit53; lra].
Qed.

Lemma unshaded_force : forall value M v exact n, computes value (7 / 2) M (-66) 15 -> computes v n exact (-50) 10 -> 0 <= n <= 2 ->
  good 8 (times value v) (M * exact).
Proof.
  intros value M v exact n Hvalue Hv Hn. assert (H1 : 1 <= one <= 1001 / 1000) by (unfold one; lra).
  pose proof (computes_times _ _ _ _ _ _ _ _ _ _ Hvalue Hv ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
  apply (computed_is_good 8 _ _ _ _ _ C); try lra; lia.
Qed.

Lemma stiffness_computes : forall R w K, parameters R w K -> computes (to64 K) 0 (value32 K) (-50) 10.
Proof.
  intros R w K ((_ & _ & FK) & _ & _ & HK). apply exactly; [now apply to64_is_exact|].
  apply size_more with (-10)%Z 10%Z; [now apply size_of_stiffness|lia|lia].
Qed.

Lemma no_force_aside : forall value M v, computes value (7 / 2) M (-66) 15 -> is64 v 0 -> good 8 (times value v) (M * 0).
Proof.
  intros value M v (m & Hm & _) Hv. rewrite Rmult_0_r. apply zero_is_good.
  replace 0 with (nearest64 (m * 0)) by (rewrite Rmult_0_r; apply round_0; auto with typeclass_instances).
  apply times_is; try assumption. rewrite Rmult_0_r, Rabs_R0. apply bpow_ge_0.
Qed.

(* ---- Two polygons ---- *)

Record constants_2p (R w K : binary32) (height height_tail slope slope_tail K_sine K_cosine : binary64) : Prop := {
  linear_2p : linear height height_tail slope slope_tail (bump_height (value32 R) (value32 w)) (slope_2p (value32 R) (value32 w));
  sine_2p : factor K_sine (value32 K * sine_of (slope_2p (value32 R) (value32 w)));
  cosine_2p : factor K_cosine (value32 K * cosine_of (slope_2p (value32 R) (value32 w)))
}.

Lemma absolute_coordinate : forall xv X, coordinate xv X -> is64 (absolute xv) (Rabs X) /\ in_binary32 (Rabs X) /\ 0 <= Rabs X <= 10000.
Proof.
  intros xv X [Hx Fx Rx _]. split; [now apply absolute_is|]. split; [now apply generic_format_abs|]. split; [apply Rabs_pos|assumption].
Qed.

Lemma linear_is_positive : forall height height_tail slope slope_tail H S, linear height height_tail slope slope_tail H S -> 0 < H.
Proof.
  intros height height_tail slope slope_tail H S [_ _ Rh Rht Rhe _ _ _]. apply Rabs_le_inv in Rht. apply Rabs_le_inv in Rhe.
  unfold unit53, height_share in *. lra.
Qed.

(* The penetration of two polygons, in the words of docs/laws.md. *)
Lemma penetration_2p_is : forall Rad w X Z, 0 < w -> 0 < bump_height Rad w ->
  let inside := Rle_bool (Rabs X) (w / 2) in
  (if inside then bump_height Rad w - slope_2p Rad w * Rabs X - Z else - Z) = penetration_2p Rad w X Z /\
  (inside = true -> slope_2p Rad w * Rabs X <= bump_height Rad w).
Proof.
  intros Rad w X Z Hw Hh inside. unfold penetration_2p, inside, slope_2p. case Rle_bool_spec; intro H; (split; [|]); try discriminate.
  - field. lra.
  - intros _. replace (2 * bump_height Rad w / w * Rabs X) with (bump_height Rad w * (2 * Rabs X / w)) by (field; lra).
    rewrite <- (Rmult_1_r (bump_height Rad w)) at 2. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_reg_r with w; [assumption|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - reflexivity.
Qed.

Lemma bump_2p_is_right : forall is_fused R w K height height_tail slope slope_tail K_sine K_cosine xv X zv Z,
  parameters R w K -> constants_2p R w K height height_tail slope slope_tail K_sine K_cosine -> coordinate xv X -> coordinate zv Z ->
  let M := penetration_2p (value32 R) (value32 w) X Z in
  let S := slope_2p (value32 R) (value32 w) in
  is_right 8 (bump_2p is_fused height height_tail slope slope_tail (to64 K) K_sine K_cosine (half_width w) xv zv) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K height height_tail slope slope_tail K_sine K_cosine xv X zv Z Hp [L Hs Hc] Hx Hz M S.
  unfold is_right, bump_2p. cbv zeta. cbn [first_x first_z first_contact first_doubt]. intro Hclear.
  destruct (shaded_coordinate _ _ _ _ _ Hp Hx) as (Hi & _ & _). cbv zeta in Hi.
  rewrite Hi in Hclear |- *. destruct (absolute_coordinate _ _ Hx) as (Ia & Fa & Ra). pose proof (linear_is_positive _ _ _ _ _ _ L) as HH.
  destruct (penetration_2p_is (value32 R) (value32 w) X Z ltac:(destruct Hp as (_ & _ & Hw & _); lra) HH) as [EM HS].
  fold S in EM, HS, L. fold M in EM.
  pose proof (penetration is_fused (Rle_bool (Rabs X) (value32 w / 2)) _ _ _ _ _ _ _ _ zv Z L Ia Fa Ra HS Hz Hclear) as P.
  cbv zeta in P. rewrite EM in P. destruct P as [P1 P2]. split; [exact P1|]. intro HM. specialize (P2 HM).
  unfold side_x, side_z. rewrite (less_is _ _ _ _ (coordinate_is _ _ Hx) zero_is). fold S in Hs, Hc.
  destruct (Rle_bool (Rabs X) (value32 w / 2)); split.
  - replace (value32 K * M * (if Rlt_bool X 0 then - sine_of S else sine_of S)) with
      (M * (if Rlt_bool X 0 then - (value32 K * sine_of S) else value32 K * sine_of S)) by (destruct (Rlt_bool X 0); ring).
    apply unshaded_force with (101 / 100); [exact P2| |lra]. apply factor_computes in Hs. destruct (Rlt_bool X 0); [|assumption].
    destruct Hs as (s & H1 & H2 & H3). exists (- s). split; [now apply opp_is|]. split; [now apply near_opp|].
    unfold size in *. now rewrite Rabs_Ropp.
  - replace (value32 K * M * cosine_of S) with (M * (value32 K * cosine_of S)) by ring.
    apply unshaded_force with (101 / 100); [exact P2|now apply factor_computes|lra].
  - replace 0 with (M * 0) by ring. apply no_force_aside; [exact P2|apply zero_is].
  - replace (value32 K * M * 1) with (M * value32 K) by ring.
    apply unshaded_force with 0; [exact P2|now apply stiffness_computes with R w|lra].
Qed.

(* Every answer of the first stage of bump-2p is right, for every input of the domain, given its constants. *)
Theorem bump_2p_first_stage_answers_right : forall is_fused R w K height height_tail slope slope_tail K_sine K_cosine later x y z,
  parameters R w K -> constants_2p R w K height height_tail slope slope_tail K_sine K_cosine -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in
  let S := slope_2p (value32 R) (value32 w) in
  right_or_later
    (evaluate bump_2p_window (bump_2p is_fused height height_tail slope slope_tail (to64 K) K_sine K_cosine (half_width w)) later x y z)
    (later (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K height height_tail slope slope_tail K_sine K_cosine later x y z Hp Hc Hv X Z M S.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz].
  apply (right_first_stage_gives_right_answers 8); [lia|assumption|]. now apply bump_2p_is_right.
Qed.

(* The same of bump-2p-shaded. *)
Theorem bump_2p_shaded_first_stage_answers_right : forall is_fused R w K height height_tail slope slope_tail later x y z,
  parameters R w K ->
  linear height height_tail slope slope_tail (bump_height (value32 R) (value32 w)) (slope_2p (value32 R) (value32 w)) ->
  valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in
  right_or_later
    (evaluate bump_2p_shaded_window
       (bump_2p_shaded is_fused height height_tail slope slope_tail (to64 R) (K_over_R K R) (half_width w)) later x y z)
    (later (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K height height_tail slope slope_tail later x y z Hp L Hv X Z M.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz]. fold X in Hx. fold Z in Hz.
  apply (right_first_stage_gives_right_answers 12); [lia|assumption|].
  unfold is_right, bump_2p_shaded. cbv zeta. cbn [first_x first_z first_contact first_doubt]. intro Hclear.
  destruct (shaded_coordinate _ _ _ _ _ Hp Hx) as (Hi & Hs & HS). cbv zeta in Hi, Hs, HS.
  destruct (absolute_coordinate _ _ Hx) as (Ia & Fa & Ra). pose proof (linear_is_positive _ _ _ _ _ _ L) as HH.
  destruct (penetration_2p_is (value32 R) (value32 w) X Z ltac:(destruct Hp as (_ & _ & Hw & _); lra) HH) as [EM HS2].
  fold M in EM. rewrite Hi in Hs, Hclear |- *.
  pose proof (penetration is_fused (Rle_bool (Rabs X) (value32 w / 2)) _ _ _ _ _ _ _ _ _ Z L Ia Fa Ra HS2 Hz Hclear) as P.
  cbv zeta in P. rewrite EM in P. destruct P as [P1 P2]. split; [exact P1|]. intro HM. specialize (P2 HM).
  pose proof Hp as (_ & HR & Hw & _).
  destruct (shaded_force_is (value32 R) (value32 w) (value32 K) X M ltac:(lra) ltac:(lra)) as [<- <-].
  refine (shaded_force 12 R w K _ _ _ (7 / 2) M Hp Hs HS P2 ltac:(lra) _). unfold one. lra.
Qed.
