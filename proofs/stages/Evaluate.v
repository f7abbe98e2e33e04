(* SPDX-License-Identifier: BSD-3-Clause *)
(* evaluate() of fast/evaluate.h, for any first stage and any later stages. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations RoundingTest Computed.
Open Scope R_scope.

Definition valid (x y z : binary32) : bool := in_domain x && in_domain y && in_domain z.

Definition evaluate (window : Z) (first_stage : binary64 -> binary64 -> FirstStage) (later : binary32 -> binary32 -> evaluation)
    (x y z : binary32) : evaluation :=
  if negb (valid x y z) then no_force invalid
  else
    let first := first_stage (to64 (quantised x)) (to64 (quantised z)) in
    if first_doubt first then later (quantised x) (quantised z)
    else if negb (first_contact first) then no_force free
    else if negb (in_doubt window (bits_of_b64 (first_x first))) && negb (in_doubt window (bits_of_b64 (first_z first)))
    then (contact, (returned (first_x first), zero32, returned (first_z first)))
    else later (quantised x) (quantised z).

(* Not in doubt, the first stage decides contact, and its components are k units off at most. *)
Definition is_right (k : Z) (first : FirstStage) (touches : Prop) (Fx Fz : R) : Prop :=
  first_doubt first = false ->
  (first_contact first = true <-> touches) /\ (touches -> good k (first_x first) Fx /\ good k (first_z first) Fz).

(* The answer is that of later stages, or it is right. *)
Definition right_or_later (answer later : evaluation) (touches : Prop) (Fx Fz : R) : Prop :=
  answer = later \/ (~ touches /\ answer = no_force free) \/
  (touches /\ exists fx fz, answer = (contact, (fx, zero32, fz)) /\ is_nearest32 fx Fx /\ is_nearest32 fz Fz).

Lemma invalid_has_no_force : forall window first_stage later x y z, valid x y z = false ->
  evaluate window first_stage later x y z = no_force invalid.
Proof. intros window first_stage later x y z H. unfold evaluate. now rewrite H. Qed.

Lemma valid_is_right : forall x y z, valid x y z = true <-> in_range x /\ in_range y /\ in_range z.
Proof. intros x y z. unfold valid. rewrite !andb_true_iff, !in_domain_is_right. tauto. Qed.

(* Right in every valid position, answers are right in every position (proofs/spec/Laws.v). *)
Theorem right_everywhere : forall window first_stage later (law : R -> R -> exact_force) x y z,
  (valid x y z = true ->
    let exact := law (read (value32 x)) (read (value32 z)) in
    is_answer (evaluate window first_stage later x y z) (in_contact exact) (exact_x exact) (exact_z exact)) ->
  right_answer (evaluate window first_stage later x y z) law x y z.
Proof.
  intros window first_stage later law x y z H. split; intro Hrange; [now apply H, valid_is_right|].
  apply invalid_has_no_force. apply not_true_is_false. now rewrite valid_is_right.
Qed.
Arguments right_everywhere {window first_stage later law x y z} & _.

Theorem right_first_stage_gives_right_answers : forall k first_stage later x y z touches Fx Fz, (0 < k <= 2 ^ 20)%Z ->
  valid x y z = true -> is_right k (first_stage (to64 (quantised x)) (to64 (quantised z))) touches Fx Fz ->
  right_or_later (evaluate (k + 1) first_stage later x y z) (later (quantised x) (quantised z)) touches Fx Fz.
Proof.
  intros k first_stage later x y z touches Fx Fz Hk Hvalid H. unfold evaluate, right_or_later. rewrite Hvalid. cbn [negb].
  set (first := first_stage _ _) in *. cbv zeta. unfold is_right in H. destruct (first_doubt first) eqn:Hdoubt; [now left|].
  destruct (H eq_refl) as [Hcontact Hgood]. destruct (first_contact first) eqn:Htouch; cbn [negb].
  2: { right. left. split; [|reflexivity]. intro T. now apply Hcontact in T. }
  assert (T : touches) by now apply Hcontact. destruct (Hgood T) as [(X1 & X2 & X3 & X4) (Z1 & Z2 & Z3 & Z4)].
  destruct (in_doubt (k + 1) (bits_of_b64 (first_x first))) eqn:Dx; [now left|].
  destruct (in_doubt (k + 1) (bits_of_b64 (first_z first))) eqn:Dz; [now left|].
  right. right. split; [assumption|]. exists (returned (first_x first)), (returned (first_z first)). split; [reflexivity|].
  split; apply (first_stage_returns_the_nearest k); assumption.
Qed.
