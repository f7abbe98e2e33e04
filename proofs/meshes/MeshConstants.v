(* SPDX-License-Identifier: BSD-3-Clause *)
(* The constants of the god-object's decisions in binary64: RoundingBound of fast/meshes/rounding_bound.h, on which the compiler runs each
   polynomial of fast/meshes/decide.h. Each is above the error of its polynomial, and nothing overflows or underflows on the way. *)
From Coq Require Import ZArith Reals Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Operations Nearness.
Open Scope R_scope.

(* ---- A polynomial in binary64 ---- *)

(* |computed| <= size * scale and |computed - exact| <= off * scale, scale being the product of the vectors' largest components. *)
Record bound := Bound { size : R; off : R }.
Definition once_rounded (s o : R) : bound := Bound ((1 + unit53) * s) (o + unit53 * s).
Definition bound_of_sum (a b : bound) : bound := once_rounded (size a + size b) (off a + off b).
Definition bound_of_product (a b : bound) : bound :=
  once_rounded (size a * size b) (size a * off b + size b * off a + off a * off b).

(* A component of a vector: a multiple of 2^-grain below 2^41. *)
Inductive polynomial :=
| component (computed : binary64) (exact scale : R) (grain : Z) (known : bound)
| sum (a b : polynomial)
| difference (a b : polynomial)
| product (a b : polynomial).

Fixpoint computed_of (p : polynomial) : binary64 :=
  match p with
  | component v _ _ _ _ => v
  | sum a b => plus (computed_of a) (computed_of b)
  | difference a b => minus (computed_of a) (computed_of b)
  | product a b => times (computed_of a) (computed_of b)
  end.
Fixpoint exact_of (p : polynomial) : R :=
  match p with
  | component _ x _ _ _ => x
  | sum a b => exact_of a + exact_of b
  | difference a b => exact_of a - exact_of b
  | product a b => exact_of a * exact_of b
  end.
Fixpoint scale_of (p : polynomial) : R :=
  match p with component _ _ s _ _ => s | sum a _ | difference a _ => scale_of a | product a b => scale_of a * scale_of b end.
Fixpoint grain_of (p : polynomial) : Z :=
  match p with component _ _ _ g _ => g | sum a _ | difference a _ => grain_of a | product a b => grain_of a + grain_of b end.
Fixpoint reach_of (p : polynomial) : Z :=
  match p with
  | component _ _ _ _ _ => 41
  | sum a b | difference a b => 1 + Z.max (reach_of a) (reach_of b)
  | product a b => reach_of a + reach_of b
  end.
Fixpoint bound_of (p : polynomial) : bound :=
  match p with
  | component _ _ _ _ k => k
  | sum a b | difference a b => bound_of_sum (bound_of a) (bound_of b)
  | product a b => bound_of_product (bound_of a) (bound_of b)
  end.

Definition is_grained (g : Z) (x : R) : Prop := generic_format radix2 (FIX_exp (- g)) x.
Fixpoint is_homogeneous (p : polynomial) : Prop :=
  (0 <= grain_of p <= 1000)%Z /\ (0 <= reach_of p <= 1000)%Z /\
  match p with
  | component v x s g k => is_finite 53 1024 v = true /\ is_grained g (value64 v) /\ Rabs (value64 v) <= bpow radix2 41 /\ 0 <= s /\
      0 <= size k /\ 0 <= off k /\ Rabs (value64 v) <= size k * s /\ Rabs (value64 v - x) <= off k * s
  | sum a b | difference a b => is_homogeneous a /\ is_homogeneous b /\ scale_of a = scale_of b /\ grain_of a = grain_of b
  | product a b => is_homogeneous a /\ is_homogeneous b
  end.

(* ---- Each operation ---- *)

Lemma grained_sum : forall g x y, is_grained g x -> is_grained g y -> is_grained g (x + y).
Proof.
  intros g x y X Y. apply FIX_format_generic in X. apply FIX_format_generic in Y. destruct X as [[m e] -> E], Y as [[n f] -> F].
  cbn [Fexp] in E, F. subst e f. apply generic_format_FIX. exists (Float radix2 (m + n) (- g)); [|reflexivity].
  unfold F2R. cbn [Fnum Fexp]. rewrite plus_IZR. ring.
Qed.
Lemma grained_opposite : forall g x, is_grained g x -> is_grained g (- x).
Proof. intros g x X. now apply generic_format_opp. Qed.
Lemma grained_product : forall g h x y, is_grained g x -> is_grained h y -> is_grained (g + h) (x * y).
Proof.
  intros g h x y X Y. apply FIX_format_generic in X. apply FIX_format_generic in Y. destruct X as [[m e] -> E], Y as [[n f] -> F].
  cbn [Fexp] in E, F. subst e f. apply generic_format_FIX. exists (Float radix2 (m * n) (- (g + h))); [|reflexivity].
  unfold F2R. cbn [Fnum Fexp]. rewrite mult_IZR, Z.opp_add_distr, bpow_plus. ring.
Qed.
Lemma grained_rounded : forall g x, is_grained g x -> is_grained g (nearest64 x).
Proof. intros g x X. apply generic_round_generic; auto with typeclass_instances. Qed.

Lemma grained_is_normal : forall g x, (0 <= g <= 1000)%Z -> is_grained g x -> Rabs (nearest64 x - x) <= unit53 * Rabs x.
Proof.
  intros g x G X. destruct (Req_dec x 0) as [->|N].
  { rewrite round_0, Rminus_0_r, Rabs_R0 by auto with typeclass_instances. lra. }
  replace unit53 with (/ 2 * bpow radix2 (-53 + 1)) by (unfold unit53; simpl; lra).
  apply relative_error_N_FLT; [reflexivity|]. apply FIX_format_generic in X. destruct X as [[m e] E F]. cbn [Fexp] in F. subst e.
  rewrite E. apply Rle_trans with (bpow radix2 (- g)); [apply bpow_le; lia|]. rewrite <- F2R_Zabs. unfold F2R. cbn [Fnum Fexp].
  rewrite <- (Rmult_1_l (bpow radix2 (- g))) at 1. apply Rmult_le_compat_r; [apply bpow_ge_0|]. apply (IZR_le 1).
  destruct (Z.eq_dec m 0) as [->|M]; [|lia]. exfalso. apply N. rewrite E. apply F2R_0.
Qed.

Lemma below_power : forall r x, (-1000 <= r)%Z -> Rabs x <= bpow radix2 r -> Rabs (nearest64 x) <= bpow radix2 r.
Proof.
  intros r x H X. apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Definition is_near (p : polynomial) : Prop :=
  is_finite 53 1024 (computed_of p) = true /\ is_grained (grain_of p) (value64 (computed_of p)) /\
  Rabs (value64 (computed_of p)) <= bpow radix2 (reach_of p) /\ 0 <= scale_of p /\ 0 <= size (bound_of p) /\ 0 <= off (bound_of p) /\
  Rabs (value64 (computed_of p)) <= size (bound_of p) * scale_of p /\
  Rabs (value64 (computed_of p) - exact_of p) <= off (bound_of p) * scale_of p.

(* What rounding once makes of a number x that is no larger than s * scale and off the exact one by o * scale. *)
Lemma rounded_once : forall x s o S exact, Rabs x <= s * S -> Rabs (x - exact) <= o * S -> 0 <= S -> 0 <= s ->
  Rabs (nearest64 x - x) <= unit53 * Rabs x ->
  Rabs (nearest64 x) <= size (once_rounded s o) * S /\ Rabs (nearest64 x - exact) <= off (once_rounded s o) * S.
Proof.
  intros x s o S exact X E HS Hs N. pose proof unit_is_small as U. cbn [once_rounded size off].
  assert (M : unit53 * Rabs x <= unit53 * (s * S)) by (apply Rmult_le_compat_l; lra). split.
  - replace (nearest64 x) with (x + (nearest64 x - x)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - replace (nearest64 x - exact) with (x - exact + (nearest64 x - x)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma sizes_add : forall x y X Y s t o q S, Rabs x <= s * S -> Rabs y <= t * S -> Rabs (x - X) <= o * S -> Rabs (y - Y) <= q * S ->
  (Rabs (x + y) <= (s + t) * S /\ Rabs (x + y - (X + Y)) <= (o + q) * S) /\
  (Rabs (x - y) <= (s + t) * S /\ Rabs (x - y - (X - Y)) <= (o + q) * S).
Proof.
  intros x y X Y s t o q S A B C D. apply Rabs_le_inv in A, B, C, D.
  repeat split; apply Rabs_le; lra.
Qed.

Lemma sum_is_near : forall a b, is_near a -> is_near b -> scale_of a = scale_of b -> grain_of a = grain_of b ->
  (0 <= grain_of a <= 1000)%Z -> (0 <= reach_of (sum a b) <= 1000)%Z -> is_near (sum a b) /\ is_near (difference a b).
Proof.
  intros a b (Fa & Ga & Ra & Sa & Pa & Qa & Ba & Ea) (Fb & Gb & Rb & _ & Pb & Qb & Bb & Eb) S G K L.
  rewrite <- S in Bb, Eb. rewrite <- G in Gb. cbn [reach_of] in L. pose proof unit_is_small as U.
  set (x := value64 (computed_of a)) in *. set (y := value64 (computed_of b)) in *. set (r := Z.max (reach_of a) (reach_of b)) in *.
  assert (X : Rabs x <= bpow radix2 r) by (apply Rle_trans with (1 := Ra), bpow_le; lia).
  assert (Y : Rabs y <= bpow radix2 r) by (apply Rle_trans with (1 := Rb), bpow_le; lia).
  assert (T : bpow radix2 (1 + r) = bpow radix2 r + bpow radix2 r) by (rewrite bpow_plus; change (bpow radix2 1) with 2; ring).
  assert (B1 : Rabs (x + y) <= bpow radix2 (1 + r)) by (rewrite T; apply Rle_trans with (1 := Rabs_triang _ _); lra).
  assert (B2 : Rabs (x - y) <= bpow radix2 (1 + r)).
  { rewrite T. unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  assert (B : bpow radix2 (1 + r) <= bpow radix2 1000) by (apply bpow_le; lia).
  destruct (plus_is _ _ x y (conj eq_refl Fa) (conj eq_refl Fb) (Rle_trans _ _ _ B1 B)) as [V1 F1].
  destruct (minus_is _ _ x y (conj eq_refl Fa) (conj eq_refl Fb) (Rle_trans _ _ _ B2 B)) as [V2 F2].
  pose proof (grained_sum _ _ _ Ga Gb) as G1. pose proof (grained_sum _ _ _ Ga (grained_opposite _ _ Gb)) as G2.
  fold (x - y) in G2. destruct (sizes_add _ _ _ _ _ _ _ _ _ Ba Bb Ea Eb) as [[S1 E1] [S2 E2]].
  assert (P : 0 <= size (bound_of a) + size (bound_of b)) by lra.
  pose proof (rounded_once _ _ _ _ _ S1 E1 Sa P (grained_is_normal _ _ K G1)) as [N1 M1].
  pose proof (rounded_once _ _ _ _ _ S2 E2 Sa P (grained_is_normal _ _ K G2)) as [N2 M2].
  assert (0 <= unit53 * (size (bound_of a) + size (bound_of b))) by (apply Rmult_le_pos; lra).
  split; unfold is_near; cbn [computed_of exact_of scale_of grain_of reach_of bound_of]; rewrite ?V1, ?V2; fold r;
    repeat split; try assumption; try (apply grained_rounded; assumption); try (apply below_power; [lia|assumption]);
    unfold bound_of_sum, once_rounded; cbn [size off]; lra.
Qed.

Lemma product_is_near : forall a b, is_near a -> is_near b -> (0 <= grain_of (product a b) <= 1000)%Z ->
  (0 <= reach_of (product a b) <= 1000)%Z -> is_near (product a b).
Proof.
  intros a b (Fa & Ga & Ra & Sa & Pa & Qa & Ba & Ea) (Fb & Gb & Rb & Sb & Pb & Qb & Bb & Eb) K L.
  cbn [reach_of grain_of] in K, L. pose proof unit_is_small as U.
  set (x := value64 (computed_of a)) in *. set (y := value64 (computed_of b)) in *.
  assert (B1 : Rabs (x * y) <= bpow radix2 (reach_of a + reach_of b)).
  { rewrite Rabs_mult, bpow_plus. apply Rmult_le_compat; try apply Rabs_pos; assumption. }
  assert (B : bpow radix2 (reach_of a + reach_of b) <= bpow radix2 1000) by (apply bpow_le; lia).
  destruct (times_is _ _ x y (conj eq_refl Fa) (conj eq_refl Fb) (Rle_trans _ _ _ B1 B)) as [V1 F1].
  pose proof (grained_product _ _ _ _ Ga Gb) as G1. pose proof (grained_is_normal _ _ K G1) as N.
  set (s := size (bound_of a)) in *. set (t := size (bound_of b)) in *. set (o := off (bound_of a)) in *. set (q := off (bound_of b)) in *.
  assert (S1 : Rabs (x * y) <= s * t * (scale_of a * scale_of b)).
  { rewrite Rabs_mult. replace (s * t * (scale_of a * scale_of b)) with (s * scale_of a * (t * scale_of b)) by ring.
    apply Rmult_le_compat; try apply Rabs_pos; assumption. }
  assert (E1 : Rabs (x * y - exact_of a * exact_of b) <= (s * q + t * o + o * q) * (scale_of a * scale_of b)).
  { replace (x * y - exact_of a * exact_of b) with (x * (y - exact_of b) + y * (x - exact_of a) - (x - exact_of a) * (y - exact_of b))
      by ring.
    replace ((s * q + t * o + o * q) * (scale_of a * scale_of b)) with
      (s * scale_of a * (q * scale_of b) + t * scale_of b * (o * scale_of a) + o * scale_of a * (q * scale_of b)) by ring.
    unfold Rminus at 1. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. apply Rplus_le_compat.
    - apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
      apply Rplus_le_compat; apply Rmult_le_compat; try apply Rabs_pos; assumption.
    - rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; assumption. }
  assert (HS : 0 <= scale_of a * scale_of b) by now apply Rmult_le_pos.
  assert (Ps : 0 <= s * t) by now apply Rmult_le_pos.
  pose proof (rounded_once _ _ _ _ _ S1 E1 HS Ps N) as [N1 M1].
  assert (0 <= s * q) by now apply Rmult_le_pos. assert (0 <= t * o) by now apply Rmult_le_pos.
  assert (0 <= o * q) by now apply Rmult_le_pos. assert (0 <= unit53 * (s * t)) by (apply Rmult_le_pos; lra).
  unfold is_near; cbn [computed_of exact_of scale_of grain_of reach_of bound_of]. rewrite V1. fold s t o q.
  repeat split; try assumption; try (apply grained_rounded; assumption); try (apply below_power; [lia|assumption]);
    unfold bound_of_product, once_rounded; fold s t o q; cbn [size off]; lra.
Qed.

(* A polynomial errs by no more than its bound, times the sizes of its vectors. *)
Theorem polynomial_is_near : forall p, is_homogeneous p -> is_near p.
Proof.
  induction p as [v x s g k|a IHa b IHb|a IHa b IHb|a IHa b IHb]; cbn [is_homogeneous].
  - intros (G & L & F & Gr & B & S & P & Q & Sz & Er). now repeat split.
  - intros (G & L & Ha & Hb & S & Gr). now apply sum_is_near; auto.
  - intros (G & L & Ha & Hb & S & Gr). now apply sum_is_near; auto.
  - intros (G & L & Ha & Hb). now apply product_is_near; auto.
Qed.
