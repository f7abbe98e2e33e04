(* SPDX-License-Identifier: BSD-3-Clause *)
(* Double-double, the rounding test, the edge of a top, the search for the nearest number and Newton's method: the definitions of which
  the
   theorems speak are what a program wrote down from the headers (proofs/recorded/RecordedStages.v). *)
From Coq Require Import ZArith List Bool Lia.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded RoundingTest Evaluate Inputs Depth Split DoubleDoubleHolds
  NewtonRounded NewtonThird ExactSign TopEdge Acceptance BesideTie SecondStage SecondAlong ShadedAlong Shaded.
From Forceshade Require Import CylinderConstants TwoPolygonsConstants TwoPolygonsGap ThreePolygonsConstants ThreePolygonsGap.
From Forceshade Require Import ThreePolygonsRight CylinderSecondParts CylinderSecondBorder CylinderSecondForce CylinderSecond.
From Forceshade Require Import BumpCylinder Bump1pShaded Bump2p Bump2pShaded Bump3p Bump3pShaded.
From Forceshade Require Import BigFloatSearch ThirdStages Code Balls RecordedStages.
Import ListNotations.

(* Constants in two forms. *)
Lemma same_number : forall a b : binary64, B2FF 53 1024 a = B2FF 53 1024 b -> a = b.
Proof. exact (B2FF_inj 53 1024). Qed.
Lemma two_is : whole 2 = two_to 1.
Proof. now apply same_number. Qed.
Lemma eight_is : whole 8 = two_to 3.
Proof. now apply same_number. Qed.

(* ---- Double-double ---- *)

Ltac same_terms := cbv [sum_dd difference_dd product_dd quotient_dd root_dd add multiply divide root_of rounded error_of negated two_sum
  fast_two_sum sum_of product_of quotient_of square_root_of fst snd hi lo error].
Lemma sum_is_recorded : forall a b, sum_dd a b = add a b.
Proof. intros a b. same_terms. reflexivity. Qed.
Lemma difference_is_recorded : forall a b, difference_dd a b = add a (negated b).
Proof. intros a b. same_terms. reflexivity. Qed.
Lemma product_is_recorded : forall a b, product_dd a b = multiply a b.
Proof. intros a b. same_terms. reflexivity. Qed.
Lemma quotient_is_recorded : forall a b, quotient_dd a b = divide a b.
Proof. intros a b. same_terms. reflexivity. Qed.
Lemma root_is_recorded : forall a, root_dd a = root_of a.
Proof.
  intros [h l e]. same_terms. destruct (is_equal h zero64), (is_equal e zero64); reflexivity.
Qed.
Lemma sign_is_recorded : forall a, sign_dd a = BesideTie.sign_of a.
Proof.
  intro a. unfold sign_dd, BesideTie.sign_of. cbv zeta.
  destruct (is_equal (hi a) zero64), (is_equal (error a) zero64); reflexivity.
Qed.
Lemma rest_is_recorded : forall a v, exactly_dd v = exactly64 v /\ minus_dd a = negated a /\ midpoint_dd a = NewtonThird.midpoint a /\
  truncated_dd a = NewtonThird.midpoint a /\ widened_dd a = NewtonThird.widened a /\ approximation_dd a = hi a.
Proof. intros a v. repeat split. Qed.

(* ---- The domain, the rounding test and the edge of the top ---- *)

Lemma domain_is_recorded : forall x, in_domain_recorded x = in_domain x /\ quantised_recorded x = quantised x.
Proof. now split. Qed.

Lemma operations_are_recorded : forall (yes : bool) a b c, larger_recorded a b = larger a b /\
  select_recorded yes a b = (if yes then a else b) /\ absolute_recorded a = absolute a /\
  square_root_recorded a = Operations.square_root a /\ multiply_add_recorded a b c = multiply_add false a b c /\
  multiply_subtract_recorded a b c = multiply_subtract false a b c.
Proof. intros yes a b c. repeat match goal with |- _ /\ _ => split end; reflexivity. Qed.

Lemma doubt_is_recorded : forall v, in_doubt_0 v = in_doubt 0 (bits_of_b64 v) /\ in_doubt_9 v = in_doubt 9 (bits_of_b64 v) /\
  in_doubt_13 v = in_doubt 13 (bits_of_b64 v) /\ in_doubt_19 v = in_doubt 19 (bits_of_b64 v).
Proof. intro v. repeat split. Qed.

Lemma grown : forall t x rest s low, two_sum t x = (s, low) -> grow t (x :: rest) = low :: grow s rest.
Proof. intros t x rest s low E. now injection E as <- <-. Qed.
Lemma grown_last : forall t, grow t [] = [t].
Proof. reflexivity. Qed.
Lemma expanded : forall t terms e, fold_left (fun e t => grow t e) (t :: terms) e = fold_left (fun e t => grow t e) terms (grow t e).
Proof. reflexivity. Qed.
Lemma expanded_all : forall e, fold_left (fun e t => grow t e) [] e = e.
Proof. reflexivity. Qed.

(* Names every sum, so that no term grows. *)
Ltac name_sums := repeat (match goal with
  | |- (let x := fst (?u, _) in @?f x) = ?r => change (f u = r)
  | |- (let x := snd (_, ?u) in @?f x) = ?r => change (f u = r)
  | |- (let x := two_sum ?a ?b in @?f x) = ?r => change (f (two_sum a b) = r); destruct (two_sum a b) eqn:?
  | |- (let x := (?u, ?v) in @?f x) = ?r => change (f (u, v) = r)
  end; cbv beta).
Lemma exact_sign_is_recorded : forall a b c d e f g h, exact_sign_recorded a b c d e f g h = exact_sign [a; b; c; d; e; f; g; h].
Proof.
  intros a b c d e f g h. cbv delta [exact_sign_recorded]. cbv beta. name_sums. cbv zeta. cbn [fst snd]. rewrite !if_negb.
  unfold exact_sign, expansion. rewrite expanded, grown_last.
  repeat (rewrite expanded || rewrite expanded_all || rewrite grown_last ||
    match goal with H : two_sum ?t ?x = _ |- context [grow ?t (?x :: ?rest)] => rewrite (grown _ _ rest _ _ H) end).
  reflexivity.
Qed.

Lemma top_test : forall (A : Type) n (yes no : A), match Z.compare n 0 with Lt => no | Eq => yes | Gt => yes end =
  if (0 <=? n)%Z then yes else no.
Proof. now intros A [|n|n] yes no. Qed.
Lemma if_both : forall (A : Type) (a b : bool) (yes no : A), (if a then if b then yes else no else no) = if a && b then yes else no.
Proof. now intros A [|] b yes no. Qed.

Lemma on_top_is_recorded : forall c R w, is_on_top_recorded c R w = is_on_top32 c R w.
Proof.
  intros c R w. unfold is_on_top_recorded, is_on_top32. rewrite top_test, if_both.
  match goal with |- (if ?b then true else false) = _ => transitivity b; [now destruct b|reflexivity] end.
Qed.

Lemma top_terms_are : forall c R w, let v := to64 c in let r := to64 R in let square := times r r in
  is_at_most (times (whole 2) v) r &&
  (0 <=? exact_sign [times (whole 4) (fused (times v v) v (opp (times (times v v) v))); times (whole 4) (times (times v v) v);
    times (whole (-2)) (fused square v (opp (times square v))); opp (fused square v (opp (times square v)));
    times (whole (-2)) (times square v); opp (times square v);
    fused square (times (two_to (-1)) (to64 w)) (opp (times square (times (two_to (-1)) (to64 w))));
    times square (times (two_to (-1)) (to64 w))])%Z = is_on_top32 c R w.
Proof. reflexivity. Qed.

Lemma largest_on_top_is_recorded : forall R w half_top, largest_on_top_recorded R w half_top = largest_on_top R w half_top.
Proof.
  intros R w half_top. unfold largest_on_top_recorded. rewrite !top_test, !if_both.
  pose proof top_terms_are as T. cbv zeta in T. rewrite !T. clear T.
  unfold largest_on_top, step_up, step_down. set (c := to32 (hi half_top)).
  repeat match goal with
    | E : is_on_top32 ?c R w = _ |- context [is_on_top32 ?c R w] => rewrite E
    | |- context [is_on_top32 ?c R w] => lazymatch c with context [is_on_top32] => fail | _ => destruct (is_on_top32 c R w) eqn:? end
    end; reflexivity.
Qed.

(* ---- The nearest number of binary32 ---- *)

Lemma even_is : forall c, (Z.land (bits_of_b32 c) 1 =? 0)%Z = is_even c.
Proof.
  intro c. unfold is_even. change 1%Z with (Z.ones 1) at 1. rewrite Z.land_ones by lia. change (2 ^ 1)%Z with 2%Z. rewrite Zmod_even.
  now destruct (Z.even (bits_of_b32 c)).
Qed.

(* The search of round_to_binary32, by signs. *)
Definition step_by (up down : Sign) (even : bool) (above below here : option binary32) : option binary32 :=
  if is_same up is_unknown || is_same down is_unknown then None
  else if is_same up is_positive || is_same up is_zero && negb even then above
  else if is_same down is_negative || is_same down is_zero && negb even then below
  else here.
Fixpoint nearest_by (beside : binary64 -> Sign) (steps : nat) (c : binary32) : option binary32 :=
  match steps with
  | O => None
  | S rest =>
    step_by (beside (times (two_to (-1)) (plus (to64 c) (to64 (next_above c)))))
      (beside (times (two_to (-1)) (plus (to64 c) (to64 (next_below c))))) (is_even c)
      (nearest_by beside rest (next_above c)) (nearest_by beside rest (next_below c)) (Some (b32_plus mode_NE c zero32))
  end.
Definition beside {number} (N : ball number) (value : number) (tie : binary64) : Sign :=
  sign_in N (sum_in N value (minus_in N (exactly_in N tie))).

(* Names each part of the tree that is the search from a candidate. *)
Ltac name_searches N value := repeat (match goal with |- (let x := ?v in @?f x) = ?r =>
  lazymatch v with
  | match sign_in _ (sum_in _ _ (minus_in _ (exactly_in _ (times _ (plus (to64 ?c) (to64 (next_above ?c))))))) with
      is_negative => _ | is_zero => _ | is_positive => _ | is_unknown => _ end =>
    let steps := lazymatch c with ?f (?g (to32 _)) => constr:(1%nat) | ?f (to32 _) => constr:(2%nat) | _ => constr:(3%nat) end in
    transitivity (f (nearest_by (beside N value) steps c)); [apply (f_equal f); rewrite !even_is; cbn [nearest_by]; unfold beside;
      match goal with |- _ = step_by (sign_in N ?a) (sign_in N ?b) _ _ _ _ => destruct (sign_in N a), (sign_in N b) end;
      destruct (is_even c); reflexivity|]
  | _ => change (f v = r)
  end end; cbv beta).
Lemma nearest_is_recorded : forall {number} (N : ball number) value,
  nearest_recorded N value = nearest_by (beside N value) 3 (to32 (approximation_in N value)).
Proof.
  intros number N value. cbv delta [nearest_recorded]. cbv beta. name_searches N value.
reflexivity.
Qed.

Lemma second_nearest_is_recorded : forall value, nearest_recorded two_terms value = rounded_to_binary32 value.
Proof.
  intro value. rewrite nearest_is_recorded. unfold rounded_to_binary32. cbn [approximation_in two_terms].
  generalize (to32 (hi value)). generalize 3%nat. intro steps. induction steps as [|steps IH]; intro c; [reflexivity|].
  cbn [nearest_by rounded_from]. rewrite !IH. unfold step_by, beside, sign_beside, tie_of.
  cbn [two_terms sign_in sum_in minus_in exactly_in]. reflexivity.
Qed.

Lemma third_nearest_is_recorded : forall {number} (A : arithmetic number) value,
  nearest_recorded (of_arithmetic A) value = Third.rounded A value.
Proof.
  intros number A value. rewrite nearest_is_recorded. unfold Third.rounded. cbn [approximation_in of_arithmetic].
  generalize (to32 (approximation A value)). generalize 3%nat. intro steps. induction steps as [|steps IH]; intro c; [reflexivity|].
  cbn [nearest_by search]. rewrite !IH. unfold step_by, beside, tie_of.
  cbn [of_arithmetic sign_in sum_in minus_in exactly_in].
  generalize (search (fun tie => ThirdStages.sign_of A (sum A value (opposite A (from_binary64 A tie)))) steps).
  intro next. destruct (ThirdStages.sign_of A _), (ThirdStages.sign_of A _), (is_even c); reflexivity.
Qed.

(* Conversion leaves the operations of numbers as they are. *)
Strategy 1000 [plus minus times over opp absolute fused Operations.square_root to64 to32 constant two_to whole is_at_most is_equal
  is_less].

(* ---- Newton's method ---- *)

Lemma second_newton_is_recorded : forall value slope start,
  newton_root_by_1 two_terms value slope start = NewtonThird.newton_root value slope start.
Proof. reflexivity. Qed.
Lemma third_newton_is_recorded : forall {number} (A : arithmetic number) value slope start,
  newton_root_by_7 (of_arithmetic A) value slope start = Third.newton_root A value slope start.
Proof. reflexivity. Qed.

Section Sine.
Context {number : Type} (N : ball number) (newton : (number -> number) -> (number -> number) -> binary64 -> number).
Local Notation "a + b" := (sum_in N a b). Local Notation "a * b" := (product_in N a b). Local Notation "a / b" := (quotient_in N a b).
Local Notation "a - b" := (sum_in N a (minus_in N b)). Local Notation of64 := (exactly_in N). Local Notation of_whole n := (of64 (whole
  n)).
Definition sine_in (R w : binary32) : number :=
  if is_at_most (half_over_radius R w) (two_to (-1)) then
    newton (fun y => (of_whole 4 * y * y - of_whole 3) * y + of64 (half_width w) / of64 (to64 R)) (fun y => of_whole 12 * y * y -
      of_whole 3)
      (third_start R w)
  else if is_equal (half_width w) (to64 R) then of64 (two_to (-1))
  else of64 (two_to (-1)) -
    newton (fun y => (of_whole 6 - of_whole 4 * y) * y * y - of64 (minus (to64 R) (half_width w)) / of64 (to64 R))
      (fun y => of_whole 12 * y * (of_whole 1 - y)) (rest_start R w).
End Sine.

Lemma sine_is_recorded : forall {number} (N : ball number) R w,
  sine_of_third_by_1 N R w = sine_in N (newton_root_by_1 N) R w.
Proof. intros number N R w. reflexivity. Qed.
Lemma sine_is_recorded7 : forall {number} (N : ball number) R w,
  sine_of_third_by_7 N R w = sine_in N (newton_root_by_7 N) R w.
Proof. intros number N R w. reflexivity. Qed.

Lemma second_sine_is_recorded : forall R w, sine_of_third_by_1 two_terms R w = NewtonThird.sine_of_third R w.
Proof.
  intros R w. rewrite sine_is_recorded. cbv delta [sine_in NewtonThird.sine_of_third]. cbv beta.
  generalize (third_start R w) (rest_start R w). intros third rest.
  destruct (is_at_most (half_over_radius R w) (two_to (-1))); [now rewrite second_newton_is_recorded|].
  destruct (is_equal (half_width w) (to64 R)); [reflexivity|now rewrite second_newton_is_recorded].
Qed.
Lemma third_sine_is_recorded : forall {number} (A : arithmetic number) R w,
  sine_of_third_by_7 (of_arithmetic A) R w = Third.sine_of_third A R w.
Proof.
  intros number A R w. rewrite sine_is_recorded7. cbv delta [sine_in Third.sine_of_third]. cbv beta.
  generalize (third_start R w) (rest_start R w). intros third rest.
  destruct (is_at_most (half_over_radius R w) (two_to (-1))); [now rewrite third_newton_is_recorded|].
  destruct (is_equal (half_width w) (to64 R)); [reflexivity|now rewrite third_newton_is_recorded].
Qed.
