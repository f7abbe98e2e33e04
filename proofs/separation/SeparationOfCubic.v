(* SPDX-License-Identifier: BSD-3-Clause *)
(* How near a number can come to 0 that is made of a root of a cubic and of square roots: the lemma of docs/proofs.md, "The last
   stage", for the degrees 3, 6 and 12. *)
From Coq Require Import ZArith Reals Lia Lra.
From Flocq Require Import Core.
From Forceshade Require Import Separation.
Open Scope R_scope.

(* ---- Polynomials of a root ---- *)

(* The roots of r^3 = p r + q, and a number W that none of them exceeds in size. 2^29 r is an algebraic integer. *)
Record cubic (W p q r1 r2 r3 : R) : Prop := {
  cubic_W : multiple 29 W;
  cubic_p : multiple 58 p;
  cubic_q : multiple 87 q;
  cubic_sum : r1 + r2 + r3 = 0;
  cubic_pairs : r1 * r2 + r1 * r3 + r2 * r3 = - p;
  cubic_product : r1 * r2 * r3 = q;
  cubic_sizes : Rabs r1 <= W /\ Rabs r2 <= W /\ Rabs r3 <= W
}.

(* f is a + b r + c r^2 at every root, and 2^k f is an algebraic integer. *)
Definition integral (p q : R) (k : Z) (f : R -> R) : Prop :=
  exists a b c, multiple k a /\ multiple (k - 29) b /\ multiple (k - 58) c /\
    forall r, r * r * r = p * r + q -> f r = a + b * r + c * (r * r).

Ltac finer := eapply multiple_finer; [multiple_of_parts|lia].

Lemma integral_finer : forall p q k m f, integral p q k f -> (k <= m)%Z -> integral p q m f.
Proof.
  intros p q k m f (a & b & c & Ha & Hb & Hc & H) L. exists a, b, c.
  split; [|split; [|split; [|exact H]]]; eapply multiple_finer; eauto; lia.
Qed.

Lemma integral_constant : forall p q k a, multiple k a -> integral p q k (fun _ => a).
Proof.
  intros p q k a Ha. exists a, 0, 0. assert (zero : forall i, multiple i 0) by (intro i; exists 0%Z; ring).
  split; [exact Ha|split; [apply zero|split; [apply zero|]]]. intros. ring.
Qed.

Lemma integral_root : forall p q, integral p q 29 (fun r => r).
Proof.
  intros p q. exists 0, 1, 0. assert (zero : forall i, multiple i 0) by (intro i; exists 0%Z; ring).
  split; [apply zero|split; [apply (multiple_whole 1)|split; [apply zero|]]]. intros. ring.
Qed.

Lemma integral_plus : forall p q k m f g, integral p q k f -> integral p q m g -> integral p q (Z.max k m) (fun r => f r + g r).
Proof.
  intros p q k m f g (a & b & c & Ha & Hb & Hc & H) (a' & b' & c' & Ha' & Hb' & Hc' & H'). exists (a + a'), (b + b'), (c + c').
  split; [finer|split; [finer|split; [finer|]]]. intros r Hr. rewrite (H r Hr), (H' r Hr). ring.
Qed.

Lemma integral_opp : forall p q k f, integral p q k f -> integral p q k (fun r => - f r).
Proof.
  intros p q k f (a & b & c & Ha & Hb & Hc & H). exists (- a), (- b), (- c).
  split; [finer|split; [finer|split; [finer|]]]. intros r Hr. rewrite (H r Hr). ring.
Qed.

Lemma integral_minus : forall p q k m f g, integral p q k f -> integral p q m g -> integral p q (Z.max k m) (fun r => f r - g r).
Proof. intros p q k m f g Hf Hg. apply (integral_plus p q k m f (fun r => - g r) Hf). now apply integral_opp. Qed.

Lemma integral_times : forall p q k m f g, multiple 58 p -> multiple 87 q -> integral p q k f -> integral p q m g ->
  integral p q (k + m) (fun r => f r * g r).
Proof.
  intros p q k m f g Hp Hq (a & b & c & Ha & Hb & Hc & H) (a' & b' & c' & Ha' & Hb' & Hc' & H').
  exists (a * a' + (b * c' + c * b') * q), (a * b' + b * a' + (b * c' + c * b') * p + c * c' * q),
    (a * c' + b * b' + c * a' + c * c' * p).
  split; [finer|split; [finer|split; [finer|]]]. intros r Hr. rewrite (H r Hr), (H' r Hr).
  replace ((a + b * r + c * (r * r)) * (a' + b' * r + c' * (r * r))) with
    (a * a' + (a * b' + b * a') * r + (a * c' + b * b' + c * a') * (r * r) + (b * c' + c * b') * (r * r * r)
      + c * c' * (r * r * r) * r) by ring.
  rewrite Hr. ring.
Qed.

(* The exponent follows from those of the parts, which are hypotheses. *)
Ltac integral_of_parts :=
  lazymatch goal with
  | |- integral _ _ _ (fun r => @?f r * @?g r) => eapply (integral_times _ _ _ _ f g); [eassumption|eassumption|integral_of_parts|
      integral_of_parts]
  | |- integral _ _ _ (fun r => @?f r + @?g r) => eapply (integral_plus _ _ _ _ f g); integral_of_parts
  | |- integral _ _ _ (fun r => @?f r - @?g r) => eapply (integral_minus _ _ _ _ f g); integral_of_parts
  | |- integral _ _ _ (fun r => - @?f r) => eapply (integral_opp _ _ _ f); integral_of_parts
  | |- integral _ _ _ _ => first [eassumption|apply integral_root|eapply integral_constant; multiple_of_parts]
  end.
Ltac integral := eapply integral_finer; [integral_of_parts|lia].

(* ---- Sizes ---- *)

(* If the product with a number up to 2^j is not small, neither is the other factor. *)
Lemma other_factor : forall x y n j, bpow radix2 n <= Rabs (x * y) -> Rabs y <= bpow radix2 j -> bpow radix2 (n - j) <= Rabs x.
Proof.
  intros x y n j H Hy. pose proof (bpow_gt_0 radix2 j) as P. apply Rmult_le_reg_r with (bpow radix2 j); [exact P|].
  rewrite <- bpow_plus. replace (n - j + j)%Z with n by ring. rewrite Rabs_mult in H. apply Rle_trans with (1 := H).
  apply Rmult_le_compat_l; [apply Rabs_pos|exact Hy].
Qed.

Lemma product_in_bpow : forall x y i j, Rabs x <= bpow radix2 i -> Rabs y <= bpow radix2 j -> Rabs (x * y) <= bpow radix2 (i + j).
Proof. intros x y i j Hx Hy. rewrite Rabs_mult, bpow_plus. apply Rmult_le_compat; try apply Rabs_pos; assumption. Qed.

Lemma half_of_sum : forall a t C, Rabs (a + t) <= C -> Rabs (a - t) <= C -> Rabs a <= C.
Proof. intros a t C H1 H2. apply Rabs_le_inv in H1. apply Rabs_le_inv in H2. apply Rabs_le. lra. Qed.

(* ---- The lemma ---- *)

Lemma root_is : forall W p q r1 r2 r3, cubic W p q r1 r2 r3 ->
  r1 * r1 * r1 = p * r1 + q /\ r2 * r2 * r2 = p * r2 + q /\ r3 * r3 * r3 = p * r3 + q.
Proof.
  intros W p q r1 r2 r3 [_ _ _ H1 H2 H3 _]. assert (E3 : r3 = - r1 - r2) by lra. assert (Ep : p = - (r1 * r2 + r1 * r3 + r2 * r3)) by lra.
  rewrite Ep, <- H3, E3. repeat split; ring.
Qed.

(* Degree 3. Where a conjugate is 0, the sum of the conjugates or that of their products in pairs takes the place of their product. *)
Lemma separation_of_degree_3 : forall W p q r1 r2 r3 k j f, cubic W p q r1 r2 r3 -> integral p q k f -> (- k <= j)%Z ->
  Rabs (f r2) <= bpow radix2 j -> Rabs (f r3) <= bpow radix2 j -> f r1 <> 0 -> bpow radix2 (- (3 * k + 2 * j)) <= Rabs (f r1).
Proof.
  intros W p q r1 r2 r3 k j f HW (a & b & c & Ha & Hb & Hc & H) Hj H2 H3 Hne. destruct (root_is _ _ _ _ _ _ HW) as (R1 & R2 & R3).
  destruct HW as [_ Mp Mq S1 S2 S3 _]. apply H in R1, R2, R3.
  assert (E3 : r3 = - r1 - r2) by lra. assert (Ep : p = - (r1 * r2 + r1 * r3 + r2 * r3)) by lra.
  assert (N1 : multiple k (f r1 + f r2 + f r3)).
  { replace (f r1 + f r2 + f r3) with (3 * a + 2 * p * c) by (rewrite R1, R2, R3, Ep, E3; ring). finer. }
  assert (N2 : multiple (2 * k) (f r1 * f r2 + f r1 * f r3 + f r2 * f r3)).
  { replace (f r1 * f r2 + f r1 * f r3 + f r2 * f r3) with (3 * (a * a) + 4 * (a * p * c) + p * p * c * c - p * b * b - 3 * (b * c * q))
      by (rewrite R1, R2, R3, <- S3, Ep, E3; ring). finer. }
  assert (N3 : multiple (3 * k) (f r1 * (f r2 * f r3))).
  { replace (f r1 * (f r2 * f r3)) with (a * a * a + 2 * p * c * a * a + a * (p * p * c * c - p * b * b - 3 * (b * c * q))
      + q * (b * b * b - p * b * c * c + q * c * c * c)) by (rewrite R1, R2, R3, <- S3, Ep, E3; ring). finer. }
  clear R1 R2 R3 H. set (x := f r1) in *. set (y := f r2) in *. set (z := f r3) in *. clearbody x y z.
  assert (two : forall t, Rabs t <= bpow radix2 j -> x * t <> 0 -> multiple (2 * k) (x * t) -> bpow radix2 (- (3 * k + 2 * j)) <= Rabs x).
  { intros t Ht Hn M. apply Rle_trans with (bpow radix2 (- (2 * k) - j)); [apply bpow_le; lia|].
    apply (other_factor x t); [now apply multiple_not_0|exact Ht]. }
  destruct (Req_dec y 0) as [Hy|Hy]; destruct (Req_dec z 0) as [Hz|Hz].
  - rewrite Hy, Hz, !Rplus_0_r in N1. apply Rle_trans with (bpow radix2 (- k)); [apply bpow_le; lia|now apply multiple_not_0].
  - apply (two z H3); [now apply Rmult_integral_contrapositive|]. rewrite Hy in N2. replace (x * z) with (x * 0 + x * z + 0 * z) by ring.
    exact N2.
  - apply (two y H2); [now apply Rmult_integral_contrapositive|]. rewrite Hz in N2. replace (x * y) with (x * y + x * 0 + y * 0) by ring.
    exact N2.
  - replace (- (3 * k + 2 * j))%Z with (- (3 * k) - (j + j))%Z by ring. apply (other_factor x (y * z)); [|now apply product_in_bpow].
    apply multiple_not_0; [exact N3|]. repeat apply Rmult_integral_contrapositive_currified; assumption.
Qed.

(* A + B e, where e^2 = W^2 - r^2. Where its conjugate A - B e is 0, A^2 takes the place of the product of the two. *)
Lemma separation_of_degree_6 : forall W p q r1 r2 r3 e k j A B, cubic W p q r1 r2 r3 -> integral p q k A -> integral p q (k - 29) B ->
  (- k <= j)%Z -> (forall r y, r * r + y * y = W * W -> Rabs (A r + B r * y) <= bpow radix2 j) -> r1 * r1 + e * e = W * W ->
  A r1 + B r1 * e <> 0 -> bpow radix2 (- (6 * k + 5 * j)) <= Rabs (A r1 + B r1 * e).
Proof.
  intros W p q r1 r2 r3 e k j A B HW HA HB Hj Size He Hne. pose proof HW as [MW Mp Mq _ _ _ (B1 & B2 & B3)].
  assert (both : forall r y, r * r + y * y = W * W -> Rabs (A r + B r * y) <= bpow radix2 j /\ Rabs (A r - B r * y) <= bpow radix2 j).
  { intros r y Hr. split; [now apply Size|]. replace (A r - B r * y) with (A r + B r * - y) by ring. apply Size. lra. }
  assert (root : forall r, Rabs r <= W -> exists y, r * r + y * y = W * W).
  { intros r Hr. exists (sqrt (W * W - r * r)). rewrite sqrt_sqrt; [ring|].
    assert (Rabs r * Rabs r <= W * W) by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    pose proof (Rsqr_abs r) as S. unfold Rsqr in S. lra. }
  assert (N : exists f, integral p q (2 * k) f /\ f r1 <> 0 /\ Rabs (f r1) <= Rabs (A r1 + B r1 * e) * bpow radix2 j /\
    (forall r y, r * r + y * y = W * W -> Rabs (f r) <= bpow radix2 (2 * j))).
  { destruct (both r1 e He) as [Hp Hm]. destruct (Req_dec (A r1 - B r1 * e) 0) as [H0|H0].
    - exists (fun r => A r * A r). split; [integral|]. assert (HA1 : A r1 <> 0) by lra.
      split; [now apply Rmult_integral_contrapositive|]. split.
      + rewrite Rabs_mult. replace (A r1 + B r1 * e) with (2 * A r1) in * by lra. rewrite Rabs_mult, (Rabs_pos_eq 2) in * by lra.
        pose proof (Rabs_pos (A r1)) as P. apply Rmult_le_compat; lra.
      + intros r y Hr. destruct (both r y Hr) as [S1 S2]. replace (2 * j)%Z with (j + j)%Z by ring.
        apply product_in_bpow; now apply half_of_sum with (B r * y).
    - exists (fun r => A r * A r - B r * B r * (W * W - r * r)). split; [integral|].
      assert (G : forall r y, r * r + y * y = W * W -> A r * A r - B r * B r * (W * W - r * r) = (A r + B r * y) * (A r - B r * y)).
      { intros r y Hr. replace (W * W - r * r) with (y * y) by lra. ring. }
      split; [rewrite (G r1 e He); now apply Rmult_integral_contrapositive|]. split.
      + rewrite (G r1 e He), Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|exact Hm].
      + intros r y Hr. destruct (both r y Hr) as [S1 S2]. rewrite (G r y Hr). replace (2 * j)%Z with (j + j)%Z by ring.
        now apply product_in_bpow. }
  destruct N as (f & Hf & Hf1 & Hle & Sf). destruct (root r2 B2) as [y2 Y2]. destruct (root r3 B3) as [y3 Y3].
  pose proof (separation_of_degree_3 W p q r1 r2 r3 (2 * k) (2 * j) f HW Hf ltac:(lia) (Sf r2 y2 Y2) (Sf r3 y3 Y3) Hf1) as H.
  replace (- (6 * k + 5 * j))%Z with (- (3 * (2 * k) + 2 * (2 * j)) - j)%Z by ring.
  apply (other_factor _ (bpow radix2 j)); [|rewrite Rabs_pos_eq by apply bpow_ge_0; apply Rle_refl].
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 j)) by apply bpow_ge_0. now apply Rle_trans with (1 := H).
Qed.

(* G + (A + B e) s, where s^2 is rational. *)
Lemma separation_of_degree_12 : forall W p q r1 r2 r3 e s S k j G A B, cubic W p q r1 r2 r3 -> multiple 106 S -> s * s = S ->
  integral p q k G -> integral p q (k - 53) A -> integral p q (k - 82) B -> (- k <= j)%Z ->
  (forall r y t, r * r + y * y = W * W -> t * t = S -> Rabs (G r + (A r + B r * y) * t) <= bpow radix2 j) -> r1 * r1 + e * e = W * W ->
  G r1 + (A r1 + B r1 * e) * s <> 0 -> bpow radix2 (- (12 * k + 11 * j)) <= Rabs (G r1 + (A r1 + B r1 * e) * s).
Proof.
  intros W p q r1 r2 r3 e s S k j G A B HW MS Hs HG HA HB Hj Size He Hne. pose proof HW as [MW Mp Mq _ _ _ _].
  assert (both : forall r y, r * r + y * y = W * W -> Rabs (G r + (A r + B r * y) * s) <= bpow radix2 j /\
    Rabs (G r - (A r + B r * y) * s) <= bpow radix2 j).
  { intros r y Hr. split; [now apply Size|]. replace (G r - (A r + B r * y) * s) with (G r + (A r + B r * y) * - s) by ring.
    apply Size; [exact Hr|]. lra. }
  set (g := G r1 + (A r1 + B r1 * e) * s) in *.
  assert (N : exists A' B', integral p q (2 * k) A' /\ integral p q (2 * k - 29) B' /\ A' r1 + B' r1 * e <> 0 /\
    Rabs (A' r1 + B' r1 * e) <= Rabs g * bpow radix2 j /\
    (forall r y, r * r + y * y = W * W -> Rabs (A' r + B' r * y) <= bpow radix2 (2 * j))).
  { destruct (both r1 e He) as [Hp Hm]. fold g in Hp. destruct (Req_dec (G r1 - (A r1 + B r1 * e) * s) 0) as [H0|H0].
    - exists (fun r => G r * G r), (fun _ => 0). split; [integral|]. split; [eapply integral_constant; exists 0%Z; ring|].
      assert (Eg : g = 2 * G r1) by (unfold g; lra). assert (HG1 : G r1 <> 0) by lra. rewrite Rmult_0_l, Rplus_0_r.
      split; [now apply Rmult_integral_contrapositive|]. split.
      + rewrite Eg in *. rewrite Rabs_mult in *. rewrite Rabs_mult. rewrite (Rabs_pos_eq 2) in * by lra.
        pose proof (Rabs_pos (G r1)) as P. apply Rmult_le_compat; lra.
      + intros r y Hr. destruct (both r y Hr) as [S1 S2]. replace (2 * j)%Z with (j + j)%Z by ring. rewrite Rmult_0_l, Rplus_0_r.
        apply product_in_bpow; now apply half_of_sum with ((A r + B r * y) * s).
    - exists (fun r => G r * G r - S * (A r * A r + B r * B r * (W * W - r * r))), (fun r => - (2 * S * A r * B r)).
      split; [integral|]. split; [integral|].
      assert (E : forall r y, r * r + y * y = W * W -> G r * G r - S * (A r * A r + B r * B r * (W * W - r * r)) +
        - (2 * S * A r * B r) * y = (G r + (A r + B r * y) * s) * (G r - (A r + B r * y) * s)).
      { intros r y Hr. replace (W * W - r * r) with (y * y) by lra. rewrite <- Hs. ring. }
      split; [rewrite (E r1 e He); now apply Rmult_integral_contrapositive|]. split.
      + rewrite (E r1 e He), Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|exact Hm].
      + intros r y Hr. destruct (both r y Hr) as [S1 S2]. rewrite (E r y Hr). replace (2 * j)%Z with (j + j)%Z by ring.
        now apply product_in_bpow. }
  destruct N as (A' & B' & HA' & HB' & Hne' & Hle & Size').
  pose proof (separation_of_degree_6 W p q r1 r2 r3 e (2 * k) (2 * j) A' B' HW HA' HB' ltac:(lia) Size' He Hne') as H.
  replace (- (12 * k + 11 * j))%Z with (- (6 * (2 * k) + 5 * (2 * j)) - j)%Z by ring.
  apply (other_factor _ (bpow radix2 j)); [|rewrite Rabs_pos_eq by apply bpow_ge_0; apply Rle_refl].
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 j)) by apply bpow_ge_0. now apply Rle_trans with (1 := H).
Qed.
