(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage of every law over limbs, from its inputs to its answer, is the one over integers: all of its operations put together.
   No exponent on the way leaves 64 bits. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Laws.
From Forceshade Require Import Formats Comparisons Operations Evaluate Inputs SecondStage BigFloat BigFloatValues BigFloatProducts
  BigFloatNewton BigFloatRight.
From Forceshade Require Import BigFloatSearch BigFloatTight BigFloatDecide NewtonThirdStage SineThirdStage ThreePolygonsThird ThirdAlong.
From Forceshade Require Import CylinderSecond SecondAlong ThreePolygonsGap TwoPolygonsThird Cylinder BumpCylinder Bump2p Bump3p.
From Forceshade Require Import Bump1pShaded Bump2pShaded Bump3pShaded.
From Forceshade Require Import WideNumbers WideRefined WideSums WideNewton ThirdStages.
Open Scope Z_scope.

(* That two arithmetics are the same is seen before any operation is looked into. *)
Local Strategy 1000 [add multiply divide_newton square_root_newton exactly negated widened truncated sign_of_big approximately search].

Section Refined.
Context (outside : Z -> Z) (count : nat) (enough : (2 <= count <= 64)%nat).
Local Notation L := (of_limbs outside count).
Local Notation I := (of_integers count).
Local Notation limbs_hold := (limbs_hold count).

Lemma of64_holds : forall v, limbs_hold 1074 (from_binary64 L v) (from_binary64 I v).
Proof. exact (exactly_holds count enough). Qed.

Lemma opposite_holds : forall k l a, limbs_hold k l a -> limbs_hold k (opposite L l) (opposite I a).
Proof. exact (negated_holds count enough). Qed.

Lemma sum_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> Z.max k j + 5000 <= range ->
  limbs_hold (Z.max k j + 4099) (sum L l m) (sum I a b).
Proof.
  intros k j l a m b Ha Hb J. apply (held_more count enough) with (1 := add_holds outside count enough _ _ _ _ _ _ Ha Hb J). lia.
Qed.

Lemma product_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> 2 * Z.max k j + 5000 <= range ->
  limbs_hold (k + j + 1) (product L l m) (product I a b).
Proof. exact (multiply_holds outside count enough). Qed.

Lemma quotient_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> 60 * (Z.max k j + 6000) <= range ->
  limbs_hold (k + j + 3) (quotient L l m) (quotient I a b).
Proof. exact (divide_holds outside count enough). Qed.

Lemma root_is_held : forall k l a, limbs_hold k l a -> 60 * (k + 6000) <= range -> limbs_hold (k + 2) (root L l) (root I a).
Proof. exact (root_holds outside count enough). Qed.

Ltac held :=
  lazymatch goal with
  | |- WideRefined.limbs_hold _ _ (from_binary64 _ _) _ => apply of64_holds
  | |- WideRefined.limbs_hold _ _ (opposite _ _) _ => eapply opposite_holds; held
  | |- WideRefined.limbs_hold _ _ (sum _ _ _) _ => eapply sum_holds; [held | held | numbers64; lia]
  | |- WideRefined.limbs_hold _ _ (product _ _ _) _ => eapply product_holds; [held | held | numbers64; lia]
  | |- WideRefined.limbs_hold _ _ (quotient _ _ _) _ => eapply quotient_holds; [held | held | numbers64; lia]
  | |- WideRefined.limbs_hold _ _ (root _ _) _ => eapply root_is_held; [held | numbers64; lia]
  | _ => eassumption
  end.
Ltac held_within := eapply (held_more count enough); [held | lia].

(* ---- Answers ---- *)

Lemma search_same : forall beside beside' steps c, (forall t, beside t = beside' t) -> search beside steps c = search beside' steps c.
Proof.
  intros beside beside' steps c H. revert c. induction steps as [|steps IH]; intro c; [reflexivity|]. cbn [search]. rewrite !H, !IH.
  reflexivity.
Qed.

Lemma sign_same : forall k l a, k <= range -> limbs_hold k l a -> sign_of L l = sign_of I a.
Proof. exact (wide_sign_is outside count enough). Qed.

Lemma approximately_holds : forall k l a, k < 2 ^ 31 -> limbs_hold k l a -> approximation L l = approximation I a.
Proof.
  intros k l a K H. unfold approximation, of_limbs, of_integers, wide_approximately, approximately. cbv zeta.
  rewrite (wide_zero_is count enough k l a H), (fraction_holds count enough k l a H).
  destruct (parts count enough k l a H) as (-> & -> & _). destruct H as (_ & _ & E & _). rewrite int32_is by lia. reflexivity.
Qed.

Lemma rounded_same : forall k l a, k < 2 ^ 31 -> limbs_hold k l a -> Third.rounded L l = Third.rounded I a.
Proof.
  intros k l a K H. pose proof (holds_positive count enough _ _ _ H). unfold Third.rounded.
  rewrite (approximately_holds k l a K H).
  apply search_same. intro t. eapply sign_same; [|held]. numbers64. lia.
Qed.

(* Two outcomes with the same sign, and components of one the limbs of those of the other. *)
Definition agree (k : Z) (o : Third.outcome (number := wide)) (p : Third.outcome (number := big)) : Prop :=
  fst (fst o) = fst (fst p) /\ limbs_hold k (snd (fst o)) (snd (fst p)) /\ limbs_hold k (snd o) (snd p).

Lemma decide_same : forall k o p, k < 2 ^ 31 -> agree k o p -> Third.decide L o = Third.decide I p.
Proof.
  intros k [[s fx] fz] [[t gx] gz] K (S & X & Z). cbn [fst snd] in *. subst t. unfold Third.decide.
  now rewrite (rounded_same k fx gx K X), (rounded_same k fz gz K Z).
Qed.

Lemma agree_more : forall k j o p, agree k o p -> k <= j -> agree j o p.
Proof. intros k j o p (S & X & Z) J. split; [exact S|]. split; apply (held_more count enough k); assumption. Qed.

Lemma along_agrees : forall k j K g gap nx normal_x nz normal_z, limbs_hold k g gap -> limbs_hold j nx normal_x -> limbs_hold j nz
  normal_z ->
  2 * (k + j + 2000) + 5000 <= range -> agree (k + j + 1076) (Third.along L K g nx nz) (Third.along I K gap normal_x normal_z).
Proof.
  intros k j K g gap nx normal_x nz normal_z G X Z J. pose proof (holds_positive count enough _ _ _ G).
  pose proof (holds_positive count enough _ _ _ X).
  unfold Third.along. split; [apply (sign_same k); [lia|exact G]|]. cbn [fst snd]. split; held_within.
Qed.

Lemma plane_agrees : forall K z, agree 4000 (Third.on_plane L K z) (Third.on_plane I K z).
Proof.
  intros K z. unfold Third.on_plane. eapply agree_more; [eapply along_agrees; [held|held|held|numbers64; lia]|lia].
Qed.

Lemma shaded_agrees : forall k K R x g gap, limbs_hold k g gap -> 60 * (k + 20000) <= range ->
  agree (k + 20000) (Third.along_shaded L K R x g) (Third.along_shaded I K R x gap).
Proof.
  intros k K R x g gap G J. pose proof (holds_positive count enough _ _ _ G). unfold Third.along_shaded. cbv zeta.
  eapply agree_more; [eapply (along_agrees _ 11000); [held|held_within|held_within|numbers64; lia]|lia].
Qed.

(* ---- Two polygons and the cylinder ---- *)

(* Where the code computes more of a face than it needs, the exponents of the rest stay in 64 bits, too. *)

Lemma depth_holds : forall R w, limbs_hold 11000 (Third.depth L R w) (Third.depth I R w).
Proof. intros R w. unfold Third.depth. cbv zeta. held_within. Qed.

Lemma wide_tangent_2p_holds : forall R w, limbs_hold 17000 (Third.tangent_2p L R w) (Third.tangent_2p I R w).
Proof. intros R w. pose proof (depth_holds R w). unfold Third.tangent_2p, Third.sum_2p. held_within. Qed.

Lemma cosine_2p_holds : forall R w, limbs_hold 21000 (Third.cosine_2p L R w) (Third.cosine_2p I R w).
Proof. intros R w. pose proof (depth_holds R w). unfold Third.cosine_2p, Third.sum_2p. held_within. Qed.

Lemma sine_2p_holds : forall R w, limbs_hold 28000 (Third.sine_2p L R w) (Third.sine_2p I R w).
Proof. intros R w. pose proof (cosine_2p_holds R w). unfold Third.sine_2p. held_within. Qed.

Lemma side_gap_holds : forall k l a w x z, limbs_hold k l a -> 2 * k + 30000 <= range ->
  limbs_hold (k + 10000) (Third.side_gap L l w x z) (Third.side_gap I a w x z).
Proof. intros k l a w x z H J. pose proof (holds_positive count enough _ _ _ H). unfold Third.side_gap. held_within. Qed.

Lemma cylinder_agrees : forall R w K x z, agree 200000 (Third.cylinder L R w K x z) (Third.cylinder I R w K x z).
Proof.
  intros R w K x z. pose proof (depth_holds R w) as D. unfold Third.cylinder. cbv zeta.
  set (l := sum L (from_binary64 L (to64 z)) (Third.depth L R w)). set (a := sum I (from_binary64 I (to64 z)) (Third.depth I R w)).
  assert (Hl : limbs_hold 16000 l a) by (unfold l, a; held_within). clearbody l a.
  rewrite (sign_same 16000 l a) by (numbers64; lia || exact Hl).
  set (v := sum L (product L _ _) (opposite L (product L _ (sum L l _)))).
  set (b := sum I (product I _ _) (opposite I (product I _ (sum I a _)))).
  assert (Hv : limbs_hold 30000 v b) by (unfold v, b; held_within). clearbody v b.
  set (rho := root L _). set (r := root I _). assert (Hr : limbs_hold 40000 rho r) by (unfold rho, r; held_within). clearbody rho r.
  destruct (if is_nonzero x then Gt else sign_of I a).
  1: split; [reflexivity|]; cbn [fst snd]; split; held_within.
  all: split; [apply (sign_same 30000); [numbers64; lia|exact Hv]|]; cbn [fst snd]; split; held_within.
Qed.

Lemma bump_cylinder_agrees : forall R w K x z, agree 210000 (Third.bump_cylinder L R w K x z) (Third.bump_cylinder I R w K x z).
Proof.
  intros R w K x z. destruct (cylinder_agrees R w K x z) as (S & X & Z). destruct (plane_agrees K z) as (T & U & V).
  unfold Third.bump_cylinder. cbv zeta. destruct (negb (is_less32 z zero32)).
  { apply (agree_more 200000); [|lia]. now split. }
  rewrite S. destruct (fst (fst (Third.cylinder I R w K x z))).
  1, 2: apply (agree_more 4000); [now split|lia].
  split; [reflexivity|]. cbn [fst snd]. split; held_within.
Qed.

Lemma bump_2p_agrees : forall R w K x z, agree 210000 (Third.bump_2p L R w K x z) (Third.bump_2p I R w K x z).
Proof.
  intros R w K x z. unfold Third.bump_2p. cbv zeta. destruct (is_beside w x); [apply (agree_more 4000); [apply plane_agrees|lia]|].
  pose proof (sine_2p_holds R w) as S. eapply agree_more.
  - eapply (along_agrees 27000 28000); [apply (side_gap_holds 17000); [apply wide_tangent_2p_holds|numbers64; lia]| | |numbers64; lia].
    + destruct (is_less32 x zero32); held.
    + apply (held_more count enough 21000); [apply cosine_2p_holds|lia].
  - lia.
Qed.

Lemma bump_1p_shaded_agrees : forall R w K x z, agree 210000 (Third.bump_1p_shaded L R w K x z) (Third.bump_1p_shaded I R w K x z).
Proof.
  intros R w K x z. unfold Third.bump_1p_shaded. destruct (is_beside w x); [apply (agree_more 4000); [apply plane_agrees|lia]|].
  eapply agree_more; [eapply shaded_agrees; [held|numbers64; lia]|lia].
Qed.

Lemma bump_2p_shaded_agrees : forall R w K x z, agree 210000 (Third.bump_2p_shaded L R w K x z) (Third.bump_2p_shaded I R w K x z).
Proof.
  intros R w K x z. unfold Third.bump_2p_shaded. destruct (is_beside w x); [apply (agree_more 4000); [apply plane_agrees|lia]|].
  eapply agree_more; [eapply (shaded_agrees 27000); [|numbers64; lia]|lia].
  destruct (is_at_foot w x); [held_within|]. apply (side_gap_holds 17000); [apply wide_tangent_2p_holds|numbers64; lia].
Qed.

(* ---- Three polygons ---- *)

(* A function and its derivative, as Newton's method has them. *)
Definition is_cubic (f : wide -> wide) (g : big -> big) : Prop :=
  forall k l a, k <= 10000000000 -> limbs_hold k l a -> limbs_hold (3 * k + 10000) (f l) (g a).
Definition is_square (f : wide -> wide) (g : big -> big) : Prop :=
  forall k l a, k <= 10000000000 -> limbs_hold k l a -> limbs_hold (2 * k + 7000) (f l) (g a).

Lemma corrected_holds : forall f g f' g' k l a m b, is_cubic f g -> is_square f' g' -> k <= 10000000000 -> limbs_hold k l a ->
  limbs_hold k m b ->
  limbs_hold (5 * k + 22000) (Third.corrected L f f' l m) (Third.corrected I g g' a b).
Proof.
  intros f g f' g' k l a m b F F' K Ha Hb. pose proof (holds_positive count enough _ _ _ Ha). pose proof (F k l a K Ha).
  pose proof (F' k m b K Hb).
  unfold Third.corrected. held_within.
Qed.

Lemma steps_hold : forall f g f' g', is_cubic f g -> is_square f' g' -> forall steps bits k l a, limbs_hold k l a ->
  (k + 5500) * 5 ^ Z.of_nat steps <= 10000000000 -> 0 <= bits <= 10000 -> bits * 2 ^ Z.of_nat steps <= 10000 ->
  limbs_hold ((k + 5500) * 5 ^ Z.of_nat steps - 5500) (Third.newton_steps L f f' steps bits l) (Third.newton_steps I g g' steps bits a).
Proof.
  intros f g f' g' F F'. induction steps as [|steps IH]; intros bits k l a H K B0 B.
  - change (5 ^ Z.of_nat 0) with 1 in *. apply (held_more count enough) with (1 := H). lia.
  - cbn [Third.newton_steps]. rewrite Nat2Z.inj_succ, Z.pow_succ_r in * by lia. pose proof (holds_positive count enough _ _ _ H).
    pose proof (Z.pow_pos_nonneg 5 (Z.of_nat steps) ltac:(lia) ltac:(lia)).
    pose proof (Z.pow_pos_nonneg 2 (Z.of_nat steps) ltac:(lia) ltac:(lia)).
    pose proof (corrected_holds f g f' g' k l a l a F F' ltac:(nia) H H) as C.
    pose proof (truncated_holds outside count enough _ _ _ (2 * bits) C ltac:(numbers64; lia)) as T.
    replace ((k + 5500) * (5 * 5 ^ Z.of_nat steps) - 5500) with ((5 * k + 22000 + 5500) * 5 ^ Z.of_nat steps - 5500) by ring.
    apply IH; [exact T| | |]; nia.
Qed.

Lemma newton_root_holds : forall f g f' g' start, is_cubic f g -> is_square f' g' ->
  limbs_hold 2600000000 (Third.newton_root L f f' start) (Third.newton_root I g g' start).
Proof.
  intros f g f' g' start F F'. unfold Third.newton_root. cbv zeta.
  pose proof (steps_hold f g f' g' F F' 7 50 1074 _ _ (of64_holds start) ltac:(lia) ltac:(lia) ltac:(lia)) as H.
  set (l := Third.newton_steps L _ _ _ _ _) in *. set (a := Third.newton_steps I _ _ _ _ _) in *.
  change ((1074 + 5500) * 5 ^ Z.of_nat 7 - 5500) with 513588250 in H.
  pose proof (widened_holds outside count enough _ _ _ (-40) H ltac:(numbers64; lia)) as W.
  pose proof (corrected_holds f g f' g' 513588250 l a _ _ F F' ltac:(lia) H W) as C. apply (held_more count enough) with (1 := C). lia.
Qed.

Lemma third_value_is_cubic : forall s a, limbs_hold 2151 s a -> is_cubic (Third.third_value L s) (Third.third_value I a).
Proof. intros s a S k l b K H. pose proof (holds_positive count enough _ _ _ H). unfold Third.third_value. held_within. Qed.

Lemma third_slope_is_square : is_square (Third.third_slope L) (Third.third_slope I).
Proof. intros k l b K H. pose proof (holds_positive count enough _ _ _ H). unfold Third.third_slope. held_within. Qed.

Lemma rest_value_is_cubic : forall s a, limbs_hold 2151 s a -> is_cubic (Third.rest_value L s) (Third.rest_value I a).
Proof. intros s a S k l b K H. pose proof (holds_positive count enough _ _ _ H). unfold Third.rest_value. held_within. Qed.

Lemma rest_slope_is_square : is_square (Third.rest_slope L) (Third.rest_slope I).
Proof. intros k l b K H. pose proof (holds_positive count enough _ _ _ H). unfold Third.rest_slope. held_within. Qed.

Lemma steps_are : forall f g steps bits x, Third.newton_steps I f g steps bits x = newton_steps (64 * Z.of_nat count) f g steps bits x.
Proof. intros f g. induction steps as [|steps IH]; intros bits x; [reflexivity|]. cbn [Third.newton_steps newton_steps]. apply IH. Qed.

Lemma newton_root_of_integers : forall f g start, Third.newton_root I f g start = newton_root_big (64 * Z.of_nat count) f g start.
Proof.
  intros f g start. unfold Third.newton_root, newton_root_big. cbv zeta. rewrite steps_are. reflexivity.
Qed.

Lemma sine_of_third_of_integers : forall R w, Third.sine_of_third I R w = sine_of_third_big (64 * Z.of_nat count) R w.
Proof.
  intros R w. unfold Third.sine_of_third, sine_of_third_big. rewrite !newton_root_of_integers. reflexivity.
Qed.

(* Of which a theorem knows the exponent (proofs/sine_of_third/SineThirdStage.v). *)
Lemma sine_of_third_holds : forall R w K, parameters R w K -> limbs_hold 50000000 (Third.sine_of_third L R w) (Third.sine_of_third I R w).
Proof.
  intros R w K Hp. apply (holds_tight count enough 2700000000).
  - unfold Third.sine_of_third. destruct (is_at_most _ _); [|destruct (is_equal _ _); [held_within|]].
    + apply (held_more count enough 2600000000); [|lia]. apply newton_root_holds; [apply third_value_is_cubic;
      held_within|apply third_slope_is_square].
    + eapply (held_more count enough); [eapply sum_holds; [held|eapply opposite_holds; eapply newton_root_holds;
        [apply rest_value_is_cubic; held_within|apply rest_slope_is_square]|numbers64; lia]|lia].
  - destruct (sine_of_third_is_tight (64 * Z.of_nat count) R w K ltac:(lia) Hp) as (_ & [E _] & _). rewrite sine_of_third_of_integers.
  exact E.
Qed.

Lemma sine_3p_holds : forall l a, limbs_hold 50000000 l a -> limbs_hold 160000000 (Third.sine_3p L l) (Third.sine_3p I a).
Proof. intros l a H. unfold Third.sine_3p, Third.twice. held_within. Qed.

Lemma cosine_3p_holds : forall l a, limbs_hold 50000000 l a -> limbs_hold 110000000 (Third.cosine_3p L l) (Third.cosine_3p I a).
Proof. intros l a H. unfold Third.cosine_3p, Third.twice. held_within. Qed.

Lemma tangent_3p_holds : forall l a, limbs_hold 50000000 l a -> limbs_hold 280000000 (Third.tangent_3p L l) (Third.tangent_3p I a).
Proof.
  intros l a H. pose proof (sine_3p_holds l a H). pose proof (cosine_3p_holds l a H). unfold Third.tangent_3p. held_within.
Qed.

Lemma top_gap_holds : forall R z l a, limbs_hold 50000000 l a -> limbs_hold 280000000 (sum L (Third.top_height L R l)
  (opposite L (from_binary64 L (to64 z)))) (sum I (Third.top_height I R a) (opposite I (from_binary64 I (to64 z)))).
Proof. intros R z l a H. pose proof (sine_3p_holds l a H). unfold Third.top_height, Third.twice. held_within. Qed.

Lemma bump_3p_agrees : forall R w K x z, parameters R w K ->
  agree 500000000 (Third.bump_3p L R w K x z) (Third.bump_3p I R w K x z).
Proof.
  intros R w K x z Hp. unfold Third.bump_3p. cbv zeta. destruct (is_beside w x); [apply (agree_more 4000); [apply plane_agrees|lia]|].
  pose proof (sine_of_third_holds R w K Hp) as T. set (l := Third.sine_of_third L R w) in *. set (a := Third.sine_of_third I R w) in *.
  destruct (is_on_flat R w x).
  - eapply agree_more; [eapply along_agrees; [apply top_gap_holds; exact T|held|held|numbers64; lia]|lia].
  - pose proof (sine_3p_holds l a T) as S.
    eapply agree_more; [eapply (along_agrees _ 160000000); [apply (side_gap_holds 280000000); [now apply tangent_3p_holds|numbers64;
      lia]| | |
      numbers64; lia]|lia].
    + destruct (is_less32 x zero32); held.
    + apply (held_more count enough 110000000); [now apply cosine_3p_holds|lia].
Qed.

Lemma bump_3p_shaded_agrees : forall R w K x z, parameters R w K ->
  agree 500000000 (Third.bump_3p_shaded L R w K x z) (Third.bump_3p_shaded I R w K x z).
Proof.
  intros R w K x z Hp. unfold Third.bump_3p_shaded. destruct (is_beside w x); [apply (agree_more 4000); [apply plane_agrees|lia]|].
  eapply agree_more; [eapply (shaded_agrees 300000000); [|numbers64; lia]|lia]. destruct (is_at_foot w x); [held_within|].
  pose proof (sine_of_third_holds R w K Hp) as T. unfold Third.gap_3p. cbv zeta. destruct (is_on_flat R w x).
  - eapply (held_more count enough); [apply top_gap_holds; exact T|lia].
  - eapply (held_more count enough); [apply (side_gap_holds 280000000); [now apply tangent_3p_holds|numbers64; lia]|lia].
Qed.
End Refined.

(* ---- The laws, with the limbs that each has ---- *)

Ltac same_answer agrees := intros; etransitivity; [eapply decide_same; [lia | | apply agrees; lia]; lia | ].

Theorem cylinder_in_limbs : forall outside R w K x z,
  third_stage (of_limbs outside 32) Third.cylinder R w K x z = cylinder_third R w K x z.
Proof. same_answer cylinder_agrees. reflexivity. Qed.

Theorem bump_cylinder_in_limbs : forall outside R w K x z,
  third_stage (of_limbs outside 32) Third.bump_cylinder R w K x z = bump_cylinder_third R w K x z.
Proof. same_answer bump_cylinder_agrees. reflexivity. Qed.

Theorem bump_2p_in_limbs : forall outside R w K x z,
  third_stage (of_limbs outside 32) Third.bump_2p R w K x z = bump_2p_third R w K x z.
Proof. same_answer bump_2p_agrees. unfold Third.bump_2p, bump_2p_third. now destruct (is_beside w x). Qed.

Theorem bump_3p_in_limbs : forall outside R w K, parameters R w K -> forall x z,
  third_stage (of_limbs outside 64) Third.bump_3p R w K x z = bump_3p_third R w K x z.
Proof.
  intros outside R w K Hp x z. unfold third_stage. rewrite (decide_same outside 64 ltac:(lia) 500000000 _ _ ltac:(lia)
    (bump_3p_agrees outside 64 ltac:(lia) R w K x z Hp)).
  unfold Third.bump_3p, bump_3p_third, top_gap_third. rewrite sine_of_third_of_integers. change (64 * Z.of_nat 64) with 4096. cbv zeta.
  generalize (sine_of_third_big 4096 R w). intro t. destruct (is_beside w x); [reflexivity|]. now destruct (is_on_flat R w x).
Qed.

Theorem bump_1p_shaded_in_limbs : forall outside R w K x z,
  third_stage (of_limbs outside 12) Third.bump_1p_shaded R w K x z = bump_1p_shaded_third R w K x z.
Proof. same_answer bump_1p_shaded_agrees. unfold Third.bump_1p_shaded, bump_1p_shaded_third. now destruct (is_beside w x). Qed.

Theorem bump_2p_shaded_in_limbs : forall outside R w K x z,
  third_stage (of_limbs outside 32) Third.bump_2p_shaded R w K x z = bump_2p_shaded_third R w K x z.
Proof. same_answer bump_2p_shaded_agrees. unfold Third.bump_2p_shaded, bump_2p_shaded_third. now destruct (is_beside w x). Qed.

Theorem bump_3p_shaded_in_limbs : forall outside R w K, parameters R w K -> forall x z,
  third_stage (of_limbs outside 64) Third.bump_3p_shaded R w K x z = bump_3p_shaded_third R w K x z.
Proof.
  intros outside R w K Hp x z. unfold third_stage. rewrite (decide_same outside 64 ltac:(lia) 500000000 _ _ ltac:(lia)
    (bump_3p_shaded_agrees outside 64 ltac:(lia) R w K x z Hp)).
  unfold Third.bump_3p_shaded, Third.gap_3p, bump_3p_shaded_third, gap_3p_third, top_gap_third. rewrite sine_of_third_of_integers.
  change (64 * Z.of_nat 64) with 4096. cbv zeta.
  generalize (sine_of_third_big 4096 R w). intro t. destruct (is_beside w x); [reflexivity|].
  now destruct (is_at_foot w x), (is_on_flat R w x).
Qed.

(* What is right with integers is right with limbs. *)
Theorem over_limbs : forall window first_stage second third other (law : R -> R -> Laws.exact_force) x y z,
  (forall x z, other x z = third x z) -> Laws.right_answer (evaluate window first_stage (later_of second third) x y z) law x y z ->
  Laws.right_answer (evaluate window first_stage (later_of second other) x y z) law x y z.
Proof.
  intros window first_stage second third other law x y z S H.
  replace (evaluate _ _ (later_of second other) x y z) with (evaluate window first_stage (later_of second third) x y z); [exact H|].
  unfold evaluate, later_of. now rewrite S.
Qed.
Arguments over_limbs {window first_stage second third other law x y z} & _ _.
