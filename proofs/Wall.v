(* SPDX-License-Identifier: BSD-3-Clause *)
(* The laws wall and bump-1p, whole: fast/laws/wall.h under evaluate() of fast/evaluate.h. Their first stage is never in doubt. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core Operations BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons RoundingTest.
Open Scope R_scope.

(* ---- Products ---- *)

Theorem product_is_exact : forall a b : binary32, generic_format radix2 fexp64 (value32 a * value32 b).
Proof.
  assert (parts : forall a : binary32, exists m e : Z, value32 a = F2R (Float radix2 m e) /\ (Z.abs m < 2 ^ 24)%Z /\ (-149 <= e)%Z).
  { intro a. pose proof (generic_format_B2R 24 128 a) as G. apply FLT_format_generic in G; [|reflexivity].
    destruct G as [[m e] H1 H2 H3]. now exists m, e. }
  intros a b. destruct (parts a) as (m & e & -> & Hm & He), (parts b) as (n & g & -> & Hn & Hg). rewrite <- F2R_mult.
  apply generic_format_FLT. exists (Float radix2 (m * n) (e + g)); [reflexivity| |].
  - cbn [Fnum]. rewrite Z.abs_mul. change (2 ^ 24)%Z with 16777216%Z in *. change (Zpower radix2 53) with 9007199254740992%Z. nia.
  - cbn [Fexp]. lia.
Qed.

(* ---- The law as the code has it ---- *)

Definition larger (a b : binary64) : binary64 := if is_less b a then a else b.
Definition first_stage_z (K : binary32) (z : binary64) : binary64 := larger (b64_mult mode_NE (b64_opp (to64 K)) z) zero64.

Inductive Status := free | contact | invalid.
Definition evaluation : Type := Status * (binary32 * binary32 * binary32).
Definition no_force (status : Status) : evaluation := (status, (zero32, zero32, zero32)).

(* doubt_window(0) is 0, so that in_doubt answers no. *)
Definition evaluate (K x y z : binary32) : evaluation :=
  if negb (in_domain x && in_domain y && in_domain z) then no_force invalid
  else
    let Z := to64 (quantised z) in
    let first_x := zero64 in
    let first_z := first_stage_z K Z in
    if negb (is_less Z zero64) then no_force free
    else if negb (in_doubt 0 (bits_of_b64 first_x)) && negb (in_doubt 0 (bits_of_b64 first_z))
    then (contact, (returned first_x, zero32, returned first_z))
    else no_force invalid.

(* ---- The theorem ---- *)

(* docs/laws.md: F = -K z in the direction of z where z < 0. x, y and z are any bits, K any number of its domain. *)
Theorem wall_is_correctly_rounded : forall K x y z : binary32,
  is_finite 24 128 K = true -> / 1000 <= value32 K <= 1000 ->
  let Z := read (value32 z) in
  (in_domain x && in_domain y && in_domain z = false -> evaluate K x y z = no_force invalid) /\
  (in_domain x && in_domain y && in_domain z = true -> 0 <= Z -> evaluate K x y z = no_force free) /\
  (in_domain x && in_domain y && in_domain z = true -> Z < 0 ->
     exists F, evaluate K x y z = (contact, (zero32, zero32, F)) /\ is_nearest32 F (- value32 K * Z)).
Proof.
  intros K x y z HK RK Z. unfold evaluate.
  destruct (in_domain x && in_domain y && in_domain z) eqn:Hdomain; (split; [|split]); try discriminate; try reflexivity.
  all: intros _ Hsign; cbn [negb].
  all: apply andb_prop in Hdomain; destruct Hdomain as [_ Hz]; apply in_domain_is_right in Hz; destruct Hz as [Fz Rz].
  all: destruct (quantised_is_right z Fz) as [Q1 Q2]; destruct (to64_is_exact _ Q2) as [Z1 Z2]; rewrite Q1 in Z1; fold Z in Q1, Z1.
  all: rewrite is_less_is_right by (assumption || reflexivity); rewrite Z1; change (value64 zero64) with 0.
  { now rewrite Rlt_bool_false by lra. }
  rewrite Rlt_bool_true by lra. cbn [negb]. destruct (to64_is_exact K HK) as [K1 K2].
  set (product := b64_mult mode_NE (b64_opp (to64 K)) (to64 (quantised z))).
  assert (Hsize : 0 < - value32 K * Z <= 10000000).
  { pose proof (size_of_read (value32 z)) as Hread. fold Z in Hread. rewrite (Rabs_left Z) in Hread by lra.
    replace (- value32 K * Z) with (value32 K * - Z) by ring. split; [apply Rmult_lt_0_compat; lra|].
    replace 10000000 with (1000 * 10000) by ring. apply Rmult_le_compat; lra. }
  assert (Hproduct : value64 product = - value32 K * Z /\ is_finite 53 1024 product = true).
  { unfold product, b64_mult.
    match goal with |- context [Bmult _ _ ?a ?b ?nan _ _ _] =>
      pose proof (Bmult_correct 53 1024 a b nan mode_NE (b64_opp (to64 K)) (to64 (quantised z))) as C end.
    unfold b64_opp in *. rewrite B2R_Bopp, is_finite_Bopp, K1, K2, Z1, Z2 in C.
    change (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE)) with nearest64 in C.
    rewrite (round_generic radix2 fexp64 ZnearestE (- value32 K * Z)) in C.
    2: { replace (- value32 K * Z) with (- (value32 K * Z)) by ring. apply generic_format_opp. rewrite <- Q1. apply product_is_exact. }
    rewrite Rlt_bool_true in C; [destruct C as (C1 & C2 & _); now split|].
    rewrite Rabs_pos_eq by lra. apply Rle_lt_trans with (bpow radix2 24); [simpl; lra|now apply bpow_lt]. }
  destruct Hproduct as [P1 P2].
  assert (Hlarger : first_stage_z K (to64 (quantised z)) = product).
  { unfold first_stage_z, larger. fold product. rewrite is_less_is_right by (assumption || reflexivity).
    change (value64 zero64) with 0. now rewrite P1, Rlt_bool_true by lra. }
  rewrite Hlarger. exists (returned product). split; [reflexivity|]. rewrite <- P1. apply returned_is_nearest; [assumption|].
  rewrite P1, Rabs_pos_eq by lra. apply Rle_lt_trans with (bpow radix2 24); [simpl; lra|now apply bpow_lt].
Qed.
