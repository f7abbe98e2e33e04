(* SPDX-License-Identifier: BSD-3-Clause *)
(* A batch stores what single calls answer, however blocks and ends of arrays are walked, in place or not. *)
From Coq Require Import ZArith Reals List Bool Arith Lia Lra.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Evaluate Lanes LaneAnswers BumpLanes Walk.
Import ListNotations.
Open Scope nat_scope.

(* ---- The walk, for anything that holds of what is done so far ---- *)

Section Kept.
Context {state : Type} (together : nat -> nat -> state -> bool * state) (single : nat -> state -> state) (count : nat).
Context (holds : nat -> state -> Prop).
Context (together_keeps : forall i n s, holds i s -> i + n <= count -> let (answered, after) := together i n s in
  holds (if answered : bool then i + n else i) after).
Context (single_keeps : forall i s, holds i s -> i < count -> holds (S i) (single i s)).

Lemma singles_keep : forall n i s, holds i s -> i + n <= count -> holds (i + n) (singles single i n s).
Proof.
  induction n as [|n IH]; intros i s H L; [now rewrite Nat.add_0_r|]. replace (i + S n) with (S i + n) by lia. apply (IH (S i)); [|lia].
  apply single_keeps; [exact H|lia].
Qed.

Lemma steps_keep : forall fuel done whole last s, holds done s -> done <= last <= count -> whole <= last -> last - done <= fuel ->
  (whole <= done \/ exists k, whole = done + 16 * k) -> holds last (steps together single fuel done whole last s).
Proof.
  induction fuel as [|fuel IH]; intros done whole last s H L W F K; cbn [steps].
  - now replace last with done by lia.
  - destruct (Nat.ltb_spec done last) as [D|D]; [|now replace last with done by lia].
    set (step := Nat.min last (done + 16)). assert (Hs : done < step <= last) by (unfold step; lia).
    assert (K2 : whole <= step \/ exists k, whole = step + 16 * k).
    { destruct K as [K|[[|k] K]]; [left; lia|left; lia|]. right. exists k. unfold step. lia. }
    assert (R : forall s', holds done s' -> holds step (singles single done (step - done) s')).
    { intros s' H'. replace step with (done + (step - done)) at 1 by lia. apply singles_keep; [exact H'|lia]. }
    destruct (Nat.ltb_spec done whole) as [E|E].
    + pose proof (together_keeps done 16 s H) as T. destruct (together done 16 s) as [answered after].
      assert (B : done + 16 <= last) by (destruct K as [K|[[|k] K]]; lia). specialize (T ltac:(lia)).
      apply IH; try lia; try assumption. destruct answered; [|now apply R]. now replace step with (done + 16) by (unfold step; lia).
    + apply IH; try lia; try assumption. now apply R.
Qed.

Lemma block_keeps : forall begin last s, holds begin s -> begin <= last <= count -> holds last (block together single begin last s).
Proof.
  intros begin last s H L. unfold block. pose proof (Nat.div_mod (last - begin) 16 ltac:(lia)) as D.
  pose proof (Nat.mod_upper_bound (last - begin) 16 ltac:(lia)) as U. set (m := (last - begin) mod 16) in *. set (k := (last - begin) /
    16) in *.
  assert (EW : last - m = begin + 16 * k) by lia. rewrite EW. destruct (Nat.ltb_spec begin (begin + 16 * k)) as [B|B].
  - pose proof (together_keeps begin (begin + 16 * k - begin) s H ltac:(lia)) as T.
    destruct (together begin (begin + 16 * k - begin) s) as [answered after]. replace (begin + (begin + 16 * k - begin)) with (begin + 16
      * k) in T by lia.
    destruct answered; apply steps_keep; try assumption; try lia. right. now exists k.
  - apply steps_keep; try assumption; lia.
Qed.

Lemma blocks_keep : forall fuel begin s, holds begin s -> begin <= count -> count - begin <= fuel ->
  holds count (blocks together single fuel begin count s).
Proof.
  induction fuel as [|fuel IH]; intros begin s H L F; cbn [blocks]; [now replace count with begin by lia|].
  destruct (Nat.ltb_spec begin count) as [B|B]; [|now replace count with begin by lia].
  destruct (Nat.le_gt_cases (begin + 512) count) as [C|C].
  - apply IH; try lia. rewrite Nat.min_r by lia. apply block_keeps; [exact H|lia].
  - rewrite Nat.min_l by lia. assert (HB : holds count (block together single begin count s)) by (apply block_keeps; [exact H|lia]).
    destruct fuel; [exact HB|]. cbn [blocks]. now rewrite (proj2 (Nat.ltb_ge (begin + 512) count)) by lia.
Qed.

Theorem answer_all_keeps : forall s, holds 0 s -> holds count (answer_all together single count s).
Proof. intros s H. apply blocks_keep; [exact H|lia|lia]. Qed.
End Kept.

(* ---- A lane that the watch lets pass is what the single call answers ---- *)

Open Scope R_scope.

Lemma nearest_is_one : forall a b E, is_nearest32 a E -> is_nearest32 b E -> a = b.
Proof.
  intros a b E (Va & Fa & Za) (Vb & Fb & Zb). destruct (Req_dec (nearest32 E) 0) as [H|H]; [now rewrite Za, Zb|].
  apply B2R_inj; [| |now rewrite Va, Vb].
  - destruct a; try discriminate; [now rewrite <- Va in H|reflexivity].
  - destruct b; try discriminate; [now rewrite <- Vb in H|reflexivity].
Qed.

Lemma lane_is_answer : forall set lane law x y z answer, right_where_free set lane law x z -> right_answer answer law x y z ->
  is_free set lane = true -> in_range y -> snd answer = (force_x lane, zero32, force_z lane) /\ is_invalid answer = false.
Proof.
  intros set lane law x y z answer Hl [Ha _] F Hy. destruct (Hl F) as (Hx & Hz & In & Out). specialize (Ha (conj Hx (conj Hy Hz))).
  destruct Ha as [[N ->]|(T & fx & fz & -> & Nx & Nz)].
  - destruct (Out N) as [-> ->]. now split.
  - destruct (In T) as [Ix Iz]. rewrite (nearest_is_one _ _ _ Nx Ix), (nearest_is_one _ _ _ Nz Iz). now split.
Qed.

(* ---- The two calls ---- *)

Open Scope nat_scope.

Lemma written : forall (A : Type) array begin (values : list A) m a i,
  write array begin values m a i = if (a =? array) && ((begin <=? i) && (i <? begin + length values)) then nth (i - begin) values (m a i)
    else m a i.
Proof.
  intros A array begin values m a i. unfold write. destruct (a =? array); [|reflexivity]. cbn [andb].
  destruct (Nat.leb_spec begin i) as [B|B]; [|reflexivity]. destruct (Nat.ltb_spec i (begin + length values)) as [L|L]; [reflexivity|].
  apply nth_overflow. lia.
Qed.

Lemma nth_of_map : forall (A : Type) (f : nat -> A) begin size i default, begin <= i < begin + size ->
  nth (i - begin) (map f (seq begin size)) default = f i.
Proof.
  intros A f begin size i default H. rewrite nth_indep with (d' := f 0) by (rewrite map_length, seq_length; lia). rewrite map_nth, seq_nth
    by lia.
  f_equal. lia.
Qed.

Lemma count_more : forall answers n, count_invalid answers (S n) = with_invalid (fst (answers n)) (count_invalid answers n).
Proof.
  intros answers n. unfold count_invalid. rewrite seq_S, filter_app, app_length. cbn [plus filter]. unfold is_invalid at 2.
  destruct (fst (answers n)); cbn [length with_invalid]; lia.
Qed.

Lemma count_valid : forall answers n k, (forall i, n <= i < n + k -> is_invalid (answers i) = false) ->
  count_invalid answers (n + k) = count_invalid answers n.
Proof.
  intros answers n k. induction k as [|k IH]; intro H; [now rewrite Nat.add_0_r|]. rewrite Nat.add_succ_r, count_more.
  pose proof (H (n + k) ltac:(lia)) as V. unfold is_invalid in V. rewrite IH by (intros i Hi; apply H; lia).
  now destruct (fst (answers (n + k))).
Qed.

Theorem batches_are_right : forall form one law,
  (forall set x z, right_where_free set (form x z) law x z) -> (forall x y z, right_answer (one x y z) law x y z) -> batches_agree form one.
Proof.
  intros form one law Hform Hone set count.
  assert (lane : forall s x y z, set = Some s -> is_free s (form x z) = true -> in_range y ->
    snd (one x y z) = (force_x (form x z), zero32, force_z (form x z)) /\ is_invalid (one x y z) = false).
  { intros s x y z _ F Hy. exact (lane_is_answer s _ law x y z _ (Hform s x z) (Hone x y z) F Hy). }
  split.
  - intros x z fx fz arrays Hne after answer.
    set (holds := fun (n : nat) (s : state binary32) =>
      (forall i, i < n -> exists y, snd (answer i) = (memory s fx i, y, memory s fz i)) /\
      (forall a i, count <= i \/ a <> fx /\ a <> fz -> memory s a i = arrays a i) /\
      (forall i, n <= i -> memory s x i = arrays x i /\ memory s z i = arrays z i) /\ invalid_count s = count_invalid answer n).
    assert (E : holds count after); [|destruct E as (E1 & E2 & _ & E4); now split].
    apply answer_all_keeps with (holds := holds).
    + intros i n s (H1 & H2 & H3 & H4) Hn. unfold together_columns. destruct set as [instructions|]; [|exact (conj H1 (conj H2 (conj H3
      H4)))].
      set (lanes := map _ (seq i n)). assert (Ln : length lanes = n) by (unfold lanes; now rewrite map_length, seq_length).
      assert (El : lanes = map (fun j => form (arrays x j) (arrays z j)) (seq i n)).
      { apply map_ext_in. intros j Hj. apply in_seq in Hj. destruct (H3 j ltac:(lia)) as [-> ->]. reflexivity. }
      destruct (forallb (is_free instructions) lanes) eqn:F; cbn [negb andb].
      * rewrite andb_false_r. rewrite forallb_forall in F.
        assert (each : forall j, i <= j < i + n ->
          snd (answer j) = (force_x (form (arrays x j) (arrays z j)), zero32, force_z (form (arrays x j) (arrays z j))) /\
          is_invalid (answer j) = false).
        { intros j Hj. apply (lane instructions); [reflexivity| |split; [reflexivity|]; cbn; rewrite Rabs_R0; lra].
          apply F. rewrite El. apply in_map_iff. exists j. split; [reflexivity|]. apply in_seq. lia. }
        unfold holds. cbn [memory invalid_count]. repeat split.
        -- intros j Hj. rewrite !written, !map_length, Ln.
           rewrite (proj2 (Nat.eqb_neq fx fz) Hne), !Nat.eqb_refl. cbn [andb].
           destruct ((i <=? j) && (j <? i + n)) eqn:B.
           ++ apply andb_prop in B. destruct B as [B1 B2]. apply Nat.leb_le in B1. apply Nat.ltb_lt in B2.
              destruct (each j ltac:(lia)) as [Ea _]. exists zero32. rewrite Ea, El, !map_map, !nth_of_map by lia. reflexivity.
           ++ rewrite (proj2 (Nat.eqb_neq fz fx)) by auto. cbn [andb]. apply H1. apply andb_false_iff in B.
              destruct B as [B|B]; [apply Nat.leb_gt in B|apply Nat.ltb_ge in B]; lia.
        -- intros a j Ha. rewrite !written, !map_length, Ln. replace ((a =? fz) && ((i <=? j) && (j <? i + n))) with false.
           2: { symmetry. destruct (Nat.eqb_spec a fz); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia. }
           replace ((a =? fx) && ((i <=? j) && (j <? i + n))) with false; [now apply H2|].
           symmetry. destruct (Nat.eqb_spec a fx); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia.
        -- rewrite !written, !map_length, Ln. rewrite (proj2 (Nat.ltb_ge i0 (i + n))) by lia. rewrite !andb_false_r. apply H3. lia.
        -- rewrite !written, !map_length, Ln. rewrite (proj2 (Nat.ltb_ge i0 (i + n))) by lia. rewrite !andb_false_r. apply H3. lia.
        -- rewrite count_valid; [exact H4|]. intros j Hj. now apply each.
      * rewrite andb_true_r. destruct (is_in_place x z fx fz) eqn:P; [exact (conj H1 (conj H2 (conj H3 H4)))|].
        unfold is_in_place in P. rewrite !orb_false_iff, !Nat.eqb_neq in P. destruct P as (((P1 & P2) & P3) & P4).
        unfold holds. cbn [memory invalid_count]. repeat split; try exact H4.
        -- intros j Hj. rewrite !written, !map_length, Ln. rewrite (proj2 (Nat.leb_gt i j)) by lia. rewrite !andb_false_r. now apply H1.
        -- intros a j Ha. rewrite !written, !map_length, Ln. replace ((a =? fz) && ((i <=? j) && (j <? i + n))) with false.
           2: { symmetry. destruct (Nat.eqb_spec a fz); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia. }
           replace ((a =? fx) && ((i <=? j) && (j <? i + n))) with false; [now apply H2|].
           symmetry. destruct (Nat.eqb_spec a fx); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia.
        -- rewrite !written. rewrite (proj2 (Nat.eqb_neq x fz)), (proj2 (Nat.eqb_neq x fx)) by auto. now apply H3.
        -- rewrite !written. rewrite (proj2 (Nat.eqb_neq z fz)), (proj2 (Nat.eqb_neq z fx)) by auto. now apply H3.
    + intros i s (H1 & H2 & H3 & H4) Hi. unfold single_column. destruct (H3 i ltac:(lia)) as [-> ->]. fold (answer i).
      destruct (answer i) as [status [[a y] b]] eqn:Ea. unfold holds. cbn [memory invalid_count]. repeat split.
      * intros j Hj. rewrite !written. cbn [length]. rewrite (proj2 (Nat.eqb_neq fx fz) Hne), (proj2 (Nat.eqb_neq fz fx)), !Nat.eqb_refl
        by auto.
        cbn [andb]. destruct (Nat.eq_dec j i) as [->|Hj'].
        -- exists y. rewrite Ea. cbn [snd]. rewrite Nat.leb_refl, (proj2 (Nat.ltb_lt i (i + 1))), Nat.sub_diag by lia. reflexivity.
        -- rewrite (proj2 (Nat.leb_gt i j)) by lia. cbn [andb]. apply H1. lia.
      * intros c j Hc. rewrite !written. cbn [length]. replace ((c =? fz) && ((i <=? j) && (j <? i + 1))) with false.
        2: { symmetry. destruct (Nat.eqb_spec c fz); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia. }
        replace ((c =? fx) && ((i <=? j) && (j <? i + 1))) with false; [now apply H2|].
        symmetry. destruct (Nat.eqb_spec c fx); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia.
      * rewrite !written. cbn [length]. rewrite (proj2 (Nat.ltb_ge i0 (i + 1))) by lia. rewrite !andb_false_r. apply H3. lia.
      * rewrite !written. cbn [length]. rewrite (proj2 (Nat.ltb_ge i0 (i + 1))) by lia. rewrite !andb_false_r. apply H3. lia.
      * now rewrite count_more, Ea, H4.
    + unfold holds. cbn [memory invalid_count]. repeat split; intros; try reflexivity. lia.
  - intros positions forces arrays after answer.
    set (holds := fun (n : nat) (s : state row) =>
      (forall i, i < n -> memory s forces i = snd (answer i)) /\
      (forall a i, count <= i \/ a <> forces -> memory s a i = arrays a i) /\
      (forall i, n <= i -> memory s positions i = arrays positions i) /\ invalid_count s = count_invalid answer n).
    assert (E : holds count after); [|destruct E as (E1 & E2 & _ & E4); now split].
    apply answer_all_keeps with (holds := holds).
    + intros i n s (H1 & H2 & H3 & H4) Hn. unfold together_rows. destruct set as [instructions|]; [|exact (conj H1 (conj H2 (conj H3 H4)))].
      set (rows := map (memory s positions) (seq i n)).
      assert (Er : rows = map (arrays positions) (seq i n)).
      { apply map_ext_in. intros j Hj. apply in_seq in Hj. now apply H3; lia. }
      destruct (forallb (fun r => negb (is_large (absolute32 (y_of r)))) rows && forallb (is_free instructions) (map (lane_of form) rows))
        eqn:F;
        [|exact (conj H1 (conj H2 (conj H3 H4)))].
      apply andb_prop in F. destruct F as [Fy Ff]. rewrite forallb_forall in Fy, Ff.
      assert (each : forall j, i <= j < i + n ->
        snd (answer j) = (force_x (lane_of form (arrays positions j)), zero32, force_z (lane_of form (arrays positions j))) /\
        is_invalid (answer j) = false).
      { intros j Hj. assert (Hin : In (arrays positions j) rows).
        { rewrite Er. apply in_map_iff. exists j. split; [reflexivity|]. apply in_seq. lia. }
        specialize (Fy _ Hin). specialize (Ff _ (in_map (lane_of form) _ _ Hin)). unfold answer.
        destruct (arrays positions j) as [[x y] z]. cbn [y_of lane_of] in *. apply (lane instructions); [reflexivity|exact Ff|].
        apply not_large. now apply negb_true_iff in Fy. }
      unfold holds. cbn [memory invalid_count]. rewrite Er, !map_map. repeat split.
      * intros j Hj. rewrite written, map_length, seq_length, Nat.eqb_refl. cbn [andb]. destruct ((i <=? j) && (j <? i + n)) eqn:B.
        -- apply andb_prop in B. destruct B as [B1 B2]. apply Nat.leb_le in B1. apply Nat.ltb_lt in B2.
           rewrite nth_of_map by lia. symmetry. apply each. lia.
        -- apply H1. apply andb_false_iff in B. destruct B as [B|B]; [apply Nat.leb_gt in B|apply Nat.ltb_ge in B]; lia.
      * intros a j Ha. rewrite written, map_length, seq_length. replace ((a =? forces) && ((i <=? j) && (j <? i + n))) with false; [now
        apply H2|].
        symmetry. destruct (Nat.eqb_spec a forces); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia.
      * intros j Hj. rewrite written, map_length, seq_length. rewrite (proj2 (Nat.ltb_ge j (i + n))) by lia. rewrite !andb_false_r. apply
        H3. lia.
      * rewrite count_valid; [exact H4|]. intros j Hj. now apply each.
    + intros i s (H1 & H2 & H3 & H4) Hi. unfold single_row. rewrite (H3 i) by lia.
      destruct (arrays positions i) as [[x y] z] eqn:Ep. destruct (one x y z) as [status force] eqn:Ea.
      assert (Ai : answer i = (status, force)) by (unfold answer; now rewrite Ep, Ea).
      unfold holds. cbn [memory invalid_count]. repeat split.
      * intros j Hj. rewrite written. cbn [length]. rewrite Nat.eqb_refl. cbn [andb]. destruct (Nat.eq_dec j i) as [->|Hj'].
        -- rewrite Ai, Nat.leb_refl, (proj2 (Nat.ltb_lt i (i + 1))), Nat.sub_diag by lia. reflexivity.
        -- rewrite (proj2 (Nat.leb_gt i j)) by lia. cbn [andb]. apply H1. lia.
      * intros a j Ha. rewrite written. cbn [length]. replace ((a =? forces) && ((i <=? j) && (j <? i + 1))) with false; [now apply H2|].
        symmetry. destruct (Nat.eqb_spec a forces); [|reflexivity]. cbn [andb]. apply andb_false_iff. right. apply Nat.ltb_ge. lia.
      * intros j Hj. rewrite written. cbn [length]. rewrite (proj2 (Nat.ltb_ge j (i + 1))) by lia. rewrite !andb_false_r. apply H3. lia.
      * now rewrite count_more, Ai, H4.
    + unfold holds. cbn [memory invalid_count]. repeat split; intros; try reflexivity. lia.
Qed.
Arguments batches_are_right {form one law} & _ _.
