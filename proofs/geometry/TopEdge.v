(* SPDX-License-Identifier: BSD-3-Clause *)
(* largest_on_top of fast/laws/top_edge.h ends with the largest binary32 that is not above w'/2. *)
From Coq Require Import ZArith Reals List Lia Lra Bool.
From Flocq Require Import Core Plus_error Mult_error BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds ThreePolygons ThreePolygonsFace ThreePolygonsConstants.
From Forceshade Require Import NewtonRounded ExactSign.
Import ListNotations.
Open Scope R_scope.

Definition product_low (a b : binary64) : binary64 := fused a b (opp (times a b)).  (* two_product *)

Definition top_terms (c R w : binary32) : list binary64 :=
  let square := times (to64 c) (to64 c) in let radius := times (to64 R) (to64 R) in
  let cube := times square (to64 c) in let cube_low := product_low square (to64 c) in
  let scaled := times radius (to64 c) in let scaled_low := product_low radius (to64 c) in
  [times (whole 4) cube_low; times (whole 4) cube; times (whole (-2)) scaled_low; opp scaled_low;
   times (whole (-2)) scaled; opp scaled; product_low radius (half_width w); times radius (half_width w)].

(* is_on_top *)
Definition is_on_top32 (c R w : binary32) : bool :=
  is_at_most (times (whole 2) (to64 c)) (to64 R) && (0 <=? exact_sign (top_terms c R w))%Z.

(* std::nextafter(c, 0) and std::nextafter(c, infinity), of a c above 0. *)
Definition next_below (c : binary32) : binary32 := Bpred 24 128 eq_refl eq_refl c.
Definition next_above (c : binary32) : binary32 := Bsucc 24 128 eq_refl eq_refl c.

Definition step_down (R w c : binary32) : binary32 := if is_on_top32 c R w then c else next_below c.
Definition step_up (R w c : binary32) : binary32 := if is_on_top32 (next_above c) R w then next_above c else c.
Definition largest_on_top (R w : binary32) (half_top : double_double) : binary32 :=
  step_up R w (step_up R w (step_down R w (step_down R w (to32 (hi half_top))))).

(* ---- The test ---- *)

Lemma two_product_gives : forall a b x y, is64 a x -> is64 b y -> bpow radix2 (-900) <= Rabs (x * y) -> Rabs (x * y) <= bpow radix2 100 ->
  is64 (times a b) (nearest64 (x * y)) /\ is64 (product_low a b) (x * y - nearest64 (x * y)) /\
  Rabs (nearest64 (x * y)) <= bpow radix2 101 /\ Rabs (x * y - nearest64 (x * y)) <= bpow radix2 102.
Proof.
  intros a b x y Ha Hb Hlow Hhigh.
  assert (I1 : is64 (times a b) (nearest64 (x * y))).
  { apply times_is; try assumption. apply Rle_trans with (1 := Hhigh). apply bpow_le. lia. }
  pose proof (two_product_is_exact x y (format_of _ _ Ha) (format_of _ _ Hb)) as E. cbv zeta in E.
  set (p := nearest64 (x * y)) in *.
  assert (E2 : p + nearest64 (x * y - p) = x * y).
  { apply E. right. apply Rle_trans with (2 := Hlow). apply bpow_le. lia. }
  assert (Bp : Rabs p <= bpow radix2 100) by (apply bounded_rounding; [lia|exact Hhigh]).
  assert (Bl : Rabs (x * y - p) <= bpow radix2 101).
  { destruct (two_below 100 (x * y) p Hhigh Bp) as [_ B]. exact B. }
  split; [exact I1|]. split; [|split; [apply (below_more _ _ _ Bp); lia|apply (below_more _ _ _ Bl); lia]].
  unfold product_low. apply (fused_exact _ _ _ x y (- p)); try assumption.
  - now apply opp_is.
  - ring.
  - replace (x * y - p) with (nearest64 (x * y - p)) by lra. apply generic_format_round; auto with typeclass_instances.
  - apply (below_more _ _ _ Bl). lia.
Qed.

Lemma times_power_is : forall n k a x, (0 <= k <= 2)%Z -> IZR n = bpow radix2 k \/ IZR n = - bpow radix2 k ->
  (Z.abs n < 100)%Z -> is64 a x ->
  Rabs x <= bpow radix2 102 -> is64 (times (whole n) a) (IZR n * x) /\ Rabs (IZR n * x) <= bpow radix2 104.
Proof.
  intros n k a x Hk Hn Hn2 Ha Bx.
  assert (B : Rabs (IZR n * x) <= bpow radix2 104).
  { rewrite Rabs_mult. apply Rle_trans with (bpow radix2 k * bpow radix2 102).
    - apply Rmult_le_compat; try apply Rabs_pos; [|exact Bx].
      destruct Hn as [->| ->]; rewrite ?Rabs_Ropp, Rabs_pos_eq by apply bpow_ge_0; apply Rle_refl.
    - rewrite <- bpow_plus. apply bpow_le. lia. }
  split; [|exact B]. apply (times_exact _ _ _ _ _ (whole_is n ltac:(lia)) Ha); [reflexivity| |apply (below_more _ _ _ B); lia].
  destruct Hn as [-> | ->].
  - rewrite Rmult_comm. apply mult_bpow_pos_exact_FLT; [exact (format_of _ _ Ha)|lia].
  - replace (- bpow radix2 k * x) with (- (x * bpow radix2 k)) by ring. apply generic_format_opp.
    apply mult_bpow_pos_exact_FLT; [exact (format_of _ _ Ha)|lia].
Qed.

Theorem is_on_top32_is : forall R w K c, parameters R w K -> is_finite 24 128 c = true -> / 100000 <= value32 c <= 20000 ->
  is_on_top32 c R w = true <-> value32 c <= value32 R * third_sine (value32 R) (value32 w).
Proof.
  intros R w K c Hp Fc Bc. pose proof (half_width_is R w K Hp) as Ih. destruct Hp as ((FR & _) & HR & Hw & _).
  rewrite <- is_on_top_is_right by lra. unfold is_on_top, is_on_top32.
  pose proof (to64_is_exact c Fc) as Ic. pose proof (to64_is_exact R FR) as IR. set (x := value32 c) in *. set (r := value32 R) in *.
  set (h := value32 w / 2) in *. assert (Bh : / 2000 <= h <= 10000) by (unfold h; lra).
  assert (P100 : bpow radix2 100 = 1267650600228229401496703205376) by reflexivity.
  assert (Plow : forall a, / 1000000000000000000000 <= a -> bpow radix2 (-900) <= Rabs a).
  { intros a Ha. rewrite Rabs_pos_eq by lra. apply Rle_trans with (2 := Ha).
    apply Rle_trans with (bpow radix2 (-100)); [apply bpow_le; lia|].
    simpl. lra. }
  assert (Bxx : / 10000000000 <= x * x <= 400000000).
  { split; [apply Rle_trans with (/ 100000 * / 100000)|apply Rle_trans with (20000 * 20000)]; try lra; apply Rmult_le_compat; lra. }
  assert (Brr : / 100 <= r * r <= 100000000).
  { split; [apply Rle_trans with (/ 10 * / 10)|apply Rle_trans with (10000 * 10000)]; try lra; apply Rmult_le_compat; lra. }
  assert (B1 : / 1000000000000000 <= x * x * x <= 10000000000000).
  { split; [apply Rle_trans with (/ 10000000000 * / 100000)|apply Rle_trans with (400000000 * 20000)]; try lra;
    apply Rmult_le_compat; lra. }
  assert (B2 : / 10000000 <= r * r * x <= 2000000000000).
  { split; [apply Rle_trans with (/ 100 * / 100000)|apply Rle_trans with (100000000 * 20000)]; try lra; apply Rmult_le_compat; lra. }
  assert (B3 : / 200000 <= r * r * h <= 1000000000000).
  { split; [apply Rle_trans with (/ 100 * / 2000)|apply Rle_trans with (100000000 * 10000)]; try lra; apply Rmult_le_compat; lra. }
  assert (Isq : is64 (times (to64 c) (to64 c)) (x * x)).
  { apply (times_exact _ _ _ _ _ Ic Ic); [reflexivity|apply product_is_exact|]. apply big_enough. rewrite Rabs_pos_eq; lra. }
  assert (Irr : is64 (times (to64 R) (to64 R)) (r * r)).
  { apply (times_exact _ _ _ _ _ IR IR); [reflexivity|apply product_is_exact|]. apply big_enough. rewrite Rabs_pos_eq; lra. }
  destruct (two_product_gives _ _ _ _ Isq Ic ltac:(apply Plow; lra) ltac:(rewrite P100, Rabs_pos_eq; lra)) as (C1 & C2 & C3 & C4).
  destruct (two_product_gives _ _ _ _ Irr Ic ltac:(apply Plow; lra) ltac:(rewrite P100, Rabs_pos_eq; lra)) as (D1 & D2 & D3 & D4).
  destruct (two_product_gives _ _ _ _ Irr Ih ltac:(apply Plow; lra) ltac:(rewrite P100, Rabs_pos_eq; lra)) as (E1 & E2 & E3 & E4).
  set (p := nearest64 (x * x * x)) in *. set (q := nearest64 (r * r * x)) in *. set (s := nearest64 (r * r * h)) in *.
  assert (F4 : IZR 4 = bpow radix2 2) by reflexivity. assert (F2 : IZR (-2) = - bpow radix2 1) by reflexivity.
  assert (M : forall m y, (m <= 104)%Z -> Rabs y <= bpow radix2 m -> Rabs y <= bpow radix2 400) by (intros m y Hm Hy;
    apply (below_more _ _ _ Hy); lia).
  destruct (times_power_is 4 2 _ _ ltac:(lia) (or_introl F4) ltac:(lia) C2 C4) as [T1 M1].
  destruct (times_power_is 4 2 _ _ ltac:(lia) (or_introl F4) ltac:(lia) C1 (below_more 101 102 _ C3 ltac:(lia))) as [T2 M2].
  destruct (times_power_is (-2) 1 _ _ ltac:(lia) (or_intror F2) ltac:(lia) D2 D4) as [T3 M3].
  destruct (times_power_is (-2) 1 _ _ ltac:(lia) (or_intror F2) ltac:(lia) D1 (below_more 101 102 _ D3 ltac:(lia))) as [T5 M5].
  set (l := [IZR 4 * (x * x * x - p); IZR 4 * p; IZR (-2) * (r * r * x - q); - (r * r * x - q); IZR (-2) * q; - q; r * r * h - s; s]).
  assert (L : Forall2 is64 (top_terms c R w) l).
  { unfold top_terms, l. cbv zeta. repeat (constructor; [first [assumption | now apply opp_is]|]). constructor. }
  assert (Bl : Forall (fun y => Rabs y <= bpow radix2 400) l).
  { unfold l. repeat (constructor; [rewrite ?Rabs_Ropp; eapply M; [|eassumption]; lia|]). constructor. }
  assert (Es : sum l = 4 * (x * x * x) - 3 * (r * r * x) + r * r * h).
  { unfold l. simpl. ring. }
  rewrite (exact_sign_is _ _ L ltac:(simpl; lia) Bl), Es.
  assert (I2 : is64 (times (whole 2) (to64 c)) (2 * x)).
  { apply (times_power_is 2 1); [lia|now left|lia|exact Ic|]. apply Rle_trans with (bpow radix2 100);
    [rewrite P100, Rabs_pos_eq; lra|apply bpow_le;
    lia]. }
  rewrite (at_most_is _ _ _ _ I2 IR). set (f := 4 * (x * x * x) - 3 * (r * r * x) + r * r * h).
  rewrite andb_true_iff. unfold sign_of. case Rle_bool_spec; intro H1.
  - case Req_bool_spec; intro H2; [split; [intros _; lra|intros _; now split]|].
    case Rlt_bool_spec; intro H3; [split; [intros _; lra|intros _; now split]|]. split; [now intros [_ G]|intros [_ G]; lra].
  - split; [now intros [G _]|intros [G _]; lra].
Qed.

(* ---- The search ---- *)

Lemma next_above_is : forall c, is_finite 24 128 c = true -> 0 <= value32 c <= 100000 ->
  value32 (next_above c) = succ radix2 fexp32 (value32 c) /\ is_finite 24 128 (next_above c) = true.
Proof.
  intros c Fc Bc. pose proof (Bsucc_correct 24 128 eq_refl eq_refl c Fc) as C.
  change (SpecFloat.fexp 24 128) with fexp32 in C. rewrite Rlt_bool_true in C.
  - destruct C as (C1 & C2 & _). now split.
  - apply Rle_lt_trans with (bpow radix2 20); [|apply bpow_lt; lia].
    apply succ_le_lt; auto with typeclass_instances; [apply (generic_format_B2R 24 128)|apply generic_format_bpow; unfold FLT_exp; lia|].
    change (bpow radix2 20) with 1048576. lra.
Qed.

Lemma next_below_is : forall c, is_finite 24 128 c = true -> 0 < value32 c ->
  value32 (next_below c) = pred radix2 fexp32 (value32 c) /\ is_finite 24 128 (next_below c) = true.
Proof.
  intros c Fc Bc. pose proof (Bpred_correct 24 128 eq_refl eq_refl c Fc) as C.
  change (SpecFloat.fexp 24 128) with fexp32 in C. rewrite Rlt_bool_true in C.
  - destruct C as (C1 & C2 & _). now split.
  - apply Rlt_le_trans with 0; [pose proof (bpow_gt_0 radix2 128); lra|].
    apply pred_ge_gt; auto with typeclass_instances; [apply generic_format_0|apply (generic_format_B2R 24 128)].
Qed.

Lemma succ_is_larger : forall a, 0 <= a -> a * (1 + / 16777216) <= succ radix2 fexp32 a.
Proof.
  intros a Ha. rewrite succ_eq_pos by exact Ha. pose proof (ulp_FLT_gt radix2 (-149) 24 a) as U. rewrite Rabs_pos_eq in U by exact Ha.
  change (bpow radix2 (- (24))) with (/ 16777216) in U. lra.
Qed.

(* The binary32 nearest to what is almost T is the largest that is not above T, or the next. *)
Lemma nearest_of_almost : forall T x, / 10000 <= T <= 10000 -> Rabs (x - T) <= / 1000000000 * T ->
  let G := round radix2 fexp32 Zfloor T in in_binary32 G /\ 9999 / 10000 * T <= G <= T /\ T < succ radix2 fexp32 G <= 2 * T /\
  (nearest32 x = G \/ nearest32 x = succ radix2 fexp32 G).
Proof.
  intros T x HT Hx G. apply Rabs_le_inv in Hx.
  destruct (round_DN_pt radix2 fexp32 T) as (GF & GT & GM). fold G in GF, GT, GM.
  assert (ulp_small : forall a, 0 < a -> bpow radix2 (-30) <= a -> ulp radix2 fexp32 a <= / 8388608 * a).
  { intros a Ha Hb. pose proof (ulp_FLT_le radix2 (-149) 24 a) as U. rewrite (Rabs_pos_eq a) in U by lra.
    change (bpow radix2 (1 - 24)) with (/ 8388608) in U. rewrite Rmult_comm. apply U. apply Rle_trans with (2 := Hb). apply bpow_le. lia. }
  assert (G15 : bpow radix2 (-15) <= G).
  { apply GM; [apply generic_format_bpow; unfold FLT_exp; lia|]. change (bpow radix2 (-15)) with (/ 32768). lra. }
  assert (Gp : 0 < G) by (apply Rlt_le_trans with (2 := G15); apply bpow_gt_0).
  set (S := succ radix2 fexp32 G). assert (SF : in_binary32 S) by (apply generic_format_succ; auto with typeclass_instances).
  assert (TS : T < S).
  { destruct (Rlt_or_le T S) as [H|H]; [exact H|exfalso]. specialize (GM S SF H). pose proof (succ_gt_id radix2 fexp32 G ltac:(lra)) as L.
    fold S in L. lra. }
  assert (SG : S <= G + / 8388608 * G).
  { unfold S. rewrite succ_eq_pos by lra. pose proof (ulp_small G Gp ltac:(apply Rle_trans with (2 := G15); apply bpow_le; lia)). lra. }
  split; [exact GF|]. split; [lra|]. split; [lra|].
  assert (Low : G <= nearest32 x).
  { apply round_N_ge_midp; auto with typeclass_instances. set (g := pred radix2 fexp32 G).
    assert (Hg : 0 <= g) by (apply pred_ge_gt; auto with typeclass_instances; apply generic_format_0).
    pose proof (succ_is_larger g Hg) as L. unfold g in L at 2. rewrite succ_pred in L by auto with typeclass_instances. lra. }
  assert (High : nearest32 x <= S).
  { apply round_N_le_midp; auto with typeclass_instances. pose proof (succ_is_larger S ltac:(lra)). lra. }
  destruct (Rle_or_lt (nearest32 x) G) as [H|H]; [left; lra|right].
  assert (S <= nearest32 x); [|lra]. apply succ_le_lt; auto with typeclass_instances.
    apply generic_format_round; auto with typeclass_instances.
Qed.

Theorem largest_on_top_is_right : forall R w K half_top x, parameters R w K -> is64 (hi half_top) x ->
  let T := value32 R * third_sine (value32 R) (value32 w) in Rabs (x - T) <= / 1000000000 * T ->
  decides_top R w (to64 (largest_on_top R w half_top)).
Proof.
  intros R w K half_top x Hp Ix T Hx. destruct (third_sine_of_half R w K Hp) as (Ht & _). pose proof Hp as (_ & HR & Hw & _).
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((Hlow & _) & _).
  assert (BT : / 10000 <= T <= 10000).
  { unfold T. split.
    - apply Rle_trans with (value32 R * (value32 w / (6 * value32 R))); [|apply Rmult_le_compat_l; lra].
      replace (value32 R * (value32 w / (6 * value32 R))) with (value32 w / 6) by (field; lra). lra.
    - apply Rle_trans with (value32 R * / 2); [apply Rmult_le_compat_l; lra|lra]. }
  destruct (nearest_of_almost T x BT Hx) as (GF & BG & BS & Near). set (G := round radix2 fexp32 Zfloor T) in *.
    set (S := succ radix2 fexp32 G) in *.
  assert (decide : forall c, is_finite 24 128 c = true -> / 100000 <= value32 c <= 20000 -> is_on_top32 c R w = Rle_bool (value32 c) T).
  { intros c Fc Bc. pose proof (is_on_top32_is R w K c Hp Fc Bc) as D. fold T in D. case Rle_bool_spec; intro H.
    - now apply D.
    - destruct (is_on_top32 c R w); [|reflexivity]. exfalso. assert (value32 c <= T) by now apply D. lra. }
  assert (up_stays : forall c, is_finite 24 128 c = true -> value32 c = G -> step_up R w c = c).
  { intros c Fc Ec. destruct (next_above_is c Fc ltac:(lra)) as [E F]. rewrite Ec in E. fold S in E.
    unfold step_up. rewrite decide by (exact F || lra). rewrite E, Rle_bool_false by lra. reflexivity. }
  assert (down_stays : forall c, is_finite 24 128 c = true -> value32 c = G -> step_down R w c = c).
  { intros c Fc Ec. unfold step_down. rewrite decide by (exact Fc || lra). rewrite Ec, Rle_bool_true by lra. reflexivity. }
  destruct Ix as [Vx Fx].
  destruct (to32_rounds_once (hi half_top) Fx) as [V F].
  { rewrite Vx. apply Rle_lt_trans with (bpow radix2 20); [|apply bpow_lt; lia]. change (bpow radix2 20) with 1048576.
    destruct Near as [-> | ->]; rewrite Rabs_pos_eq; lra. }
  rewrite Vx in V.
  assert (Found : exists c, largest_on_top R w half_top = c /\ is_finite 24 128 c = true /\ value32 c = G).
  { unfold largest_on_top. set (f := to32 (hi half_top)) in *. destruct Near as [N|N]; rewrite N in V.
    - exists f. split; [|now split]. rewrite (down_stays f F V), (down_stays f F V), (up_stays f F V), (up_stays f F V). reflexivity.
    - destruct (next_below_is f F ltac:(lra)) as [E F2]. rewrite V in E. unfold S in E.
      rewrite pred_succ in E by auto with typeclass_instances. exists (next_below f). split; [|now split].
      assert (D : step_down R w f = next_below f).
      { unfold step_down. rewrite decide by (exact F || lra). rewrite V, Rle_bool_false by lra. reflexivity. }
      rewrite D, (down_stays _ F2 E), (up_stays _ F2 E), (up_stays _ F2 E). reflexivity. }
  destruct Found as (c & -> & Fc & Vc). destruct (to64_is_exact c Fc) as [V64 F64].
  apply (top_is_decided R w K); try assumption; rewrite V64, Vc.
  - exact GF.
  - lra.
  - apply is_on_top_is_right; try lra. fold T. lra.
  - fold S. intro H. apply is_on_top_is_right in H; try lra. fold T in H. lra.
Qed.
