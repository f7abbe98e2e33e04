(* SPDX-License-Identifier: BSD-3-Clause *)
(* How near a component can come to the middle of two binary32 numbers without being on it: the lemma of docs/proofs.md, "The last
   stage", for the degrees 2 and 4, and the separation of bump-1p-shaded. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Shaded Gap DoubleDouble Depth.
Open Scope R_scope.

(* ---- Whole multiples of a power of two ---- *)

Definition multiple (k : Z) (a : R) : Prop := exists n : Z, a = IZR n * bpow radix2 (- k).

Lemma multiple_finer : forall k m a, multiple k a -> (k <= m)%Z -> multiple m a.
Proof.
  intros k m a [n ->] H. exists (n * 2 ^ (m - k))%Z. rewrite mult_IZR. change (2 ^ (m - k))%Z with (Zpower radix2 (m - k)).
  rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. ring.
Qed.

Lemma multiple_times : forall k m a b, multiple k a -> multiple m b -> multiple (k + m) (a * b).
Proof.
  intros k m a b [n ->] [i ->]. exists (n * i)%Z. rewrite mult_IZR. replace (- (k + m))%Z with (- k + - m)%Z by ring.
  rewrite bpow_plus. ring.
Qed.

Lemma multiple_plus : forall k m a b, multiple k a -> multiple m b -> multiple (Z.max k m) (a + b).
Proof.
  intros k m a b Ha Hb. destruct (multiple_finer _ (Z.max k m) _ Ha ltac:(lia)) as [n ->].
  destruct (multiple_finer _ (Z.max k m) _ Hb ltac:(lia)) as [i ->]. exists (n + i)%Z. rewrite plus_IZR. ring.
Qed.

Lemma multiple_opp : forall k a, multiple k a -> multiple k (- a).
Proof. intros k a [n ->]. exists (- n)%Z. rewrite opp_IZR. ring. Qed.

Lemma multiple_minus : forall k m a b, multiple k a -> multiple m b -> multiple (Z.max k m) (a - b).
Proof. intros k m a b Ha Hb. apply multiple_plus; [exact Ha|now apply multiple_opp]. Qed.

Lemma multiple_whole : forall n, multiple 0 (IZR n).
Proof. intro n. exists n. simpl. ring. Qed.

Lemma multiple_not_0 : forall k a, multiple k a -> a <> 0 -> bpow radix2 (- k) <= Rabs a.
Proof.
  intros k a [n ->] Hne. rewrite Rabs_mult, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0. pose proof (bpow_gt_0 radix2 (- k)) as P.
  rewrite <- (Rmult_1_l (bpow radix2 (- k))) at 1. apply Rmult_le_compat_r; [lra|]. rewrite <- abs_IZR. apply IZR_le.
  assert (n <> 0)%Z; [|lia]. intros ->. apply Hne. ring.
Qed.

(* The exponent follows from those of the parts, which are hypotheses. *)
Ltac multiple_of_parts :=
  match goal with
  | |- multiple _ (_ * _) => eapply multiple_times; multiple_of_parts
  | |- multiple _ (_ + _) => eapply multiple_plus; multiple_of_parts
  | |- multiple _ (_ - _) => eapply multiple_minus; multiple_of_parts
  | |- multiple _ (- _) => eapply multiple_opp; multiple_of_parts
  | |- multiple _ _ => first [eassumption|apply multiple_whole]
  end.
Ltac multiple := eapply multiple_finer; [multiple_of_parts|apply Z.leb_le; reflexivity].

(* ---- The lemma ---- *)

(* a + t, whose conjugate is a - t: the square of t is rational. *)
Lemma separation_of_degree_2 : forall k a t C, multiple k a -> multiple (2 * k) (t * t) -> a + t <> 0 ->
  bpow radix2 (- k) <= C -> Rabs (a - t) <= C -> bpow radix2 (- (2 * k)) <= Rabs (a + t) * C.
Proof.
  intros k a t C Ha Ht Hne HC Hconj. pose proof (Rabs_pos (a + t)) as P.
  assert (E : bpow radix2 (- (2 * k)) = bpow radix2 (- k) * bpow radix2 (- k)) by (rewrite <- bpow_plus; f_equal; ring).
  destruct (Req_dec (a - t) 0) as [H0|H0].
  - assert (H2 : multiple k (a + t)).
    { replace (a + t) with (2 * a) by lra. apply (multiple_finer (0 + k)); [|lia]. now apply multiple_times; [apply multiple_whole|]. }
    pose proof (multiple_not_0 _ _ H2 Hne) as H. rewrite E. apply Rmult_le_compat; try apply bpow_ge_0; assumption.
  - assert (H2 : multiple (2 * k) ((a + t) * (a - t))).
    { replace ((a + t) * (a - t)) with (a * a - t * t) by ring. apply (multiple_finer (Z.max (k + k) (2 * k))); [|lia].
      apply multiple_minus; [now apply multiple_times|assumption]. }
    pose proof (multiple_not_0 _ _ H2 ltac:(now apply Rmult_integral_contrapositive)) as H. rewrite Rabs_mult in H.
    apply Rle_trans with (1 := H). now apply Rmult_le_compat_l.
Qed.

(* a + u + t, whose conjugates are a + u - t and, with t' of t' t' = p - v, a - u + t' and a - u - t'. *)
Lemma separation_of_degree_4 : forall k a u p v t C, multiple k a -> multiple (2 * k) (u * u) -> multiple (2 * k) p ->
  multiple (3 * k) (u * v) -> multiple (4 * k) (v * v) -> t * t = p + v -> a + u + t <> 0 -> bpow radix2 (- k) <= C ->
  Rabs (a + u - t) <= C -> Rabs (a - u) <= C -> Rabs ((a - u) * (a - u) - (p - v)) <= C * C ->
  bpow radix2 (- (4 * k)) <= Rabs (a + u + t) * (C * C * C).
Proof.
  intros k a u p v t C Ha Hu Hp Huv Hv Ht Hne HC C1 C2 C3. pose proof (Rabs_pos (a + u + t)) as P.
  pose proof (bpow_gt_0 radix2 (- k)) as Pk. assert (PCC : 0 < C * C) by (apply Rmult_lt_0_compat; lra).
  assert (E : bpow radix2 (- (2 * k)) = bpow radix2 (- k) * bpow radix2 (- k)) by (rewrite <- bpow_plus; f_equal; ring).
  assert (E2 : bpow radix2 (- (4 * k)) = bpow radix2 (- (2 * k)) * bpow radix2 (- (2 * k))) by (rewrite <- bpow_plus; f_equal; ring).
  assert (HCC : bpow radix2 (- (2 * k)) <= C * C) by (rewrite E; apply Rmult_le_compat; lra).
  destruct (Req_dec (a + u - t) 0) as [H0|H0].
  - assert (Hau : a + u <> 0) by lra. pose proof (separation_of_degree_2 k a u C Ha Hu Hau HC C2) as H.
    assert (G : Rabs (a + u + t) = 2 * Rabs (a + u)) by (replace (a + u + t) with (2 * (a + u)) by lra; rewrite Rabs_mult, Rabs_pos_eq;
      lra).
    rewrite G, E2. replace (2 * Rabs (a + u) * (C * C * C)) with (2 * ((Rabs (a + u) * C) * (C * C))) by ring.
    pose proof (bpow_gt_0 radix2 (- (2 * k))) as P2.
    assert (bpow radix2 (- (2 * k)) * bpow radix2 (- (2 * k)) <= (Rabs (a + u) * C) * (C * C)) by (apply Rmult_le_compat; lra).
    assert (0 < bpow radix2 (- (2 * k)) * bpow radix2 (- (2 * k))) by (apply Rmult_lt_0_compat; lra). lra.
  - set (n := a * a + u * u - p). set (w := 2 * a * u - v).
    assert (Hn : multiple (2 * k) n).
    { apply (multiple_finer (Z.max (Z.max (k + k) (2 * k)) (2 * k))); [|lia].
      apply multiple_minus; [apply multiple_plus; [now apply multiple_times|assumption]|assumption]. }
    assert (Hw : multiple (2 * (2 * k)) (w * w)).
    { replace (w * w) with (4 * (a * a * (u * u)) - 4 * (a * (u * v)) + v * v) by (unfold w; ring).
      apply (multiple_finer (Z.max (Z.max (0 + (k + k + 2 * k)) (0 + (k + 3 * k))) (4 * k))); [|lia].
      apply multiple_plus; [|assumption]. apply multiple_minus; apply multiple_times; try apply multiple_whole.
      - apply multiple_times; [now apply multiple_times|assumption].
      - now apply multiple_times. }
    assert (G : n + w = (a + u + t) * (a + u - t)) by (unfold n, w; replace ((a + u + t) * (a + u - t)) with ((a + u) * (a + u) - t * t) by
      ring;
      rewrite Ht; ring).
    assert (Hnw : n + w <> 0) by (rewrite G; now apply Rmult_integral_contrapositive).
    pose proof (separation_of_degree_2 (2 * k) n w (C * C) Hn Hw Hnw HCC) as H.
    replace (n - w) with ((a - u) * (a - u) - (p - v)) in H by (unfold n, w; ring). specialize (H C3). rewrite G, Rabs_mult in H.
    replace (4 * k)%Z with (2 * (2 * k))%Z by ring. apply Rle_trans with (1 := H).
    replace (Rabs (a + u + t) * (C * C * C)) with (Rabs (a + u + t) * C * (C * C)) by ring. apply Rmult_le_compat_r; [lra|].
    now apply Rmult_le_compat_l.
Qed.

(* ---- The numbers of the domain, and the middles ---- *)

Lemma multiple_of_binary32 : forall k a, (-125 <= k)%Z -> in_binary32 a -> bpow radix2 k <= Rabs a -> multiple (23 - k) a.
Proof.
  intros k a Hk Ha Hs. destruct (multiple_of k a Hk Ha Hs) as [n ->]. exists n. do 2 f_equal. ring.
Qed.

Lemma multiple_of_stiffness : forall R w K, parameters R w K -> multiple 33 (value32 K).
Proof.
  intros R w K (_ & _ & _ & HK). apply (multiple_of_binary32 (-10)); [lia|apply (generic_format_B2R 24 128)|].
  rewrite Rabs_pos_eq by lra. simpl. lra.
Qed.

Lemma multiple_of_radius : forall R w K, parameters R w K -> multiple 27 (value32 R).
Proof.
  intros R w K (_ & HR & _). apply (multiple_of_binary32 (-4)); [lia|apply (generic_format_B2R 24 128)|].
  rewrite Rabs_pos_eq by lra. simpl. lra.
Qed.

Lemma multiple_of_half_width : forall R w K, parameters R w K -> multiple 34 (value32 w / 2).
Proof.
  intros R w K (_ & _ & Hw & _). destruct (multiple_of_binary32 (-10) (value32 w)) as [n Hn]; [lia|apply (generic_format_B2R 24 128)| |].
  { rewrite Rabs_pos_eq by lra. simpl. lra. }
  exists n. rewrite Hn. change (- (23 - -10))%Z with (-34 + 1)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. simpl (- (34))%Z. field.
Qed.

Lemma multiple_of_coordinate : forall v X, coordinate v X -> multiple 53 X.
Proof. intros v X H. destruct (multiple_of_2_53 X (coordinate_format _ _ H) (coordinate_not_tiny _ _ H)) as [n ->]. now exists n. Qed.

(* A middle of two neighbours in binary32: what a later stage compares with. *)
Definition is_tie (m : R) : Prop := exists c, in_binary32 c /\ (m = (c + succ radix2 fexp32 c) / 2 \/ m = (c + pred radix2 fexp32 c) / 2).

(* What each theorem of a law begins with. *)
Ltac multiples_of_inputs Hp Cx Cz :=
  pose proof (multiple_of_stiffness _ _ _ Hp) as MK; pose proof (multiple_of_radius _ _ _ Hp) as MR;
  pose proof (multiple_of_half_width _ _ _ Hp) as Mc; pose proof (multiple_of_coordinate _ _ Cx) as MX;
  pose proof (multiple_of_coordinate _ _ Cz) as MZ.

Lemma multiple_of_tie : forall m, is_tie m -> multiple 150 m.
Proof.
  assert (all : forall c, in_binary32 c -> multiple 149 c).
  { intros c Hc. exists (Ztrunc (scaled_mantissa radix2 fexp32 c) * 2 ^ (cexp radix2 fexp32 c + 149))%Z. rewrite Hc at 1. unfold F2R.
    cbn [Fnum Fexp]. assert (He : (-149 <= cexp radix2 fexp32 c)%Z) by (unfold cexp, FLT_exp; lia). rewrite mult_IZR.
    change (2 ^ (cexp radix2 fexp32 c + 149))%Z with (Zpower radix2 (cexp radix2 fexp32 c + 149)). rewrite IZR_Zpower by lia.
    rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. ring. }
  assert (half : forall c d, in_binary32 c -> in_binary32 d -> multiple 150 ((c + d) / 2)).
  { intros c d Hc Hd. destruct (multiple_plus _ _ _ _ (all c Hc) (all d Hd)) as [n Hn]. exists n. rewrite Hn.
    change (- Z.max 149 149)%Z with (- (150) + 1)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. field. }
  intros m (c & Hc & [-> | ->]); apply half; auto with typeclass_instances;
    [apply generic_format_succ|apply generic_format_pred]; auto with typeclass_instances.
Qed.

(* A component is no larger than B, so only middles up to B + 1 can be near it. *)
Lemma small_middles_suffice : forall B F m e, Rabs F <= B -> e <= 1 -> (Rabs m <= B + 1 -> F <> m -> e <= Rabs (F - m)) ->
  F <> m -> e <= Rabs (F - m).
Proof.
  intros B F m e HF He H Hne. destruct (Rle_lt_dec (Rabs m) (B + 1)) as [Hm|Hm]; [now apply H|].
  pose proof (Rabs_triang_inv m F) as T. rewrite (Rabs_minus_sym m F) in T. lra.
Qed.

(* gamma = (F - m) D, and what is known of gamma. *)
Lemma separation_of_quotient : forall F m D gamma j e, gamma = (F - m) * D -> 0 < D <= bpow radix2 j ->
  bpow radix2 (j - e) <= Rabs gamma -> bpow radix2 (- e) <= Rabs (F - m).
Proof.
  intros F m D gamma j e -> [HD HD2] H. rewrite Rabs_mult, (Rabs_pos_eq D) in H by lra. pose proof (Rabs_pos (F - m)) as P.
  pose proof (bpow_gt_0 radix2 j) as Pj. apply Rmult_le_reg_r with (bpow radix2 j); [assumption|]. rewrite <- bpow_plus.
  replace (- e + j)%Z with (j - e)%Z by ring. apply Rle_trans with (1 := H). now apply Rmult_le_compat_l.
Qed.

(* The same, from what separation_of_degree_4 says of gamma. *)
Lemma separation_of_quotient_4 : forall F m D gamma j k l, gamma = (F - m) * D -> 0 < D <= bpow radix2 j ->
  bpow radix2 (- (4 * k)) <= Rabs gamma * (bpow radix2 l * bpow radix2 l * bpow radix2 l) ->
  bpow radix2 (- (j + 4 * k + 3 * l)) <= Rabs (F - m).
Proof.
  intros F m D gamma j k l E HD H. apply (separation_of_quotient F m D gamma j _ E HD). rewrite <- !bpow_plus in H.
  apply Rmult_le_reg_r with (bpow radix2 (l + l + l)); [apply bpow_gt_0|]. rewrite <- bpow_plus.
  replace (j - (j + 4 * k + 3 * l) + (l + l + l))%Z with (- (4 * k))%Z by ring. exact H.
Qed.

(* ---- bump-1p-shaded ---- *)

(* Its largest force is 10^7 N. *)
Lemma bump_1p_shaded_size : forall Rad w K X Z, 0 < Rad -> w <= 2 * Rad -> 0 <= K <= 1000 -> Rabs Z <= 10000 ->
  Rabs (shaded_x Rad w K X (- Z)) <= 10000000 /\ Rabs (shaded_z Rad w K X (- Z)) <= 10000000.
Proof.
  intros Rad w K X Z HR Hw HK HZ. unfold shaded_x, shaded_z.
  assert (B : forall a, Rabs a <= 1 -> Rabs (K * - Z * a) <= 10000000).
  { intros a Ha. rewrite !Rabs_mult, Rabs_Ropp, (Rabs_pos_eq K) by lra. replace 10000000 with (1000 * 10000 * 1) by ring.
    apply Rmult_le_compat; try assumption; try apply Rabs_pos; [apply Rmult_le_pos; [lra|apply Rabs_pos]|].
    apply Rmult_le_compat; try apply Rabs_pos; lra. }
  case Rle_bool_spec; intro H.
  - split; apply B; unfold Rdiv; rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq Rad) by lra; apply Rmult_le_reg_r with Rad; try lra;
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r, Rmult_1_l by lra; [lra|].
    rewrite Rabs_pos_eq by apply sqrt_pos. rewrite <- (sqrt_Rsqr Rad) at 2 by lra. apply sqrt_le_1_alt. pose proof (Rle_0_sqr X). lra.
  - split; [rewrite Rabs_R0; lra|]. apply B. rewrite Rabs_R1. lra.
Qed.

Lemma bump_1p_shaded_z_is_separated : forall K Z Rad X m, multiple 33 K -> multiple 53 Z -> multiple 27 Rad -> multiple 53 X -> multiple
  150 m ->
  0 <= K <= 1000 -> Rabs Z <= 10000 -> 0 < Rad <= 10000 -> Rabs X <= Rad -> Rabs m <= 10000001 ->
  let F := K * - Z * (sqrt (Rsqr Rad - Rsqr X) / Rad) in F <> m -> bpow radix2 (-406) <= Rabs (F - m).
Proof.
  intros K Z Rad X m MK MZ MR MX Mm HK HZ HR HX Hm F Hne. set (S := sqrt (Rsqr Rad - Rsqr X)) in *.
  assert (HS0 : 0 <= Rsqr Rad - Rsqr X) by (pose proof (Rsqr_le_abs_1 X Rad ltac:(rewrite (Rabs_pos_eq Rad); lra)); lra).
  assert (HS : S * S = Rad * Rad - X * X) by (now apply sqrt_sqrt). assert (PS : 0 <= S) by apply sqrt_pos.
  assert (HSR : S <= 10000).
  { apply Rle_trans with Rad; [|lra]. rewrite <- (sqrt_Rsqr Rad) by lra. apply sqrt_le_1_alt. pose proof (Rle_0_sqr X). lra. }
  set (a := - (m * Rad)). set (t := K * - Z * S).
  assert (E : a + t = (F - m) * Rad) by (unfold a, t, F; field; lra).
  assert (Ma : multiple 177 a) by (unfold a; multiple).
  assert (Mt : multiple (2 * 177) (t * t)).
  { replace (t * t) with (K * K * (Z * Z) * (Rad * Rad - X * X)) by (rewrite <- HS; unfold t; ring). multiple. }
  assert (Hat : a + t <> 0).
  { rewrite E. apply Rmult_integral_contrapositive_currified; lra. }
  assert (HC : bpow radix2 (-177) <= bpow radix2 38) by (apply bpow_le; lia).
  assert (Bt : Rabs t <= 100000000000).
  { unfold t. rewrite !Rabs_mult, Rabs_Ropp, (Rabs_pos_eq K), (Rabs_pos_eq S) by lra. replace 100000000000 with (1000 * 10000 * 10000) by
    ring.
    apply Rmult_le_compat; try lra; [apply Rmult_le_pos; [lra|apply Rabs_pos]|]. apply Rmult_le_compat; try apply Rabs_pos; lra. }
  assert (Ba : Rabs a <= 100000010000).
  { unfold a. rewrite Rabs_Ropp, Rabs_mult, (Rabs_pos_eq Rad) by lra. replace 100000010000 with (10000001 * 10000) by ring.
    apply Rmult_le_compat; try apply Rabs_pos; lra. }
  assert (Hconj : Rabs (a - t) <= bpow radix2 38).
  { apply Rle_trans with (Rabs a + Rabs t); [unfold Rminus; rewrite <- (Rabs_Ropp t); apply Rabs_triang|]. simpl. lra. }
  pose proof (separation_of_degree_2 177 a t _ Ma Mt Hat HC Hconj) as H.
  apply (separation_of_quotient F m Rad (a + t) 14 406 E); [simpl; lra|].
  apply Rmult_le_reg_r with (bpow radix2 38); [apply bpow_gt_0|]. rewrite <- bpow_plus. exact H.
Qed.

Theorem bump_1p_shaded_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let Fx := shaded_x (value32 R) (value32 w) (value32 K) X (- Z) in let Fz := shaded_z (value32 R) (value32 w) (value32 K) X (- Z) in
  (Fx <> m -> bpow radix2 (-406) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-406) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_tie m Hm) as Mm.
  destruct Hp as (_ & HR & Hw & HK). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (bump_1p_shaded_size (value32 R) (value32 w) (value32 K) X Z ltac:(lra) ltac:(lra) ltac:(lra) BZ) as [Bx Bz].
  fold Fx in Bx. fold Fz in Bz.
  assert (Hsmall : bpow radix2 (-406) <= 1) by (change 1 with (bpow radix2 0); apply bpow_le; lia).
  assert (plain : forall F k, multiple k (F - m) -> (k <= 406)%Z -> F <> m -> bpow radix2 (-406) <= Rabs (F - m)).
  { intros F k M Hk Hne. apply Rle_trans with (bpow radix2 (- k)); [apply bpow_le; lia|]. apply (multiple_not_0 _ _ M). lra. }
  split; [clear Bz|clear Bx]; apply (small_middles_suffice 10000000 _ m); try assumption; intros Bm Hne.
  - unfold Fx, shaded_x in *. destruct (Rle_bool (Rabs X) (value32 w / 2)).
    + set (F := value32 K * - Z * (X / value32 R)) in *.
      apply (separation_of_quotient F m (value32 R) (value32 K * - Z * X - m * value32 R) 14 406); [unfold F; field; lra|simpl; lra|].
      apply Rle_trans with (bpow radix2 (-177)); [apply bpow_le; lia|]. apply (multiple_not_0 177); [multiple|].
      replace (value32 K * - Z * X - m * value32 R) with ((F - m) * value32 R) by (unfold F; field; lra).
      apply Rmult_integral_contrapositive_currified; lra.
    + apply (plain _ 150%Z); [|lia|assumption]. unfold Rminus. replace (0 + - m) with (- m) by ring. multiple.
  - unfold Fz, shaded_z in *. revert Hne Bz. case Rle_bool_spec; intros H Hne Bz.
    + apply (bump_1p_shaded_z_is_separated (value32 K) Z (value32 R) X m); try assumption; lra.
    + apply (plain _ 150%Z); [|lia|assumption]. multiple.
Qed.
