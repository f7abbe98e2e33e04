(* SPDX-License-Identifier: BSD-3-Clause *)
(* The domain and quantum of positions: fast/domain.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats.
Open Scope R_scope.

(* a <= b of C++, which is false where one of the two is a NaN. *)
Definition is_at_most32 (a b : binary32) : bool := match Bcompare 24 128 a b with Some Lt | Some Eq => true | _ => false end.

Lemma is_at_most32_is_right : forall a b, is_finite 24 128 a = true -> is_finite 24 128 b = true ->
  is_at_most32 a b = Rle_bool (value32 a) (value32 b).
Proof.
  intros a b Ha Hb. unfold is_at_most32. rewrite Bcompare_correct by assumption. unfold Rle_bool.
  destruct (Rcompare (value32 a) (value32 b)); reflexivity.
Qed.

(* ---- The domain and the quantum ---- *)

Definition ten_thousand : binary32 := B754_finite 24 128 false 10240000 (-10) eq_refl.  (* 1e4F *)
Definition quantum : binary32 := B754_finite 24 128 false 8388608 (-53) eq_refl.         (* 0x1p-30F *)

Lemma value_of_ten_thousand : value32 ten_thousand = 10000.
Proof. unfold ten_thousand, B2R, F2R. simpl. lra. Qed.
Lemma value_of_quantum : value32 quantum = bpow radix2 (-30).
Proof. unfold quantum, B2R, F2R. simpl. lra. Qed.

Definition in_domain (x : binary32) : bool := is_at_most32 (b32_abs x) ten_thousand.
Definition quantised (x : binary32) : binary32 := if is_at_most32 quantum (b32_abs x) then x else zero32.

Lemma in_domain_is_right : forall x, in_domain x = true <-> in_range x.
Proof.
  intro x. unfold in_domain, in_range. destruct (is_finite 24 128 x) eqn:Hx.
  - unfold b32_abs. rewrite is_at_most32_is_right; [|now rewrite is_finite_Babs|reflexivity].
    rewrite B2R_Babs, value_of_ten_thousand. case Rle_bool_spec; intro H; split; intro G.
    + split; [reflexivity|assumption].
    + reflexivity.
    + discriminate.
    + lra.
  - split; [|intros [G _]; discriminate]. destruct x as [s|s|s pl H|s m e H]; try discriminate.
Qed.

Lemma quantised_is_right : forall x, is_finite 24 128 x = true ->
  value32 (quantised x) = read (value32 x) /\ is_finite 24 128 (quantised x) = true.
Proof.
  intros x Hx. unfold quantised, read, b32_abs.
  rewrite is_at_most32_is_right; [|reflexivity|now rewrite is_finite_Babs].
  rewrite B2R_Babs, value_of_quantum. destruct (Rle_bool (bpow radix2 (-30)) (Rabs (value32 x))); now split.
Qed.

Lemma size_of_read : forall x, Rabs (read x) <= Rabs x.
Proof. intro x. unfold read. destruct (Rle_bool _ _); [lra|]. rewrite Rabs_R0. apply Rabs_pos. Qed.
