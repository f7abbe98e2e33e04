(* SPDX-License-Identifier: BSD-3-Clause *)
(* Each operation of the numbers that decide signs on any set of triangles (proofs/soups/SoupNumbers.v) has the exact number between its
   bounds, or a bound that decides nothing, whatever overflows or underflows. *)
From Coq Require Import ZArith Reals Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness SoupNumbers.
Open Scope R_scope.

Notation finite64 := (is_finite 53 1024) (only parsing).

(* ---- What the numbers hold ---- *)

Definition known (a : ball) (x : R) : Prop :=
  finite64 (middle a) = true /\ finite64 (error a) = true /\ 0 <= value64 (error a) /\ Rabs (x - value64 (middle a)) <= value64 (error a).

Lemma error_is_not_negative : forall a x, contains a x -> 0 <= value64 (error a).
Proof. intros a x [E|(_ & _ & E & _)]; [|exact E]. destruct (error a); try discriminate E; simpl; lra. Qed.

Lemma covers_error : forall a x, contains a x -> covers (known a x) 0 0 (error a) (value64 (error a)).
Proof.
  intros a x [E|K]; [now left|]. right. split; [exact K|]. destruct K as (_ & F & P & _). repeat split; [exact F|exact P|lra].
Qed.

Lemma covers_for : forall (P Q : Prop) k n l m e t, covers P k n e t -> (P -> finite64 e = true -> Q) -> k = l -> n = m ->
  covers Q l m e t.
Proof. intros P Q k n l m e t [E|(HP & F & N & E)] H <- <-; [now left|right]. split; [now apply H|now repeat split]. Qed.

Lemma covers_handed_on : forall a b x y, contains a x -> contains b y ->
  covers (known a x /\ known b y) 3 2 (handed_on a b)
    (Rabs (value64 (middle a)) * value64 (error b) +
      (Rabs (value64 (middle b)) + value64 (error b)) * value64 (error a)).
Proof.
  intros a b x y A B. pose proof (error_is_not_negative _ _ A) as Ea. pose proof (error_is_not_negative _ _ B) as Eb.
  pose proof (Rabs_pos (value64 (middle a))). pose proof (Rabs_pos (value64 (middle b))).
  pose proof (covers_product _ _ 0 0 0 _ _ _ _ (covers_absolute (middle a)) (covers_error b y B)) as C1.
  pose proof (covers_sum _ _ 0 0 0 0 0 0 _ _ _ _ (covers_absolute (middle b)) (covers_error b y B)) as C2.
  specialize (C1 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  specialize (C2 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (covers_product _ _ _ 0 1 _ _ _ _ C2 (covers_error a x A)) as C3.
  specialize (C3 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (covers_sum _ _ _ _ 1 1 2 2 _ _ _ _ C1 C3) as C4.
  apply covers_for with (1 := C4 ltac:(nra) ltac:(nra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)); try lra.
  intuition.
Qed.

(* What a bound has to cover of a rounded product: units of its result. *)
Lemma product_by_result : forall p, Rabs (nearest64 p - p) <= (1 + 2 * unit53) * unit53 * Rabs (nearest64 p) + 2 * eta.
Proof.
  intro p. pose proof (product_is_off p) as O. pose proof unit_is_small as U. pose proof eta_is_positive as H.
  assert (T : Rabs p <= Rabs (nearest64 p) + Rabs (nearest64 p - p)).
  { replace p with (nearest64 p - (nearest64 p - p)) at 1 by ring. unfold Rminus at 1. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite Rabs_Ropp. lra. }
  set (r := Rabs (nearest64 p)) in *. set (d := Rabs (nearest64 p - p)) in *. assert (0 <= r) by apply Rabs_pos.
  assert (unit53 * Rabs p <= unit53 * (r + d)) by (apply Rmult_le_compat_l; lra).
  assert (D : (1 - unit53) * d <= unit53 * r + eta) by lra.
  assert (0 <= unit53 * unit53 * r) by (repeat apply Rmult_le_pos; lra).
  assert (unit53 * (unit53 * unit53 * r) <= / 1000000000000 * (unit53 * unit53 * r)) by (apply Rmult_le_compat_r; lra).
  assert ((1 - unit53) * d <= (1 - unit53) * ((1 + 2 * unit53) * unit53 * r + 2 * eta)) by
    (assert (unit53 * eta <= / 1000000000000 * eta) by (apply Rmult_le_compat_r; lra); lra).
  apply Rmult_le_reg_l with (1 - unit53); lra.
Qed.
Lemma sum_by_result : forall a b, generic_format radix2 fexp64 a -> generic_format radix2 fexp64 b ->
  Rabs (nearest64 (a + b) - (a + b)) <= (1 + 2 * unit53) * unit53 * Rabs (nearest64 (a + b)).
Proof.
  intros a b Fa Fb. pose proof (sum_is_close a b Fa Fb) as O. pose proof unit_is_small as U. set (p := a + b) in *.
  assert (T : Rabs p <= Rabs (nearest64 p) + Rabs (nearest64 p - p)).
  { replace p with (nearest64 p - (nearest64 p - p)) at 1 by ring. unfold Rminus at 1. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite Rabs_Ropp. lra. }
  set (r := Rabs (nearest64 p)) in *. set (d := Rabs (nearest64 p - p)) in *. assert (0 <= r) by apply Rabs_pos.
  assert (unit53 * Rabs p <= unit53 * (r + d)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= unit53 * unit53 * r) by (repeat apply Rmult_le_pos; lra).
  assert (unit53 * (unit53 * unit53 * r) <= / 1000000000000 * (unit53 * unit53 * r)) by (apply Rmult_le_compat_r; lra).
  apply Rmult_le_reg_l with (1 - unit53); lra.
Qed.

Lemma bound_contains : forall P k n v e t x, covers P k n e t -> 0 <= t -> 0 <= k <= 20 -> 0 <= n <= 100 ->
  (P -> finite64 v = true /\ Rabs (x - value64 v) <= (1 + 8 * unit53) * t + 1000 * eta) ->
  contains (Ball v (plus (times slack e) least)) x.
Proof.
  intros P k n v e t x C T K N H. destruct (covers_bound _ _ _ _ _ C T K N) as [E|(HP & F & Z & E)]; [now left|].
  destruct (H HP) as [G D]. right. cbn [middle error]. repeat split; try assumption. lra.
Qed.

(* rounded(): its propagated error covers t, and the number is its middle, off by half a unit of it and t. *)
Lemma rounded_contains : forall P k n v e t x, covers P k n e t -> 0 <= t -> 0 <= k <= 10 -> 1 <= k -> 0 <= n <= 50 ->
  (P -> finite64 v = true -> Rabs (x - value64 v) <= t + (1 + 2 * unit53) * unit53 * Rabs (value64 v) + 2 * eta) ->
  contains (rounded v e) x.
Proof.
  intros P k n v e t x C T K K1 N H. pose proof unit_is_small as U. pose proof eta_is_positive as Eta.
  pose proof (Rabs_pos (value64 v)) as V.
  assert (U53 : is64 unit_of_ball unit53) by (replace unit53 with (bpow radix2 (-53)) by (unfold unit53; simpl; lra); apply two_to_is; lia).
  pose proof (covers_product _ _ 0 0 0 _ _ _ _ (covers_exactly _ _ U53 ltac:(lra)) (covers_absolute v)) as C1.
  specialize (C1 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (Uv : 0 <= unit53 * Rabs (value64 v)) by (apply Rmult_le_pos; lra).
  pose proof (covers_sum _ _ k _ n _ k (n + 1) _ _ _ _ C C1 T Uv) as C2.
  specialize (C2 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  unfold rounded. apply bound_contains with (1 := C2); try lra. intros (HP & _ & Fv). split; [exact Fv|].
  apply Rle_trans with (1 := H HP Fv). assert (0 <= unit53 * t) by (apply Rmult_le_pos; lra).
  assert (0 <= unit53 * (unit53 * Rabs (value64 v))) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma finite_sum : forall v w, finite64 v = true -> finite64 w = true -> finite64 (plus v w) = true ->
  value64 (plus v w) = nearest64 (value64 v + value64 w).
Proof. intros v w Fv Fw F. destruct (plus_gives v w Fv Fw) as [[_ V]|(s & E & _)]; [exact V|]. now rewrite E in F. Qed.
Lemma finite_product : forall v w, finite64 v = true -> finite64 w = true -> finite64 (times v w) = true ->
  value64 (times v w) = nearest64 (value64 v * value64 w).
Proof. intros v w Fv Fw F. destruct (times_gives v w Fv Fw) as [[_ V]|(s & E & _)]; [exact V|]. now rewrite E in F. Qed.
Lemma finite_difference : forall v w, finite64 v = true -> finite64 w = true -> finite64 (minus v w) = true ->
  value64 (minus v w) = nearest64 (value64 v - value64 w).
Proof.
  intros v w Fv Fw. unfold minus, b64_minus.
  match goal with |- context [Bminus _ _ ?p ?q ?nan _ _ _] => pose proof (Bminus_correct 53 1024 p q nan mode_NE v w Fv Fw) as C;
    set (sum := Bminus 53 1024 p q nan mode_NE v w) in * end.
  cbv zeta in C. intro F. destruct (Rlt_bool _ _) in C; [now destruct C|]. destruct C as [C _].
  unfold binary_overflow in C. cbn [overflow_to_inf] in C. destruct sum; try discriminate.
Qed.

Theorem exactly_contains : forall v, finite64 v = true -> contains (exactly v) (value64 v).
Proof.
  intros v F. right. cbn [exactly middle error]. repeat split; [exact F| |]; change (value64 zero64) with 0; [lra|].
  rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra.
Qed.

Theorem negated_contains : forall a x, contains a x -> contains (negated a) (- x).
Proof.
  intros a x [E|(F & G & P & D)]; [now left|right]. cbn [negated middle error]. destruct (opp_is (middle a) _ (conj eq_refl F)) as [V W].
  rewrite V. repeat split; try assumption. replace (- x - - value64 (middle a)) with (- (x - value64 (middle a))) by ring.
  now rewrite Rabs_Ropp.
Qed.

Lemma covers_both_errors : forall a b x y, contains a x -> contains b y ->
  covers (known a x /\ known b y) 1 0 (plus (error a) (error b)) (value64 (error a) + value64 (error b)).
Proof.
  intros a b x y A B. pose proof (error_is_not_negative _ _ A) as Ea. pose proof (error_is_not_negative _ _ B) as Eb.
  pose proof (covers_sum _ _ 0 0 0 0 0 0 _ _ _ _ (covers_error a x A) (covers_error b y B) Ea Eb) as C.
  specialize (C ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  apply covers_for with (1 := C); try lra. intuition.
Qed.

Theorem add_contains : forall a b x y, contains a x -> contains b y -> contains (add a b) (x + y).
Proof.
  intros a b x y A B. pose proof (error_is_not_negative _ _ A) as Ea. pose proof (error_is_not_negative _ _ B) as Eb.
  pose proof eta_is_positive as H. unfold add. apply rounded_contains with (1 := covers_both_errors a b x y A B); try lra.
  intros ((Fa & _ & _ & Da) & (Fb & _ & _ & Db)) F. pose proof (finite_sum _ _ Fa Fb F) as V.
  pose proof (sum_by_result _ _ (generic_format_B2R 53 1024 (middle a)) (generic_format_B2R 53 1024 (middle b))) as S.
  rewrite <- V in S. apply Rabs_le_inv in Da, Db. apply Rabs_le_inv in S. apply Rabs_le. lra.
Qed.

Theorem subtract_contains : forall a b x y, contains a x -> contains b y -> contains (subtract a b) (x - y).
Proof.
  intros a b x y A B. pose proof (error_is_not_negative _ _ A) as Ea. pose proof (error_is_not_negative _ _ B) as Eb.
  pose proof eta_is_positive as H. unfold subtract. apply rounded_contains with (1 := covers_both_errors a b x y A B); try lra.
  intros ((Fa & _ & _ & Da) & (Fb & _ & _ & Db)) F. pose proof (finite_difference _ _ Fa Fb F) as V.
  pose proof (sum_by_result _ _ (generic_format_B2R 53 1024 (middle a))
    (generic_format_opp _ _ _ (generic_format_B2R 53 1024 (middle b)))) as S. unfold Rminus in V.
  rewrite <- V in S. apply Rabs_le_inv in Da, Db. apply Rabs_le_inv in S. apply Rabs_le. lra.
Qed.

Definition handed (a b : ball) : R :=
  Rabs (value64 (middle a)) * value64 (error b) + (Rabs (value64 (middle b)) + value64 (error b)) * value64 (error a).

Lemma handed_is_not_negative : forall a b x y, contains a x -> contains b y -> 0 <= handed a b.
Proof.
  intros a b x y A B. pose proof (error_is_not_negative _ _ A) as Ea. pose proof (error_is_not_negative _ _ B) as Eb.
  pose proof (Rabs_pos (value64 (middle a))). pose proof (Rabs_pos (value64 (middle b))). unfold handed.
  apply Rplus_le_le_0_compat; apply Rmult_le_pos; lra.
Qed.

(* A product of the middles is off that of the numbers by what handed_on() says. *)
Lemma product_of_middles : forall a b x y, known a x -> known b y ->
  Rabs (x * y - value64 (middle a) * value64 (middle b)) <= handed a b.
Proof.
  intros a b x y (_ & _ & Ea & Da) (_ & _ & Eb & Db). unfold handed. set (m := value64 (middle a)) in *. set (n := value64 (middle b)) in *.
  replace (x * y - m * n) with (m * (y - n) + y * (x - m)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
  rewrite !Rabs_mult. apply Rplus_le_compat; apply Rmult_le_compat; try apply Rabs_pos; try lra.
  replace y with (n + (y - n)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Theorem multiply_contains : forall a b x y, contains a x -> contains b y -> contains (multiply a b) (x * y).
Proof.
  intros a b x y A B. pose proof (handed_is_not_negative _ _ _ _ A B) as T. unfold multiply.
  apply rounded_contains with (1 := covers_handed_on a b x y A B); fold (handed a b); try lra.
  intros (Ka & Kb) F. pose proof (product_of_middles _ _ _ _ Ka Kb) as D.
  pose proof (product_by_result (value64 (middle a) * value64 (middle b))) as S.
  destruct Ka as (Fa & _), Kb as (Fb & _). rewrite <- (finite_product _ _ Fa Fb F) in S.
  apply Rabs_le_inv in D. apply Rabs_le_inv in S. apply Rabs_le. lra.
Qed.

(* ---- Sums of products with one bound ---- *)

Lemma covers_finite : forall P k n e t, covers P k n e t -> covers (P /\ finite64 e = true) k n e t.
Proof. intros P k n e t C. now apply covers_for with (1 := C). Qed.

Lemma nearest_is_no_larger : forall a s, Rabs a <= s -> Rabs (nearest64 a) <= nearest64 s.
Proof.
  intros a s H. apply Rabs_le_inv in H. apply Rabs_le. split.
  - rewrite <- round_NE_opp. apply round_le; auto with typeclass_instances. lra.
  - apply round_le; auto with typeclass_instances. lra.
Qed.

(* What is no larger than a sum that is finite is finite. *)
Lemma sum_stays_finite : forall v w e f, finite64 v = true -> finite64 w = true -> finite64 e = true -> finite64 f = true ->
  Rabs (value64 v) <= value64 e -> Rabs (value64 w) <= value64 f -> finite64 (plus e f) = true ->
  (finite64 (plus v w) = true /\ Rabs (value64 (plus v w)) <= value64 (plus e f)) /\ finite64 (minus v w) = true.
Proof.
  intros v w e f Fv Fw Fe Ff Ev Ef F. pose proof (finite_sum _ _ Fe Ff F) as S.
  assert (M : value64 (plus e f) < bpow radix2 1024) by (apply Rle_lt_trans with (1 := Rle_abs _), abs_B2R_lt_emax).
  assert (A : Rabs (nearest64 (value64 v + value64 w)) <= value64 (plus e f)).
  { rewrite S. apply nearest_is_no_larger. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (B : Rabs (nearest64 (value64 v - value64 w)) <= value64 (plus e f)).
  { rewrite S. apply nearest_is_no_larger. unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  set (sum := value64 (plus e f)) in *. clearbody sum. split.
  - unfold plus, b64_plus.
    match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] => pose proof (Bplus_correct 53 1024 p q nan mode_NE v w Fv Fw) as C end.
    cbv zeta in C. rewrite Rlt_bool_true in C by exact (Rle_lt_trans _ _ _ A M). destruct C as (V & G & _). now rewrite V.
  - unfold minus, b64_minus.
    match goal with |- context [Bminus _ _ ?p ?q ?nan _ _ _] => pose proof (Bminus_correct 53 1024 p q nan mode_NE v w Fv Fw) as C end.
    cbv zeta in C. rewrite Rlt_bool_true in C by exact (Rle_lt_trans _ _ _ B M). now destruct C as (_ & G & _).
Qed.

Lemma units_is : forall n, (1 <= n <= 3)%Z -> is64 (units n) (IZR n * unit53).
Proof.
  intros n N. unfold units.
  pose proof (binary_normalize_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE n (-53) false) as C.
  replace (F2R (Float radix2 n (-53))) with (IZR n * unit53) in C by (unfold F2R, unit53; simpl; lra).
  assert (S : 1 <= IZR n <= 3) by (split; [now apply (IZR_le 1)|now apply (IZR_le n 3)]).
  pose proof unit_is_small as U.
  assert (Hsize : Rabs (IZR n * unit53) <= bpow radix2 1000).
  { rewrite Rabs_pos_eq by nra. apply Rle_trans with (bpow radix2 0); [simpl; nra|apply bpow_le; lia]. }
  operation C. destruct C as (C1 & C2 & _). split; [|exact C2]. rewrite C1. apply round_generic; auto with typeclass_instances.
  apply generic_format_FLT. exists (Float radix2 n (-53)); [unfold F2R, unit53; simpl; lra|simpl; lia|simpl; lia].
Qed.

(* A bound of the products' sizes, and of what their factors hand on. *)
Lemma covers_charged : forall P Q n k l m s h t u, (1 <= n <= 3)%Z -> covers P k 0 s t -> 0 <= t -> 0 <= k <= 2 ->
  covers Q l m h u -> 0 <= u -> 0 <= m <= 20 -> l = k + 4 ->
  covers ((P /\ finite64 s = true) /\ Q) (k + 5) (m + 1) (plus (times (units n) s) h) (IZR n * unit53 * t + u).
Proof.
  intros P Q n k l m s h t u N S T K C U M ->. pose proof unit_is_small as U53.
  assert (Sn : 1 <= IZR n <= 3) by (split; [now apply (IZR_le 1)|now apply (IZR_le n 3)]).
  pose proof (covers_product _ _ 0 k k _ _ _ _ (covers_exactly _ _ (units_is n N) ltac:(nra)) (covers_finite _ _ _ _ _ S)) as C1.
  specialize (C1 ltac:(nra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (Nt : 0 <= IZR n * unit53 * t) by (repeat apply Rmult_le_pos; lra).
  pose proof (covers_sum _ _ _ _ 1 m (k + 4) (m + 1) _ _ _ _ C1 C Nt U) as C2.
  specialize (C2 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  apply covers_for with (1 := C2); try lra. intuition.
Qed.

Theorem difference_of_products_contains : forall a b c d x y z w, contains a x -> contains b y -> contains c z -> contains d w ->
  contains (difference_of_products a b c d) (x * y - z * w).
Proof.
  intros a b c d x y z w A B C D. pose proof (handed_is_not_negative _ _ _ _ A B) as T1.
  pose proof (handed_is_not_negative _ _ _ _ C D) as T2. pose proof unit_is_small as U. pose proof eta_is_positive as Eta.
  unfold difference_of_products. cbv zeta. set (first := times (middle a) (middle b)). set (second := times (middle c) (middle d)).
  pose proof (Rabs_pos (value64 first)) as P1. pose proof (Rabs_pos (value64 second)) as P2.
  pose proof (covers_sum _ _ 0 0 0 0 0 0 _ _ _ _ (covers_absolute first) (covers_absolute second) P1 P2) as S.
  specialize (S ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (covers_sum _ _ 3 3 2 2 4 4 _ _ _ _ (covers_handed_on a b x y A B) (covers_handed_on c d z w C D) T1 T2) as H.
  specialize (H ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (covers_charged _ _ 2 (0 + 1) (4 + 1) 4 _ _ _ _ ltac:(lia) S ltac:(lra) ltac:(lra) H) as G.
  specialize (G (Rplus_le_le_0_compat _ _ T1 T2) ltac:(lra) ltac:(lra)). unfold bound_of_sum.
  fold (handed a b) (handed c d) in G.
  apply bound_contains with (1 := G); try lra.
  { apply Rplus_le_le_0_compat; [|lra]. repeat apply Rmult_le_pos; lra. }
  intros (((F1 & F2) & Fs) & (Ka & Kb) & Kc & Kd).
  destruct (absolute_is first _ (conj eq_refl F1)) as [V1 G1]. destruct (absolute_is second _ (conj eq_refl F2)) as [V2 G2].
  destruct (sum_stays_finite first second (absolute first) (absolute second)) as [_ Fm]; try assumption; try lra.
  split; [exact Fm|]. rewrite (finite_difference _ _ F1 F2 Fm).
  pose proof (product_of_middles _ _ _ _ Ka Kb) as M1. pose proof (product_of_middles _ _ _ _ Kc Kd) as M2.
  pose proof (product_by_result (value64 (middle a) * value64 (middle b))) as R1.
  pose proof (product_by_result (value64 (middle c) * value64 (middle d))) as R2.
  destruct Ka as (Fa & _), Kb as (Fb & _), Kc as (Fc & _), Kd as (Fd & _).
  rewrite <- (finite_product _ _ Fa Fb F1) in R1. rewrite <- (finite_product _ _ Fc Fd F2) in R2.
  fold first in R1. fold second in R2.
  pose proof (sum_is_close _ _ (generic_format_B2R 53 1024 first) (generic_format_opp _ _ _ (generic_format_B2R 53 1024 second))) as R3.
  fold (value64 first - value64 second) in R3.
  assert (R4 : Rabs (value64 first - value64 second) <= Rabs (value64 first) + Rabs (value64 second)).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  set (f := value64 first) in *. set (s := value64 second) in *. set (sizes := Rabs f + Rabs s) in *.
  assert (R5 : Rabs (nearest64 (f - s) - (f - s)) <= unit53 * sizes).
  { apply Rle_trans with (1 := R3). apply Rmult_le_compat_l; lra. }
  assert (Q1 : 0 <= unit53 * unit53 * sizes) by (repeat apply Rmult_le_pos; unfold sizes; lra).
  assert (Q2 : (1 + 2 * unit53) * unit53 * Rabs f + (1 + 2 * unit53) * unit53 * Rabs s = unit53 * sizes + 2 * (unit53 * unit53 * sizes))
    by (unfold sizes; ring).
  assert (Q3 : 0 <= unit53 * (handed a b + handed c d)) by (apply Rmult_le_pos; lra).
  apply Rabs_le_inv in M1, M2. apply Rabs_le_inv in R1. apply Rabs_le_inv in R2. apply Rabs_le_inv in R5. apply Rabs_le. lra.
Qed.

Theorem dot_contains : forall a b c d e f x y z w p q, contains a x -> contains b y -> contains c z -> contains d w -> contains e p ->
  contains f q -> contains (dot_of a b c d e f) (x * y + z * w + p * q).
Proof.
  intros a b c d e f x y z w p q A B C D E F. pose proof (handed_is_not_negative _ _ _ _ A B) as T1.
  pose proof (handed_is_not_negative _ _ _ _ C D) as T2. pose proof (handed_is_not_negative _ _ _ _ E F) as T3.
  pose proof unit_is_small as U. pose proof eta_is_positive as Eta.
  unfold dot_of. cbv zeta. set (first := times (middle a) (middle b)). set (second := times (middle c) (middle d)).
  set (third := times (middle e) (middle f)).
  pose proof (Rabs_pos (value64 first)) as P1. pose proof (Rabs_pos (value64 second)) as P2. pose proof (Rabs_pos (value64 third)) as P3.
  pose proof (covers_sum _ _ 0 0 0 0 0 0 _ _ _ _ (covers_absolute first) (covers_absolute second) P1 P2) as S.
  specialize (S ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)). apply covers_finite in S.
  pose proof (covers_sum _ _ (0 + 1) 0 0 0 1 0 _ _ _ _ S (covers_absolute third) ltac:(lra) P3) as S3.
  specialize (S3 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (covers_sum _ _ 3 3 2 2 4 4 _ _ _ _ (covers_handed_on a b x y A B) (covers_handed_on c d z w C D) T1 T2) as H.
  specialize (H ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (covers_sum _ _ (4 + 1) 3 4 2 5 6 _ _ _ _ H (covers_handed_on e f p q E F) (Rplus_le_le_0_compat _ _ T1 T2) T3) as H3.
  specialize (H3 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  apply covers_for with (Q := (known a x /\ known b y) /\ (known c z /\ known d w) /\ known e p /\ known f q) (l := 5 + 1) (m := 6)
    in H3; [|intuition|lra|lra].
  pose proof (covers_charged _ _ 3 (1 + 1) (5 + 1) 6 _ _ _ _ ltac:(lia) S3 ltac:(lra) ltac:(lra) H3) as G.
  specialize (G (Rplus_le_le_0_compat _ _ (Rplus_le_le_0_compat _ _ T1 T2) T3) ltac:(lra) ltac:(lra)). unfold bound_of_sum.
  fold (handed a b) (handed c d) (handed e f) in G.
  apply bound_contains with (1 := G); try lra.
  { apply Rplus_le_le_0_compat; [|lra]. repeat apply Rmult_le_pos; lra. }
  intros (((((F1 & F2) & Fs) & F3) & Ft) & (Ka & Kb) & (Kc & Kd) & Ke & Kf).
  destruct (absolute_is first _ (conj eq_refl F1)) as [V1 G1]. destruct (absolute_is second _ (conj eq_refl F2)) as [V2 G2].
  destruct (absolute_is third _ (conj eq_refl F3)) as [V3 G3].
  destruct (sum_stays_finite first second (absolute first) (absolute second)) as [[Fm Bm] _]; try assumption; try lra.
  destruct (sum_stays_finite (plus first second) third (plus (absolute first) (absolute second)) (absolute third)) as [[Fn _] _];
    try assumption; try lra.
  split; [exact Fn|]. rewrite (finite_sum _ _ Fm F3 Fn).
  pose proof (product_of_middles _ _ _ _ Ka Kb) as M1. pose proof (product_of_middles _ _ _ _ Kc Kd) as M2.
  pose proof (product_of_middles _ _ _ _ Ke Kf) as M3.
  pose proof (product_by_result (value64 (middle a) * value64 (middle b))) as R1.
  pose proof (product_by_result (value64 (middle c) * value64 (middle d))) as R2.
  pose proof (product_by_result (value64 (middle e) * value64 (middle f))) as R3.
  destruct Ka as (Fa & _), Kb as (Fb & _), Kc as (Fc & _), Kd as (Fd & _), Ke as (Fe & _), Kf as (Ff & _).
  rewrite <- (finite_product _ _ Fa Fb F1) in R1. rewrite <- (finite_product _ _ Fc Fd F2) in R2.
  rewrite <- (finite_product _ _ Fe Ff F3) in R3. fold first in R1. fold second in R2. fold third in R3.
  pose proof (sum_is_close _ _ (generic_format_B2R 53 1024 first) (generic_format_B2R 53 1024 second)) as R4.
  rewrite <- (finite_sum _ _ F1 F2 Fm) in R4.
  pose proof (sum_is_close _ _ (generic_format_B2R 53 1024 (plus first second)) (generic_format_B2R 53 1024 third)) as R5.
  set (g := value64 first) in *. set (h := value64 second) in *. set (l := value64 third) in *. set (m := value64 (plus first second)) in *.
  pose proof (Rabs_triang g h) as I1. pose proof (Rabs_triang m l) as I2.
  assert (I3 : Rabs m <= Rabs (g + h) + Rabs (m - (g + h))).
  { replace m with (g + h + (m - (g + h))) at 1 by ring. apply Rabs_triang. }
  set (two := Rabs g + Rabs h) in *. assert (Two : 0 <= two) by (unfold two; lra).
  assert (R6 : Rabs (m - (g + h)) <= unit53 * two) by (apply Rle_trans with (1 := R4); apply Rmult_le_compat_l; lra).
  assert (R7 : Rabs (nearest64 (m + l) - (m + l)) <= unit53 * (two + unit53 * two + Rabs l)).
  { apply Rle_trans with (1 := R5). apply Rmult_le_compat_l; lra. }
  assert (Q1 : 0 <= unit53 * unit53 * two) by (repeat apply Rmult_le_pos; lra).
  assert (Q2 : 0 <= unit53 * unit53 * Rabs l) by (repeat apply Rmult_le_pos; lra).
  assert (Q3 : (1 + 2 * unit53) * unit53 * Rabs g + (1 + 2 * unit53) * unit53 * Rabs h = unit53 * two + 2 * (unit53 * unit53 * two))
    by (unfold two; ring).
  assert (Q4 : 0 <= unit53 * (handed a b + handed c d + handed e f)) by (apply Rmult_le_pos; lra).
  assert (Q5 : 0 <= unit53 * two) by (apply Rmult_le_pos; lra). assert (Q6 : 0 <= unit53 * Rabs l) by (apply Rmult_le_pos; lra).
  apply Rabs_le_inv in M1, M2, M3. apply Rabs_le_inv in R1. apply Rabs_le_inv in R2. apply Rabs_le_inv in R3.
  apply Rabs_le_inv in R6. apply Rabs_le_inv in R7. apply Rabs_le. lra.
Qed.
