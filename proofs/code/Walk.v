(* SPDX-License-Identifier: BSD-3-Clause *)
(* The batch calls of fast/law.cpp, for any form of a law and any call of it: a block together, or in steps of sixteen, or one by one. *)
From Coq Require Import ZArith List Bool Arith.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Lanes.
Import ListNotations.

(* ---- answer_all ---- *)

Section Walk.
Context {state : Type} (together : nat -> nat -> state -> bool * state) (single : nat -> state -> state).

Definition singles (first count : nat) (s : state) : state := fold_left (fun s i => single i s) (seq first count) s.

(* Its loop over steps, `fuel` times at most. *)
Fixpoint steps (fuel done whole last : nat) (s : state) : state :=
  match fuel with
  | O => s
  | S fuel =>
      if done <? last then
        let step := Nat.min last (done + 16) in
        let (answered, s) := if done <? whole then together done 16 s else (false, s) in
        steps fuel step whole last (if answered then s else singles done (step - done) s)
      else s
  end.

Definition block (begin last : nat) (s : state) : state :=
  let whole := last - (last - begin) mod 16 in
  let (answered, s) := if begin <? whole then together begin (whole - begin) s else (false, s) in
  steps (last - begin) (if answered then whole else begin) whole last s.

Fixpoint blocks (fuel begin count : nat) (s : state) : state :=
  match fuel with
  | O => s
  | S fuel => if begin <? count then blocks fuel (begin + 512) count (block begin (Nat.min count (begin + 512)) s) else s
  end.

Definition answer_all (count : nat) (s : state) : state := blocks count 0 count s.
End Walk.

(* ---- The two calls ---- *)

(* Arrays by their number, each of them of numbers or of rows, and the count of invalid positions. Two spans that begin at one address are
   one array; others do not overlap. *)
Record state (A : Type) := { memory : nat -> nat -> A; invalid_count : nat }.
Arguments memory {A}.
Arguments invalid_count {A}.

Definition write {A : Type} (array begin : nat) (values : list A) (m : nat -> nat -> A) : nat -> nat -> A := fun a i =>
  if (a =? array) && (begin <=? i) then nth (i - begin) values (m a i) else m a i.
Definition with_invalid (status : Status) (count : nat) : nat := match status with invalid => S count | _ => count end.

Section Calls.
(* None: scalar calls alone. *)
Context (set : option instruction_set) (form : binary32 -> binary32 -> Lane) (one : binary32 -> binary32 -> binary32 -> evaluation).

Section Columns.
Context (x z fx fz : nat).
Definition is_in_place : bool := (fx =? x) || (fx =? z) || (fz =? x) || (fz =? z).

(* In place, a block is kept until it is known whether it holds. *)
Definition together_columns (begin size : nat) (s : state binary32) : bool * state binary32 :=
  match set with
  | None => (false, s)
  | Some set =>
      let lanes := map (fun i => form (memory s x i) (memory s z i)) (seq begin size) in
      let answered := forallb (is_free set) lanes in
      (answered,
       if is_in_place && negb answered then s
       else {| memory := write fz begin (map force_z lanes) (write fx begin (map force_x lanes) (memory s)); invalid_count :=
         invalid_count s |})
  end.
Definition single_column (i : nat) (s : state binary32) : state binary32 :=
  let (status, force) := one (memory s x i) zero32 (memory s z i) in
  let '(a, _, b) := force in
  {| memory := write fz i [b] (write fx i [a] (memory s)); invalid_count := with_invalid status (invalid_count s) |}.
Definition force_of_columns (count : nat) (arrays : nat -> nat -> binary32) : state binary32 :=
  answer_all together_columns single_column count {| memory := arrays; invalid_count := 0 |}.
End Columns.

Section Rows.
Context (positions forces : nat).
Definition row : Type := binary32 * binary32 * binary32.
Definition y_of (r : row) : binary32 := let '(_, y, _) := r in y.
Definition lane_of (r : row) : Lane := let '(x, _, z) := r in form x z.

Definition together_rows (begin size : nat) (s : state row) : bool * state row :=
  match set with
  | None => (false, s)
  | Some set =>
      let rows := map (memory s positions) (seq begin size) in
      let lanes := map lane_of rows in
      let answered := forallb (fun r => negb (is_large (absolute32 (y_of r)))) rows && forallb (is_free set) lanes in
      (answered,
       if answered then {| memory := write forces begin (map (fun lane => (force_x lane, zero32, force_z lane)) lanes) (memory s);
                           invalid_count := invalid_count s |}
       else s)
  end.
Definition single_row (i : nat) (s : state row) : state row :=
  let '(x, y, z) := memory s positions i in
  let (status, force) := one x y z in
  {| memory := write forces i [force] (memory s); invalid_count := with_invalid status (invalid_count s) |}.
Definition force_of_rows (count : nat) (arrays : nat -> nat -> row) : state row :=
  answer_all together_rows single_row count {| memory := arrays; invalid_count := 0 |}.
End Rows.
End Calls.

(* ---- What is to be shown of them ---- *)

Definition is_invalid (answer : evaluation) : bool := match fst answer with invalid => true | _ => false end.
Definition count_invalid (answers : nat -> evaluation) (count : nat) : nat := length (filter (fun i => is_invalid (answers i)) (seq 0
  count)).

(* Every force is that of the call of one position, invalid positions are counted, and nothing else is written. *)
Definition batches_agree (form : binary32 -> binary32 -> Lane) (one : binary32 -> binary32 -> binary32 -> evaluation) : Prop :=
  forall (set : option instruction_set) (count : nat),
  (forall (x z fx fz : nat) (arrays : nat -> nat -> binary32), fx <> fz ->
    let after := force_of_columns set form one x z fx fz count arrays in
    let answer i := one (arrays x i) zero32 (arrays z i) in
    (forall i, i < count -> exists y, snd (answer i) = (memory after fx i, y, memory after fz i)) /\
    (forall a i, count <= i \/ a <> fx /\ a <> fz -> memory after a i = arrays a i) /\
    invalid_count after = count_invalid answer count) /\
  (forall (positions forces : nat) (arrays : nat -> nat -> row),
    let after := force_of_rows set form one positions forces count arrays in
    let answer i := let '(x, y, z) := arrays positions i in one x y z in
    (forall i, i < count -> memory after forces i = snd (answer i)) /\
    (forall a i, count <= i \/ a <> forces -> memory after a i = arrays a i) /\
    invalid_count after = count_invalid answer count).
