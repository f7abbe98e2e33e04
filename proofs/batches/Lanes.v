(* SPDX-License-Identifier: BSD-3-Clause *)
(* A lane of a batch: the operations of binary32 that forms are written with beside those of binary64 (proofs/recorded/RecordedForms.v),
   and the watch of fast/simd/pack_avx2.h and pack_avx512.h, which says which lanes are answered. *)
From Coq Require Import ZArith Znumtheory Reals Lia Lra List Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations RoundingTest Evaluate SecondAlong.
Import ListNotations.
Open Scope R_scope.

(* ---- Operations ---- *)

Definition plus32 : binary32 -> binary32 -> binary32 := b32_plus mode_NE.
Definition minus32 : binary32 -> binary32 -> binary32 := b32_minus mode_NE.
Definition times32 : binary32 -> binary32 -> binary32 := b32_mult mode_NE.
Definition over32 : binary32 -> binary32 -> binary32 := b32_div mode_NE.
Definition square_root32 : binary32 -> binary32 := b32_sqrt mode_NE.
Definition absolute32 : binary32 -> binary32 := b32_abs.
Definition is_equal32 (a b : binary32) : bool := match Bcompare 24 128 a b with Some Eq => true | _ => false end.
Definition larger32 (a b : binary32) : binary32 := if is_less32 b a then a else b.
Definition choice32 (condition : bool) (yes no : binary32) : binary32 := if condition then yes else no.
Definition where32 (condition : bool) (a : binary32) : binary32 := if condition then a else zero32.
(* a times the sign of b. *)
Definition times_sign32 (a b : binary32) : binary32 := if Bsign 24 128 b then b32_opp a else a.
(* std::max *)
Definition greatest32 (a b : binary32) : binary32 := if is_less32 a b then b else a.
Definition greatest (a b : binary64) : binary64 := if is_less a b then b else a.
Notation widened := to64 (only parsing).
Notation rounded := to32 (only parsing).
Definition sixteen_hundredths : binary64 := b64_of_bits 4594932627813569659.  (* 0x3fc47ae147ae147b *)

(* ---- A lane ---- *)

Record Lane := {
  force_x : binary32; force_z : binary32;
  sizes : list binary32;      (* Watch::domain *)
  not_tiny : list binary32;   (* Watch::tiny *)
  distances : list binary64;  (* Watch::distance *)
  doubts : list bool;         (* Watch::doubt *)
  roundings : list binary64;  (* Watch::rounding *)
  lane_window : Z;
  least_coordinate : binary32;
  least_distance : binary64
}.

(* The two compare what is tiny in two ways. *)
Inductive instruction_set := avx2 | avx512.

Definition word32 (a : Z) : Z := (a mod 2 ^ 32)%Z.
Definition is_large (size : binary32) : bool := (bits_of_b32 ten_thousand <? bits_of_b32 size)%Z.
Definition is_tiny (set : instruction_set) (least size : binary32) : bool :=
  let before := word32 (bits_of_b32 size - 1) in
  match set with
  | avx2 => (before <=? word32 (bits_of_b32 least - 1 - 1))%Z
  | avx512 => (before <? word32 (bits_of_b32 least - 1))%Z
  end.
Definition high_word (a : binary64) : Z := (bits_of_b64 a / 2 ^ 32)%Z.
Definition is_near (least a : binary64) : bool := (Z.land (high_word a) (2 ^ 31 - 1) <=? high_word least)%Z.
Definition is_beside_tie (W : Z) (a : binary64) : bool :=
  (2 ^ 29 - 1 - 2 * W <=? Z.land (word32 (word32 (bits_of_b64 a) + ((2 ^ 29 - 1) / 2 - W))) (2 ^ 29 - 1))%Z.

(* Watch::is_free_of_hazards, as to one lane. *)
Definition is_free (set : instruction_set) (lane : Lane) : bool :=
  negb (existsb is_large (sizes lane) || existsb (is_tiny set (least_coordinate lane)) (not_tiny lane) ||
        existsb (is_near (least_distance lane)) (distances lane) || existsb (fun doubt => doubt) (doubts lane) ||
        existsb (is_beside_tie (lane_window lane)) (roundings lane)).

(* ---- The order of bits is that of sizes ---- *)

(* Significand and exponent of a number, and its bits without the sign, in a format of so many bits and with this least exponent. *)
Definition sized (last least bits m e : Z) : Prop :=
  (bits = (e - least) * 2 ^ last + m /\ least <= e /\ 0 <= m < 2 * 2 ^ last /\ (e = least \/ 2 ^ last <= m))%Z.

Lemma digits_of : forall m, (2 ^ (Zpos (SpecFloat.digits2_pos m) - 1) <= Zpos m < 2 ^ Zpos (SpecFloat.digits2_pos m))%Z.
Proof.
  intro m. rewrite Digits.Zpos_digits2_pos. pose proof (Digits.Zdigits_correct radix2 (Zpos m)) as D. cbv zeta in D. exact D.
Qed.

Lemma canonical_is_sized : forall prec emax m e, (1 < prec)%Z -> SpecFloat.canonical_mantissa prec emax m e = true ->
  let least := (3 - emax - prec)%Z in (least <= e /\ Zpos m < 2 * 2 ^ (prec - 1) /\ (e = least \/ 2 ^ (prec - 1) <= Zpos m))%Z.
Proof.
  intros prec emax m e Hp H least. unfold SpecFloat.canonical_mantissa in H. apply Zeq_bool_eq in H. unfold SpecFloat.fexp, SpecFloat.emin
    in H.
  pose proof (digits_of m) as D. set (d := Zpos (SpecFloat.digits2_pos m)) in *. fold least in H.
  assert (Hd : (1 <= d)%Z) by (unfold d; lia). split; [lia|].
  assert (Hm : (d <= prec)%Z) by lia. split.
  - apply Z.lt_le_trans with (1 := proj2 D). replace (2 * 2 ^ (prec - 1))%Z with (2 ^ prec)%Z; [apply Z.pow_le_mono_r; lia|].
    rewrite <- Z.pow_succ_r by lia. f_equal. lia.
  - destruct (Z.eq_dec e least) as [E|E]; [now left|right]. assert (d = prec) by lia. subst d. rewrite <- H0. apply D.
Qed.

Lemma bits32_sized : forall a : binary32, is_finite 24 128 a = true -> exists m e,
  sized 23 (-149) (bits_of_b32 (b32_abs a)) m e /\ Rabs (value32 a) = IZR m * bpow radix2 e.
Proof.
  intros a Fa. destruct a as [s|s|s pl Hpl|s m e H]; try discriminate.
  - exists 0%Z, (-149)%Z. split; [|cbn [B2R]; rewrite Rabs_R0; ring]. unfold sized. split; [reflexivity|lia].
  - exists (Zpos m), e. destruct (andb_prop _ _ H) as [C _]. apply canonical_is_sized in C; [|lia].
    change (3 - 128 - 24)%Z with (-149)%Z in C. change (24 - 1)%Z with 23%Z in C. cbv zeta in C. split.
    + unfold sized. split; [|lia]. unfold b32_abs, Babs, bits_of_b32, bits_of_binary_float. cbv beta iota zeta.
      change (SpecFloat.emin (23 + 1) (2 ^ (8 - 1))) with (-149)%Z. unfold join_bits. rewrite !Z.shiftl_mul_pow2 by lia.
      case Zle_bool_spec; intro L; lia.
    + cbn [B2R]. rewrite <- F2R_Zabs. unfold F2R. cbn [Fnum Fexp]. now destruct s.
Qed.

Lemma bits64_sized : forall a : binary64, is_finite 53 1024 a = true -> exists m e,
  sized 52 (-1074) (bits_of_b64 (b64_abs a)) m e /\ Rabs (value64 a) = IZR m * bpow radix2 e.
Proof.
  intros a Fa. destruct a as [s|s|s pl Hpl|s m e H]; try discriminate.
  - exists 0%Z, (-1074)%Z. split; [|cbn [B2R]; rewrite Rabs_R0; ring]. unfold sized. split; [reflexivity|lia].
  - exists (Zpos m), e. destruct (andb_prop _ _ H) as [C _]. apply canonical_is_sized in C; [|lia].
    change (3 - 1024 - 53)%Z with (-1074)%Z in C. change (53 - 1)%Z with 52%Z in C. cbv zeta in C. split.
    + unfold sized. split; [|lia]. unfold b64_abs, Babs, bits_of_b64, bits_of_binary_float. cbv beta iota zeta.
      change (SpecFloat.emin (52 + 1) (2 ^ (11 - 1))) with (-1074)%Z. unfold join_bits. rewrite !Z.shiftl_mul_pow2 by lia.
      case Zle_bool_spec; intro L; lia.
    + cbn [B2R]. rewrite <- F2R_Zabs. unfold F2R. cbn [Fnum Fexp]. now destruct s.
Qed.

Lemma order_of_sized : forall last least a m e b n g, (0 < last)%Z -> sized last least a m e -> sized last least b n g -> (a <= b)%Z ->
  IZR m * bpow radix2 e <= IZR n * bpow radix2 g /\ ((a < b)%Z -> IZR m * bpow radix2 e < IZR n * bpow radix2 g).
Proof.
  intros last least a m e b n g Hl (Ea & He & Hm & Me) (Eb & Hg & Hn & Ng) Hab.
  assert (P : (0 < 2 ^ last)%Z) by (apply Z.pow_pos_nonneg; lia). set (p := (2 ^ last)%Z) in *.
  assert (Heg : (e <= g)%Z).
  { destruct (Z_le_gt_dec e g) as [H|H]; [exact H|exfalso]. assert (p <= m)%Z by lia. assert ((e - g) * p >= p)%Z by nia. nia. }
  set (k := (g - e)%Z). replace g with (k + e)%Z by (unfold k; ring). rewrite bpow_plus.
  pose proof (bpow_gt_0 radix2 e) as Pe. rewrite <- (IZR_Zpower radix2 k) by (unfold k; lia). rewrite <- Rmult_assoc, <- mult_IZR.
  change (Zpower radix2 k) with (2 ^ k)%Z.
  assert (Hk : (2 * p <= p * 2 ^ k \/ k = 0)%Z).
  { destruct (Z.eq_dec k 0) as [E|E]; [now right|left]. assert (2 ^ 1 <= 2 ^ k)%Z by (apply Z.pow_le_mono_r; unfold k in *; lia). nia. }
  assert (Q : (0 < 2 ^ k)%Z) by (apply Z.pow_pos_nonneg; unfold k; lia).
  destruct Hk as [Hk|Hk].
  - assert (p <= n)%Z.
    { destruct Ng as [Eg|Ng]; [exfalso|exact Ng]. assert (K0 : k = 0%Z) by (unfold k; lia). rewrite K0 in Hk.
      change (2 ^ 0)%Z with 1%Z in Hk. lia. }
    assert (m < n * 2 ^ k)%Z by nia.
    split; [apply Rmult_le_compat_r; [lra|apply IZR_le; lia]|intros _; apply Rmult_lt_compat_r; [lra|apply IZR_lt; lia]].
  - rewrite Hk. change (2 ^ 0)%Z with 1%Z. rewrite Z.mul_1_r. assert (e = g) by (unfold k in Hk; lia). subst g.
    split; [apply Rmult_le_compat_r; [lra|apply IZR_le; lia]|intro; apply Rmult_lt_compat_r; [lra|apply IZR_lt; lia]].
Qed.

(* ---- The watch ---- *)

Lemma bits_of_largest : forall a : binary32, is_finite 24 128 a = false -> (2139095040 <= bits_of_b32 (b32_abs a))%Z.
Proof.
  intros a Fa. destruct a as [s|s|s pl Hpl|s m e H]; try discriminate.
  unfold b32_abs, Babs. match goal with |- context [build_nan _ _ ?x] => generalize x end. intros [v Hv].
  unfold build_nan. cbn [proj1_sig]. destruct v as [s'|s'|s' pl' Hpl'|s' m' e' H']; try discriminate Hv.
  unfold bits_of_b32, bits_of_binary_float, join_bits. rewrite Z.shiftl_mul_pow2 by lia.
  change (2 ^ 8 - 1)%Z with 255%Z. change (2 ^ 8)%Z with 256%Z. cbn [Bsign get_nan_pl]. destruct s'; lia.
Qed.

Lemma not_large : forall a, is_large (absolute32 a) = false -> in_range a.
Proof.
  intros a H. unfold is_large, absolute32 in H. apply Z.ltb_ge in H.
  destruct (is_finite 24 128 a) eqn:Fa.
  - split; [exact Fa|]. destruct (bits32_sized a Fa) as (m & e & S & ->).
    destruct (bits32_sized ten_thousand eq_refl) as (n & g & T & E). change (b32_abs ten_thousand) with ten_thousand in T.
    rewrite value_of_ten_thousand, Rabs_pos_eq in E by lra. rewrite E.
    apply (order_of_sized 23 (-149) _ m e _ n g ltac:(lia) S T H).
  - pose proof (bits_of_largest a Fa) as L. change (bits_of_b32 ten_thousand) with 1176256512%Z in H. lia.
Qed.

Lemma bits32_range : forall a, is_finite 24 128 a = true -> (0 <= bits_of_b32 (b32_abs a) < 2 ^ 31)%Z.
Proof.
  intros a Fa. destruct a as [s|s|s pl Hpl|s m e H]; try discriminate; [split; [apply Z.leb_le|apply Z.ltb_lt]; reflexivity|].
  destruct (bits32_sized (B754_finite 24 128 s m e H) eq_refl) as (n & g & (-> & Hg & Hn & Ng) & E).
  assert (g <= 104)%Z; [|lia]. destruct Ng as [->|Ng]; [lia|]. destruct (Z_le_gt_dec g 104) as [L|L]; [exact L|exfalso].
  pose proof (abs_B2R_lt_emax 24 128 (B754_finite 24 128 s m e H)) as U. rewrite E in U.
  apply Rlt_not_le in U. apply U. replace 128%Z with (23 + 105)%Z by reflexivity. rewrite bpow_plus.
  apply Rmult_le_compat; try apply bpow_ge_0; [|apply bpow_le; lia].
  change (bpow radix2 23) with (IZR (2 ^ 23)). now apply IZR_le.
Qed.

Lemma not_tiny_is : forall set least a l, is_finite 24 128 a = true -> value32 least = l -> is_finite 24 128 least = true ->
  bpow radix2 (-30) <= l -> is_tiny set least (absolute32 a) = false -> value32 a = 0 \/ l <= Rabs (value32 a).
Proof.
  intros set least a l Fa <- Fl Hl H. unfold absolute32 in H.
  destruct (bits32_sized a Fa) as (m & e & S & E). destruct (bits32_sized least Fl) as (n & g & T & G).
  pose proof (bits32_range a Fa) as Ra. pose proof (bits32_range least Fl) as Rl.
  assert (A : b32_abs least = least).
  { pose proof (bpow_gt_0 radix2 (-30)). destruct least as [s|s|s pl Hpl|s k f Hf]; try discriminate; [simpl in Hl; lra|].
    destruct s; [|reflexivity]. exfalso. assert (value32 (B754_finite 24 128 true k f Hf) < 0) by now apply F2R_lt_0. lra. }
  rewrite A in T, Rl. rewrite Rabs_pos_eq in G by (pose proof (bpow_ge_0 radix2 (-30)); lra).
  assert (L2 : (2 <= bits_of_b32 least)%Z).
  { destruct (Z_le_gt_dec 2 (bits_of_b32 least)) as [L|L]; [exact L|exfalso]. destruct T as (EB & Hg & Hn & Ng).
    assert (g = -149)%Z by lia. subst g. assert (n <= 1)%Z by lia. apply Rle_not_lt in Hl. apply Hl. rewrite G.
    apply Rle_lt_trans with (1 * bpow radix2 (-149)); [apply Rmult_le_compat_r; [apply bpow_ge_0|now apply (IZR_le n 1)]|].
    rewrite Rmult_1_l. apply bpow_lt. lia. }
  set (A' := bits_of_b32 (b32_abs a)) in *. set (B := bits_of_b32 least) in *.
  destruct (Z.eq_dec A' 0) as [Z0|Z0].
  - left. destruct S as (ES & He & Hm & Me). assert (m = 0%Z) by lia. subst m. rewrite Rmult_0_l in E.
    destruct (Req_dec (value32 a) 0) as [|Hne]; [assumption|]. apply Rabs_pos_lt in Hne. lra.
  - right. rewrite E, G. apply (order_of_sized 23 (-149) _ n g _ m e ltac:(lia) T S).
    unfold is_tiny, word32 in H. fold A' B in H. destruct set.
    + apply Z.leb_gt in H. rewrite !Z.mod_small in H by lia. lia.
    + apply Z.ltb_ge in H. rewrite !Z.mod_small in H by lia. lia.
Qed.

Lemma bits64_with_sign : forall a : binary64, is_finite 53 1024 a = true -> exists s,
  bits_of_b64 a = (s * 2 ^ 63 + bits_of_b64 (b64_abs a))%Z /\ (0 <= bits_of_b64 (b64_abs a) < 2 ^ 63)%Z.
Proof.
  intros a Fa. destruct a as [s|s|s pl Hpl|s m e H]; try discriminate.
  - exists (if s then 1 else 0)%Z. split; [now destruct s|split; [apply Z.leb_le|apply Z.ltb_lt]; reflexivity].
  - exists (if s then 1 else 0)%Z. destruct (bits64_sized (B754_finite 53 1024 s m e H) eq_refl) as (n & g & (EB & Hg & Hn & Ng) & E).
    split.
    + unfold b64_abs, Babs, bits_of_b64, bits_of_binary_float. cbv beta iota zeta. unfold join_bits. rewrite !Z.shiftl_mul_pow2 by lia.
      destruct s; case Zle_bool_spec; intro L; lia.
    + rewrite EB. assert (g <= 971)%Z; [|lia]. destruct Ng as [->|Ng]; [lia|].
      destruct (Z_le_gt_dec g 971) as [L|L]; [exact L|exfalso].
      pose proof (abs_B2R_lt_emax 53 1024 (B754_finite 53 1024 s m e H)) as U. rewrite E in U.
      apply Rlt_not_le in U. apply U. replace 1024%Z with (52 + 972)%Z by reflexivity. rewrite bpow_plus.
      apply Rmult_le_compat; try apply bpow_ge_0; [|apply bpow_le; lia].
      change (bpow radix2 52) with (IZR (2 ^ 52)). now apply IZR_le.
Qed.

Lemma not_near_is : forall least a l, is_finite 53 1024 a = true -> is64 least l -> 0 < l -> is_near least a = false ->
  l < Rabs (value64 a).
Proof.
  intros least a l Fa [<- Fl] Hl H. destruct (bits64_sized a Fa) as (m & e & S & ->).
  destruct (bits64_sized least Fl) as (n & g & T & G). rewrite Rabs_pos_eq in G by lra. rewrite G.
  destruct (bits64_with_sign a Fa) as (s & Ea & Ra). destruct (bits64_with_sign least Fl) as (t & El & Rl).
  unfold is_near, high_word in H. apply Z.leb_gt in H. change (2 ^ 31 - 1)%Z with (Z.ones 31) in H. rewrite Z.land_ones in H by lia.
  assert (A : b64_abs least = least).
  { destruct least as [c|c|c pl Hpl|c k f Hf]; try discriminate; [simpl in Hl; lra|].
    destruct c; [|reflexivity]. exfalso. assert (value64 (B754_finite 53 1024 true k f Hf) < 0) by now apply F2R_lt_0. lra. }
  rewrite A in *. rewrite Ea in H. set (b := bits_of_b64 (b64_abs a)) in *.
  replace (s * 2 ^ 63 + b)%Z with (b + s * 2 ^ 31 * 2 ^ 32)%Z in H by ring. rewrite Z.div_add in H by lia.
  rewrite Z.mod_add in H by lia.
  rewrite Z.mod_small in H by (split; [apply Z.div_pos; lia|apply Z.div_lt_upper_bound; lia]).
  assert (L : (bits_of_b64 least < b)%Z).
  { destruct (Z_lt_ge_dec (bits_of_b64 least) b) as [L|L]; [exact L|exfalso].
    pose proof (Z.div_le_mono b (bits_of_b64 least) (2 ^ 32) ltac:(lia) ltac:(lia)). lia. }
  apply (order_of_sized 52 (-1074) _ n g _ m e ltac:(lia) T S); lia.
Qed.

Lemma not_beside_tie : forall W a, is_beside_tie W a = false -> in_doubt W (bits_of_b64 a) = false.
Proof.
  intros W a H. unfold in_doubt. destruct (W =? 0)%Z; [reflexivity|]. unfold is_beside_tie, word32 in H.
  set (b := bits_of_b64 a) in *. set (c := ((2 ^ 29 - 1) / 2 - W)%Z) in *. change (2 ^ 29 - 1)%Z with (Z.ones 29) in *.
  rewrite Z.land_ones in H |- * by lia.
  rewrite <- (Zmod_div_mod (2 ^ 29) (2 ^ 32)) in H; [|reflexivity|reflexivity|now exists (2 ^ 3)%Z].
  rewrite <- (Zmod_div_mod (2 ^ 29) (2 ^ 64)); [|reflexivity|reflexivity|now exists (2 ^ 35)%Z].
  rewrite <- Zplus_mod_idemp_l in H |- *.
  rewrite <- (Zmod_div_mod (2 ^ 29) (2 ^ 32) b) in H; [exact H|reflexivity|reflexivity|now exists (2 ^ 3)%Z].
Qed.

(* The numbers that the watch lets pass. *)
Lemma free_lane : forall set lane, is_free set lane = true ->
  (forall a, In a (sizes lane) -> is_large a = false) /\
  (forall a, In a (not_tiny lane) -> is_tiny set (least_coordinate lane) a = false) /\
  (forall a, In a (distances lane) -> is_near (least_distance lane) a = false) /\
  (forall a, In a (doubts lane) -> a = false) /\
  (forall a, In a (roundings lane) -> is_beside_tie (lane_window lane) a = false).
Proof.
  assert (none : forall (A : Type) (f : A -> bool) l, existsb f l = false -> forall a, In a l -> f a = false).
  { intros A f l H a Ha. apply not_true_is_false. intro T. apply (eq_true_false_abs _ (proj2 (existsb_exists f l) (ex_intro _ a (conj Ha
    T))) H). }
  intros set lane H. unfold is_free in H. apply negb_true_iff in H. rewrite !orb_false_iff in H. destruct H as ((((H1 & H2) & H3) & H4) &
    H5).
  repeat split; intros a Ha; [now apply (none _ _ _ H1)|now apply (none _ _ _ H2)|now apply (none _ _ _ H3)| |now apply (none _ _ _ H5)].
  exact (none _ _ _ H4 a Ha).
Qed.
