(* SPDX-License-Identifier: BSD-3-Clause *)
(* The face of two polygons and the gap beside it, as the second stage computes them in double-double: side_gap() of
   fast/laws/polygon_gap.h. The gap may cancel, however far. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Mult_error.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage SecondAlong ShadingRoot.
Open Scope R_scope.

(* ---- The face ---- *)

Lemma half_width_coordinate : forall R w K, parameters R w K -> coordinate (half_width w) (value32 w / 2).
Proof.
  intros R w K Hp. pose proof (half_width_is _ _ _ Hp) as I. destruct Hp as (_ & HR & Hw & _). split.
  - exact I.
  - replace (value32 w / 2) with (value32 w * bpow radix2 (-1)) by (change (bpow radix2 (-1)) with (/ 2); field).
    apply mult_bpow_exact_FLT; [apply (generic_format_B2R 24 128)|].
    assert (-10 < mag radix2 (value32 w))%Z; [|lia]. apply mag_gt_bpow. rewrite Rabs_pos_eq by lra. simpl. lra.
  - rewrite Rabs_pos_eq; lra.
  - right. apply size_of; simpl; lra.
Qed.

Lemma depth_enclosed : forall R w K, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in
  encloses (66 * share101) (computed_depth R w) d /\ (d = 0 \/ / 1000000 <= d <= 10000).
Proof.
  intros R w K Hp d. pose proof (half_width_coordinate _ _ _ Hp) as Hc. pose proof Hp as (_ & HR & Hw & _).
  pose proof (shading_root_enclosed R w K _ _ Hp Hc ltac:(rewrite Rabs_pos_eq; lra)) as E. cbv zeta in E.
  replace ((value32 R - value32 w / 2) * (value32 R + value32 w / 2)) with (Rsqr (value32 R) - Rsqr (value32 w / 2)) in E
    by (unfold Rsqr; ring). exact E.
Qed.

(* The slope, the sine and the cosine of the face. *)
Lemma face_enclosed : forall R w K, parameters R w K -> let slope := slope_2p (value32 R) (value32 w) in
  (encloses (606 * share101) (tangent_2p R w) slope /\ / 40000000 <= slope <= 1) /\
  (encloses (17000 * share101) (face_sine_2p R w) (sine_of slope) /\ / 40000000 <= sine_of slope <= 1) /\
  (encloses (1850 * share101) (face_cosine_2p R w) (cosine_of slope) /\ 7 / 10 <= cosine_of slope <= 1).
Proof.
  intros R w K Hp slope. pose proof share_is_small as Hsh. destruct (depth_enclosed _ _ _ Hp) as [Ed Bd].
  pose proof (encloses_exact _ _ (exactly_is _ _ (half_width_is _ _ _ Hp))) as Ec.
  destruct Hp as ((FR & _) & HR & Hw & _). pose proof (exactly_is _ _ (to64_is_exact R FR)) as IR. pose proof (encloses_exact _ _ IR) as ER.
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & HcS & ET & _ & EC & ES). fold slope in ET, EC, ES.
  set (d := axis_depth (value32 R) (value32 w)) in *. set (Rad := value32 R) in *. set (c := value32 w / 2) in *. set (S := Rad + d) in *.
  assert (Hc : / 2000 <= c <= Rad) by (unfold c; lra).
  assert (Esum : encloses (201 * share101) (sum_2p R w) S).
  { apply encloses_more with (3 * (0 + 66 * share101) + 3 * share101); [|lra]. apply encloses_add; trivial; lra. }
  assert (Ediam : encloses (3 * share101) (diameter R) (2 * Rad)).
  { replace (2 * Rad) with (Rad + Rad) by ring. apply encloses_sum; trivial; try (rewrite Rabs_pos_eq; lra); try (right; lra). }
  assert (BT : / 40000000 <= c / S <= 1).
  { split; apply Rmult_le_reg_r with S; try lra; replace (c / S * S) with c by (field; lra); lra. }
  assert (Etan : encloses (606 * share101) (tangent_2p R w) (c / S)).
  { apply encloses_more with (3 * (0 + 201 * share101) + 3 * share101); [|lra].
    apply encloses_divide; trivial; try lra; try (rewrite Rabs_pos_eq; lra). }
  assert (BQ : / 2 <= S / (2 * Rad) <= 1).
  { split; apply Rmult_le_reg_r with (2 * Rad); try lra; replace (S / (2 * Rad) * (2 * Rad)) with S by (field; lra); lra. }
  assert (Ecos : encloses (1850 * share101) (face_cosine_2p R w) (sqrt (S / (2 * Rad)))).
  { apply encloses_more with (3 * (3 * (201 * share101 + 3 * share101) + 3 * share101) + 3 * share101); [|lra].
    apply encloses_root; [|lra|right; lra].
    apply encloses_divide; trivial; try lra; try (rewrite Rabs_pos_eq; lra). }
  assert (BC : 7 / 10 <= sqrt (S / (2 * Rad)) <= 1).
  { split; [|rewrite <- sqrt_1; apply sqrt_le_1_alt; lra].
    replace (7 / 10) with (sqrt (7 / 10 * (7 / 10))) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra. }
  rewrite <- EC in Ecos, BC. rewrite <- EC in ES. set (cosine := cosine_of slope) in *.
  assert (BD : 7 / 10 * (2 * Rad) <= 2 * Rad * cosine <= 2 * Rad).
  { split; [rewrite (Rmult_comm (2 * Rad)); apply Rmult_le_compat_r; lra|]. rewrite <- (Rmult_1_r (2 * Rad)) at 2.
    apply Rmult_le_compat_l; lra. }
  assert (BS : / 40000000 <= c / (2 * Rad * cosine) <= 1).
  { split; apply Rmult_le_reg_r with (2 * Rad * cosine); try lra; replace (c / (2 * Rad * cosine) * (2 * Rad * cosine)) with c by (field;
    lra); lra. }
  assert (Esin : encloses (17000 * share101) (face_sine_2p R w) (c / (2 * Rad * cosine))).
  { apply encloses_more with (3 * (0 + (3 * (3 * share101 + 1850 * share101) + 3 * share101)) + 3 * share101); [|lra].
    apply encloses_divide; trivial; try lra; try (rewrite Rabs_pos_eq; lra).
    apply encloses_multiply; trivial; try lra. right. right. rewrite Rabs_pos_eq; lra. }
  rewrite <- ET in Etan, BT. rewrite <- ES in Esin, BS. repeat split; try assumption; lra.
Qed.

(* ---- The gap ---- *)

(* A gap that is enclosed. It is 0, or it is not tiny, or the bound of its error is not. *)
Definition settled (gap : double_double) (M : R) : Prop :=
  contains gap M /\ Rabs (value64 (hi gap)) <= 22400 /\ value64 (error gap) <= 1000 /\
  (is_exactly gap 0 \/ / 100000000000000000000000000000 <= Rabs (value64 (hi gap)) \/
   / 1000000000000000000000000000000000000000000 <= value64 (error gap)).

(* So where it is found positive, it is not so small that products of it are lost. *)
Lemma settled_positive : forall gap M, settled gap M -> sign_of gap = is_positive ->
  / 1000000000000000000000000000000000000000000000000 <= value64 (hi gap).
Proof.
  intros gap M (C & _ & _ & D) Pos. destruct (positive_is _ _ C Pos) as (g & m & f & G & M' & F & Bm & Hf & Dm & _).
    pose proof (Rabs_pos m).
  rewrite (proj1 G), (proj1 F) in D. rewrite (proj1 G). destruct D as [([Z _] & _)|D].
  - rewrite (proj1 G) in Z. lra.
  - rewrite (Rabs_pos_eq g) in D by lra. lra.
Qed.

Lemma settled_is_directed : forall gap M n N v, settled gap M -> sign_of gap = is_positive -> encloses v n N -> 0 <= v <= / 1000 ->
  N = 0 \/ / 40000000 <= Rabs N <= 1 -> directed gap n.
Proof.
  intros gap M n N v Sg Pos E Hv BN. pose proof (settled_positive gap M Sg Pos) as Pg. destruct Sg as (_ & Bg & _).
  pose proof (first_size _ _ _ E Hv) as Sn. rewrite (Rabs_pos_eq (value64 (hi gap))) in Bg by lra. unfold directed. cbv zeta. split; [lra|].
  destruct BN as [->|BN]; [left; rewrite Rabs_R0 in Sn; pose proof (Rabs_pos (value64 (hi n))); lra|right]. split; [lra|].
  apply Rle_trans with (22400 * (101 / 100)); [apply Rmult_le_compat; lra|lra].
Qed.

(* The terms that cancel are charged. *)
Lemma difference_is_settled : forall s a A b Z, let gap := add a (negated b) in encloses s a A -> 0 <= s <= / 1000 -> charged a ->
  is_exactly b Z -> A = 0 \/ / 1000000000000000000000000000 <= A <= 20000 -> Z = 0 \/ / 10000000000 <= Rabs Z <= 10000 ->
  A + Rabs Z <= 20000 -> settled gap (A - Z).
Proof.
  intros s a A b Z gap Ea Hs Ca Ib BA BZ BAZ. pose proof unit_is_small as Hu.
  assert (C : contains gap (A - Z)).
  { apply (difference_of_two_contains s 0); trivial; [now apply encloses_exact|lra| |].
    - destruct BA as [BA|BA]; [now left|right; rewrite Rabs_pos_eq; lra].
    - destruct BZ as [BZ|BZ]; [now left|right; lra]. }
  assert (Zero : A = 0 -> is_exactly a 0) by (intro A0; rewrite A0 in Ea; now apply (enclosed_zero s)).
  destruct Ea as (h & l & e & H & L & E & Bl & Be & B), Ib as (H' & L' & E').
  pose proof (enclosed_size _ _ _ _ _ Bl Be B Hs) as Sh. assert (A0 : 0 <= A) by lra. rewrite (Rabs_pos_eq A) in Sh by exact A0.
  assert (BZ2 : 0 <= Rabs Z <= 10000) by (split; [apply Rabs_pos|destruct BZ as [->|BZ]; [rewrite Rabs_R0|]; lra]).
  pose proof (unit_times _ (Rabs_pos h)) as Uh. assert (A2 : A <= 20000) by lra.
  assert (sh : s * Rabs h <= / 1000 * Rabs h) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (First : Rabs (value64 (hi gap)) <= 112 / 100 * (A + Rabs Z)).
  { assert (N0 : Rabs l + Rabs (- 0) <= unit53 * Rabs h) by (rewrite Ropp_0, Rabs_R0; lra). pose proof (Rabs_triang h (- Z)) as T.
    rewrite Rabs_Ropp in T.
    destruct (sum_of_is_off _ _ _ _ h l (- Z) (- 0) (Rabs h + Rabs Z) (unit53 * Rabs h) H L (opp_is _ _ H') (opp_is _ _ L') ltac:(lra)
      ltac:(rewrite Rabs_Ropp; lra) T N0 ltac:(lra)) as (p & q & P & _ & _ & Bp & _).
    change (hi gap) with (fst (sum_of (hi a) (lo a) (opp (hi b)) (opp (lo b)))). rewrite (proj1 P). lra. }
  pose proof C as (g & m & f & G & M & F & Bm & Hf & D & Bg). rewrite (proj1 G) in First.
  destruct (error_of_two (hi gap) g (error a) (error (negated b)) e 0 G ltac:(lra) E E' ltac:(lra) ltac:(lra)) as (f' & F' & Bf).
  change (error_of (hi gap) (plus (error a) (error (negated b)))) with (error gap) in F'. rewrite (is64_same _ _ _ F' F) in Bf.
  unfold charged in Ca. rewrite (proj1 H), (proj1 E) in Ca.
  split; [exact C|]. rewrite (proj1 G), (proj1 F). split; [lra|].
  assert (Ie : is64 (plus (error a) (error (negated b))) e).
  { apply (plus_exact _ _ e 0); trivial; [ring|exact (format_of _ _ E)|apply big_enough; rewrite Rabs_pos_eq; lra]. }
  destruct (error_of_is _ g _ e e G Ie ltac:(lra) ltac:(lra) ltac:(lra)) as (f2 & F2 & Bf2 & Zf).
  change (error_of (hi gap) (plus (error a) (error (negated b)))) with (error gap) in F2. rewrite (is64_same _ _ _ F2 F) in *.
  pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  assert (Bsg : share101 * Rabs g <= / 1000 * Rabs g) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]). split; [lra|].
  pose proof (unit_times _ (Rabs_pos g)) as Ug. pose proof (size_by (A - Z) (g + m)) as S. rewrite (Rabs_minus_sym (A - Z)) in S.
  pose proof (Rabs_triang g m) as T.
  destruct (Rle_lt_dec (/ 1000000000000000000000000000000000000000000) f) as [Lf|Lf]; [now right; right|].
  destruct BA as [BA|BA].
  - destruct (Zero BA) as (H0 & L0 & E0). pose proof (opp_is _ _ L') as L1. rewrite Ropp_0 in L1. pose proof (opp_is _ _ H') as H1.
    assert (S0 : 0 + - Z = - Z) by ring. assert (BS : Rabs (- Z) <= bpow radix2 1000) by (apply big_enough; rewrite Rabs_Ropp; lra).
    destruct (sum_of_exact _ _ _ _ 0 (- Z) H0 L0 H1 L1 ltac:(rewrite S0; exact (format_of _ _ H1)) zero_is_not_too_large BS
      ltac:(rewrite S0; exact BS)) as [P Q].
    rewrite S0 in P. pose proof (is64_same _ _ _ P G) as Eg. destruct BZ as [BZ|BZ].
    + left. rewrite BZ, Ropp_0 in P. split; [exact P|split; [exact Q|]]. replace 0 with f; [exact F|].
      apply Zf; [|rewrite <- Eg, BZ; ring]. rewrite (is64_same _ _ _ E E0). reflexivity.
    + right. left. rewrite <- Eg, Rabs_Ropp. lra.
  - right. left. unfold share101 in Ca. assert (Far : / 10000000000000000000000000000 <= Rabs (A - Z)); [|lra].
    destruct (Rle_lt_dec Z (A / 2)) as [HZ|HZ]; [rewrite Rabs_pos_eq; lra|]. destruct BZ as [->|BZ]; [lra|].
    rewrite (Rabs_pos_eq Z) in BZ by lra. rewrite Rabs_left; lra.
Qed.

(* side_gap(face, w, |x|, z) *)
Definition side_gap (tangent : double_double) (w x z : binary32) : double_double :=
  add (multiply tangent (add (exactly64 (half_width w)) (negated (exactly64 (to64 (b32_abs x)))))) (negated (exactly64 (to64 z))).
Definition side_gap_2p (R w x z : binary32) : double_double := side_gap (tangent_2p R w) w x z.

(* T: the slope of the side; its height at x is no more than 10 m. *)
Lemma side_gap_is_settled : forall R w K s T tangent x X z Z, parameters R w K -> encloses s tangent T -> 0 <= s <= / 1000000 ->
  / 40000000 <= T <= 2 -> is_finite 24 128 x = true -> value32 x = X -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  Rabs X <= value32 w / 2 -> T * (value32 w / 2 - Rabs X) <= 10000 ->
  settled (side_gap tangent w x z) (T * (value32 w / 2 - Rabs X) - Z).
Proof.
  intros R w K s T tangent x X z Z Hp Et Hs BT Fx Vx Cx Cz Hin High. pose proof share_is_small as Hsh.
  pose proof (half_width_coordinate _ _ _ Hp) as Cc. destruct Hp as (_ & HR & Hw & _).
  assert (Ix : is64 (to64 (b32_abs x)) (Rabs X)).
  { assert (Fa : is_finite 24 128 (b32_abs x) = true) by (unfold b32_abs; now rewrite is_finite_Babs).
    destruct (to64_is_exact _ Fa) as [V F].
    split; [|exact F]. rewrite V, <- Vx. apply B2R_Babs. }
  pose proof (Rabs_pos X) as PX. set (c := value32 w / 2) in *. assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra).
  change (c - Rabs X) with (c + - Rabs X) in *. set (u := c + - Rabs X) in *.
  assert (Bu : u = 0 \/ / 10000000000000000 <= u <= 10000).
  { destruct (Req_dec u 0) as [|Hne]; [now left|right]. split; [|unfold u; lra].
    apply Rle_trans with (bpow radix2 (-53)); [simpl; lra|]. rewrite <- (Rabs_pos_eq u) by (unfold u; lra).
    apply difference_is_not_tiny; [exact (coordinate_format _ _ Cc)|apply generic_format_abs;
      exact (coordinate_format _ _ Cx)| | |exact Hne].
    - right. rewrite Rabs_pos_eq by lra. simpl. lra.
    - rewrite Rabs_Rabsolu. destruct (coordinate_not_tiny _ _ Cx) as [->|L]; [left; apply Rabs_R0|now right]. }
  pose proof (encloses_sum _ _ _ _ (exactly_is _ _ (coordinate_is _ _ Cc)) (negated_is _ _ (exactly_is _ _ Ix))
    ltac:(rewrite Rabs_pos_eq; lra)
    ltac:(rewrite Rabs_Ropp, Rabs_pos_eq; lra) ltac:(fold u; destruct Bu; [now left|right; lra])) as Eu. fold u in Eu.
  pose proof (first_size _ _ _ Et ltac:(lra)) as St. rewrite (Rabs_pos_eq T) in St by lra.
    pose proof (first_size _ _ _ Eu ltac:(lra)) as Su.
  rewrite (Rabs_pos_eq u) in Su by (destruct Bu; lra).
  assert (H2 : s * (3 * share101) <= / 1000 * (s + 3 * share101)).
  { apply Rle_trans with (s * / 1000); [apply Rmult_le_compat_l; lra|lra]. }
  destruct (multiply_encloses _ _ _ _ _ _ Et Eu ltac:(lra) ltac:(lra) H2) as (Ea & Ca & _).
  { set (v := Rabs (value64 (hi tangent))) in *. set (y := Rabs (value64 (hi (add _ _)))) in *.
    destruct Bu as [Bu|Bu]; [left; rewrite Bu in Su; replace y with 0 by lra; ring|right]. split.
    - apply Rle_trans with (/ 100000000 * (/ 2 * / 10000000000000000)); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (3 * 20000); [apply Rmult_le_compat; lra|lra]. }
  assert (BTu : T * u = 0 \/ / 1000000000000000000000000000 <= T * u <= 10000).
  { destruct Bu as [->|Bu]; [left; ring|right]. split; [|exact High].
    apply Rle_trans with (/ 40000000 * / 10000000000000000); [lra|apply Rmult_le_compat; lra]. }
  pose proof (coordinate_range _ _ Cz) as RZ.
  assert (BZ : Z = 0 \/ / 10000000000 <= Rabs Z <= 10000).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  apply (difference_is_settled _ _ _ _ _ Ea ltac:(lra) Ca (exactly_is _ _ (coordinate_is _ _ Cz)) ltac:(lra) BZ). lra.
Qed.

Lemma side_gap_is : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X -> coordinate (to64 x) X ->
  coordinate (to64 z) Z -> Rabs X <= value32 w / 2 -> settled (side_gap_2p R w x z) (penetration_2p (value32 R) (value32 w) X Z).
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz Hin. pose proof share_is_small as Hsh. destruct (face_enclosed _ _ _ Hp) as ([Et BT] & _).
  pose proof Hp as (_ & HR & Hw & _). pose proof (Rabs_pos X) as PX.
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & _ & ET & EH & _).
  set (T := slope_2p (value32 R) (value32 w)) in *.
  replace (penetration_2p (value32 R) (value32 w) X Z) with (T * (value32 w / 2 - Rabs X) - Z).
  - apply (side_gap_is_settled R w K (606 * share101)); trivial; try lra.
    apply Rle_trans with (1 * 10000); [apply Rmult_le_compat; lra|lra].
  - unfold penetration_2p. rewrite Rle_bool_true by exact Hin. rewrite EH, <- ET. field. lra.
Qed.

(* On a face, of which sine and cosine are enclosed. *)
Lemma on_face_is_right : forall R w K gap M slope s sine c cosine is_left answer, parameters R w K -> settled gap M ->
  encloses s sine (sine_of slope) -> 0 <= s <= / 1000 -> / 40000000 <= sine_of slope <= 1 ->
  encloses c cosine (cosine_of slope) -> 0 <= c <= / 1000 -> / 40000000 <= cosine_of slope <= 1 ->
  decide_along K gap (if is_left : bool then negated sine else sine) cosine = Some answer ->
  is_answer answer (0 < M) (value32 K * M * (if is_left then - sine_of slope else sine_of slope)) (value32 K * M * cosine_of slope).
Proof.
  intros R w K gap M slope s sine c cosine is_left answer Hp Sg Es Hs Bs Ec Hc Bc H.
  assert (En : encloses s (if is_left then negated sine else sine) (if is_left then - sine_of slope else sine_of slope))
    by (destruct is_left; [now apply encloses_negated|exact Es]).
  refine (along_is_right R w K gap M _ _ _ _ _ _ _ answer Hp (proj1 Sg) (iff_refl _) En Hs Ec Hc _ H). intros Pos _.
  split; [apply (settled_is_directed gap M _ _ s Sg Pos En Hs)|apply (settled_is_directed gap M _ _ c Sg Pos Ec Hc)]; right.
  - destruct is_left; rewrite ?Rabs_Ropp, Rabs_pos_eq; lra.
  - rewrite Rabs_pos_eq; lra.
Qed.
