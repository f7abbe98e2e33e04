(* SPDX-License-Identifier: BSD-3-Clause *)
(* The forms of a batch of the laws of planes and polygons: what the watch lets pass is right, for all inputs of the domain. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Mult_error BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Shaded Gap Polygons ErrorFree.
From Forceshade Require Import ThreePolygons DoubleDouble Depth Split DoubleDoubleHolds CylinderConstants SecondAlong.
From Forceshade Require Import TwoPolygonsConstants ThreePolygonsFace ThreePolygonsConstants NewtonThird SineOfThird ThreePolygonsRight.
From Forceshade Require Import CylinderFirst.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch.
Import ListNotations.
Open Scope R_scope.

Ltac lane_fields := cbn [sizes not_tiny distances doubts roundings lane_window least_coordinate least_distance force_x force_z].
Ltac in_list := cbn [In]; tauto.

Lemma right_lane_iff : forall fx fz (A B : Prop) Fx Fz, (A <-> B) -> right_lane fx fz A Fx Fz -> right_lane fx fz B Fx Fz.
Proof. intros fx fz A B Fx Fz H [P Q]. split; intro T; [apply P|apply Q]; tauto. Qed.

(* ---- wall and bump-1p ---- *)

Theorem wall_lane_is_right : forall set R w K x z, stiffness K ->
  right_where_free set (form_of_wall R w K x z) (exact_wall (value32 K)) x z.
Proof.
  intros set R w K x z [FK HK] H. destruct (free_lane _ _ H) as (A & B & _ & _ & _). clear H.
  unfold form_of_wall, wall_form in *. cbv zeta in *. revert A B. lane_fields. intros A B.
  pose proof (not_large x (A (absolute32 x) ltac:(in_list))) as Hx.
  destruct (watched_coordinate set quantum _ z quantum_is ltac:(lra) (A (absolute32 z) ltac:(in_list)) (B (absolute32 z) ltac:(in_list)))
    as (Hz & _ & Ez & Tz).
  split; [exact Hx|]. split; [exact Hz|]. rewrite Ez. cbn [exact_wall force in_contact exact_x exact_z].
  change (rounded zero64) with zero32. apply wall_lane_is; try assumption.
  apply minus_K_is with (value32 K); [exact HK|now apply to64_is_exact|]. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra.
Qed.

Theorem bump_1p_lane_is_right : forall set R w K x z, stiffness K ->
  right_where_free set (form_of_bump_1p R w K x z) (exact_bump_1p (value32 R) (value32 w) (value32 K)) x z.
Proof. exact wall_lane_is_right. Qed.

(* ---- The plane of shaded bumps: K/R times R is K, once it is rounded ---- *)

Lemma shaded_minus_K : forall R w K, parameters R w K -> is32 (rounded (opp (times (K_over_R K R) (to64 R)))) (- value32 K).
Proof.
  intros R w K ((FR & _ & FK) & HR & _ & HK).
  assert (CK : computes (to64 K) 0 (value32 K) (-10) 10) by (apply exactly; [now apply to64_is_exact|now apply size_of_stiffness]).
  assert (CR : computes (to64 R) 0 (value32 R) (-4) 14) by (apply exactly; [now apply to64_is_exact|now apply size_of_radius]).
  assert (H1 : 1 <= one <= 11 / 10) by (unfold one; lra).
  pose proof (computes_over _ _ _ _ _ _ _ _ _ _ CK CR ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as CKR.
  destruct (computes_times _ _ _ _ _ _ _ _ _ _ CKR CR ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as (a & Ia & Na & _).
  apply minus_K_is with a; [exact HK|exact Ia|].
  replace (value32 K / value32 R * value32 R) with (value32 K) in Na by (field; lra).
  pose proof (near_is_close _ _ _ Na ltac:(lra)) as C. rewrite (Rabs_pos_eq (value32 K)) in C by lra.
  apply Rle_trans with (1 := C). apply Rmult_le_compat_r; [lra|]. unfold unit53. lra.
Qed.

Lemma plain_minus_K : forall R w K, parameters R w K -> is32 (rounded (opp (to64 K))) (- value32 K).
Proof.
  intros R w K ((_ & _ & FK) & _ & _ & HK). apply minus_K_is with (value32 K); [exact HK|now apply to64_is_exact|].
  rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra.
Qed.

(* The shaded force at |x|, with the sign of x. *)
Lemma shaded_lane_is : forall Rad w K X M, 0 < Rad -> w <= 2 * Rad -> let inside := Rle_bool (Rabs X) (w / 2) in
  (if inside then if Rlt_bool X 0 then - (M * (K / Rad) * Rabs X) else M * (K / Rad) * Rabs X else 0) = shaded_x Rad w K X M /\
  (if inside then M * (K / Rad) * sqrt ((Rad - Rabs X) * (Rad + Rabs X)) else K * M) = shaded_z Rad w K X M.
Proof.
  intros Rad w K X M HR Hw inside. unfold shaded_x, shaded_z, inside. destruct (Rle_bool (Rabs X) (w / 2)); split; try (field; lra).
  - case Rlt_bool_spec; intro H; [rewrite Rabs_left by exact H|rewrite Rabs_pos_eq by lra]; field; lra.
  - replace ((Rad - Rabs X) * (Rad + Rabs X)) with (Rsqr Rad - Rsqr (Rabs X)) by (unfold Rsqr; ring). rewrite <- Rsqr_abs. field. lra.
Qed.

Lemma plane_depth : forall zv Z, coordinate zv Z -> depth_is 0 (larger (opp zv) zero64) (- Z).
Proof.
  intros zv Z [Hz _ _ S]. pose proof (opp_is _ _ Hz) as I. split; [|split; [|now apply larger_not_negative with (- Z)]]; intro HM.
  - destruct S as [->|S]; [lra|]. apply computes_more with 0 (-30)%Z 14%Z; try lia; [|lra]. apply exactly.
    + rewrite <- (Rmax_left (- Z) 0) by lra. apply larger_is; [exact I|apply zero_is].
    + unfold size in *. now rewrite Rabs_Ropp.
  - apply larger_is_zero with (- Z); [exact I|lra].
Qed.

Lemma size_not_negative : forall x a, is32 x a -> not_negative (widened (absolute32 x)).
Proof.
  intros x a [_ F]. destruct x as [s|s|s pl H|s m e H]; try discriminate; [now split|].
  assert (P : 0 < value32 (absolute32 (B754_finite 24 128 s m e H))) by (unfold absolute32, b32_abs; now apply F2R_gt_0).
  destruct (to64_is_exact (absolute32 (B754_finite 24 128 s m e H)) eq_refl) as [V F2].
  apply positive_is_not_negative with (value32 (absolute32 (B754_finite 24 128 s m e H))); [now split|exact P].
Qed.

Lemma shaded_lane : forall k n R w K x z depth M law, parameters R w K -> (0 < k <= 2 ^ 20)%Z -> in_range x -> in_range z ->
  coordinate (to64 x) (value32 x) -> value32 z = 0 \/ bpow radix2 (-30) <= Rabs (value32 z) ->
  0 <= n <= 7 / 2 -> (n + 9 / 2 * one) * (1001 / 1000) <= IZR k ->
  let ax := widened (absolute32 x) in let scale := times depth (K_over_R K R) in
  let cx := times scale ax in let cz := times scale (shading_form R ax) in
  is_beside_tie (k + 1) cx = false -> is_beside_tie (k + 1) cz = false ->
  (Rabs (value32 x) <= value32 w / 2 -> depth_is n depth M) ->
  law = (if Rle_bool (Rabs (value32 x)) (value32 w / 2) then M else - value32 z) ->
  let inside := is_at_most32 (absolute32 x) (rounded (half_width w)) in
  right_lane (plus32 (where32 inside (times_sign32 (rounded cx) (plus32 x zero32))) zero32)
    (choice32 inside (rounded cz) (wall_lane (rounded (opp (times (K_over_R K R) (to64 R)))) z))
    (0 < law) (shaded_x (value32 R) (value32 w) (value32 K) (value32 x) law) (shaded_z (value32 R) (value32 w) (value32 K) (value32 x) law).
Proof.
  intros k n R w K x z depth M law Hp Hk Hx Hz Cx Tz Hn Hkn ax scale cx cz Tx Tcz D -> inside.
  destruct (half_is _ _ _ Hp) as [_ Ih]. pose proof (shaded_minus_K _ _ _ Hp) as Im. pose proof Hp as (_ & HR & Hw & HK).
  pose proof (size_coordinate x Hx Cx) as Cs. fold ax in Cs. set (X := value32 x) in *. set (Z := value32 z) in *.
  set (G := M * (value32 K / value32 R)).
  pose proof (bump_lane k x z _ _ _ _ cx cz inside true (G * Rabs X) (G * sqrt ((value32 R - Rabs X) * (value32 R + Rabs X))) M
    Hk Hx Hz Tz Ih Im HK Tx Tcz) as P. cbv zeta in P. fold inside in P. specialize (P ltac:(now rewrite andb_true_r)).
  fold X in P. fold Z in P.
  destruct (shaded_lane_is (value32 R) (value32 w) (value32 K) X (if Rle_bool (Rabs X) (value32 w / 2) then M else - Z) ltac:(lra)
    ltac:(lra))
    as [<- <-].
  assert (Q : Rabs X <= value32 w / 2 -> (0 < M -> good k cx (G * Rabs X) /\
      good k cz (G * sqrt ((value32 R - Rabs X) * (value32 R + Rabs X))) /\ not_negative cz) /\ (~ 0 < M -> cx = zero64 /\ cz = zero64)).
  { intro Hin. destruct (shaded_components k n R w K ax (Rabs X) depth M Hp Cs ltac:(split; [apply Rabs_pos|lra]) (D Hin) Hn Hkn) as [Q1
    Q2].
    split; [exact Q1|]. intro HM. apply Q2; [exact HM|]. apply size_not_negative with X. split; [reflexivity|apply Hx]. }
  specialize (P Q). unfold G in P. destruct (Rle_bool (Rabs X) (value32 w / 2)); exact P.
Qed.

Theorem bump_1p_shaded_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_bump_1p_shaded R w K x z) (exact_bump_1p_shaded (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp H. destruct (free_lane _ _ H) as (A & B & _ & _ & E). clear H.
  unfold form_of_bump_1p_shaded, bump_1p_shaded_form in *. cbv zeta in *. revert A B E. lane_fields. intros A B E.
  destruct (watched_coordinate set quantum _ x quantum_is ltac:(lra) (A (absolute32 x) ltac:(in_list)) (B (absolute32 x) ltac:(in_list)))
    as (Hx & Cx & Ex & _).
  destruct (watched_coordinate set quantum _ z quantum_is ltac:(lra) (A (absolute32 z) ltac:(in_list)) (B (absolute32 z) ltac:(in_list)))
    as (Hz & Cz & Ez & Tz).
  split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez. cbn [exact_bump_1p_shaded force in_contact exact_x exact_z].
  assert (H1 : 1 <= one <= 11 / 10) by (unfold one; lra).
  change (rounded zero64) with zero32. apply right_lane_iff with (0 < - value32 z); [lra|].
  refine (shaded_lane 8 0 R w K x z (larger (opp (widened z)) zero64) (- value32 z) (- value32 z) Hp ltac:(lia) Hx Hz Cx Tz ltac:(lra)
    ltac:(lra) _ _ _ _).
  - exact (E _ ltac:(cbn [In]; left; reflexivity)).
  - exact (E _ ltac:(cbn [In]; right; left; reflexivity)).
  - intros _. now apply plane_depth.
  - now destruct (Rle_bool _ _).
Qed.

(* ---- Two polygons ---- *)

Lemma binary32_in_64 : forall a, in_binary32 a -> in_binary64 a.
Proof. intros a G. apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|exact G]. Qed.

(* w/2 - |x|, where |x| is 0 or not far below w/2. *)
Lemma distance_is : forall half c v a, is64 half c -> in_binary32 c -> is64 v a -> in_binary32 a -> 0 <= a <= c -> 0 < c <= 10000 ->
  a = 0 \/ (bpow radix2 (-30) <= a /\ bpow radix2 (-28) * c <= a) -> is64 (minus half v) (c - a).
Proof.
  intros half c v a Ic Gc Ia Ga Ha Hc S. apply minus_exact with c a; try assumption; [reflexivity| |].
  - apply exact_difference; try assumption; [|tauto]. destruct S as [S|[S _]]; [now left|right]. apply Rle_trans with (2 := S). apply
    bpow_le. lia.
  - rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia].
Qed.

Lemma side_height_at : forall h ht s st H S half c v a, linear h ht s st H S -> H = S * c -> is64 half c -> in_binary32 c ->
  is64 v a -> in_binary32 a -> 0 <= a <= c -> 0 < c <= 10000 ->
  a = 0 \/ (bpow radix2 (-30) <= a /\ bpow radix2 (-28) * c <= a) -> height_at s st (minus half v) (value64 h) (H - S * a).
Proof.
  intros h ht s st H S half c v a [(Fh & Fht & Fs & Fst) Bits Rh Rht Rhe Rs Rst Rse] EH Ic Gc Ia Ga Ha Hc Hs.
  pose proof (distance_is _ _ _ _ Ic Gc Ia Ga Ha Hc Hs) as Id.
  exists (value64 s), (value64 st), (c - a). split; [now split|]. split; [now split|]. split; [exact Id|]. split; [exact Rh|].
  set (x := value64 s) in *. set (t := value64 st) in *. set (d := c - a) in *. set (e := S - (x + t)) in *.
  assert (Hd : 0 <= d <= c) by (unfold d; lra).
  assert (Pc : 0 <= x * c) by (apply Rmult_le_pos; lra). assert (Pd : 0 <= x * d) by (apply Rmult_le_pos; lra).
  assert (Pcd : x * d <= x * c) by (apply Rmult_le_compat_l; lra).
  assert (scaled : forall b q l, Rabs b <= l * x -> 0 <= q -> Rabs (b * q) <= l * (x * q)).
  { intros b q l Hb Hq. rewrite Rabs_mult, (Rabs_pos_eq q) by exact Hq. rewrite <- Rmult_assoc. now apply Rmult_le_compat_r. }
  pose proof (scaled _ c _ Rst ltac:(lra)) as Tc. pose proof (scaled _ d _ Rst ltac:(lra)) as Td.
  pose proof (scaled _ c _ Rse ltac:(lra)) as Ec. pose proof (scaled _ d _ Rse ltac:(lra)) as Ed. fold e in Ec, Ed.
  assert (E1 : H = x * c + t * c + e * c) by (rewrite EH; unfold e; ring).
  assert (E2 : H - S * a = x * d + t * d + e * d) by (rewrite EH; unfold e, d; ring).
  replace (H - S * a - (x * d + t * d)) with (e * d) by (rewrite E2; ring). rewrite E2.
  apply Rabs_le_inv in Rht. apply Rabs_le_inv in Rhe. pose proof (Rabs_le_inv _ _ Tc) as Tc'. pose proof (Rabs_le_inv _ _ Ec) as Ec'.
  pose proof (Rabs_le_inv _ _ Td) as Td'. pose proof (Rabs_le_inv _ _ Ed) as Ed'.
  set (p := x * c) in *. set (q := x * d) in *. clearbody p q.
  assert (Bp : p <= 1000001 / 1000000 * value64 h) by (unfold tail_share, slope_share, height_share, unit53 in *; lra).
  split; [unfold tail_share, slope_share in *; lra|]. split; [lra|]. split.
  - apply Rle_trans with (1 := Td). unfold tail_share. lra.
  - apply Rle_trans with (1 := Ed). unfold slope_share, unit53. lra.
Qed.

Lemma height_of_2p : forall Rad w, 0 < w -> bump_height Rad w = slope_2p Rad w * (w / 2).
Proof. intros Rad w Hw. unfold slope_2p. field. lra. Qed.

(* The coordinates that the watch lets pass. *)
Lemma watched_coordinates : forall set R w K x z, parameters R w K ->
  let least := greatest32 quantum (rounded (times (two_to (-28)) (half_width w))) in
  (forall a, In a [absolute32 z; absolute32 x] -> is_large a = false) ->
  (forall a, In a [absolute32 z; absolute32 x] -> is_tiny set least a = false) ->
  in_range x /\ in_range z /\ coordinate (to64 x) (value32 x) /\ coordinate (to64 z) (value32 z) /\
  read (value32 x) = value32 x /\ read (value32 z) = value32 z /\ (value32 z = 0 \/ bpow radix2 (-30) <= Rabs (value32 z)) /\
  (Rabs (value32 x) = 0 \/ (bpow radix2 (-30) <= Rabs (value32 x) /\ bpow radix2 (-28) * (value32 w / 2) <= Rabs (value32 x))).
Proof.
  intros set R w K x z Hp least A B. destruct (least_of_width _ _ _ Hp) as (l & Il & L1 & L2). fold least in Il.
  destruct (watched_coordinate set least l x Il L1 (A (absolute32 x) ltac:(in_list)) (B (absolute32 x) ltac:(in_list))) as (Hx & Cx & Ex &
    Tx).
  destruct (watched_coordinate set least l z Il L1 (A (absolute32 z) ltac:(in_list)) (B (absolute32 z) ltac:(in_list))) as (Hz & Cz & Ez &
    Tz).
  repeat (split; [assumption|]). split; [destruct Tz as [T|T]; [now left|right; lra]|].
  destruct Tx as [T|T]; [left; rewrite T; apply Rabs_R0|right; lra].
Qed.

Lemma force_of_sides : forall w K S X M leans Ex Ez, Ex = M * (K * sine_of S) -> Ez = M * (K *
  cosine_of S) ->
  leans = true \/ sine_of S = 0 ->
  let inside := Rle_bool (Rabs X) (w / 2) in
  (if inside then if (leans : bool) then if Rlt_bool X 0 then - Ex else Ex else 0 else 0) = side_x w K S X M /\
  (if inside then Ez else K * M) = side_z w K S X M.
Proof.
  intros w K S X M leans Ex Ez -> -> HL inside. unfold side_x, side_z, inside. destruct (Rle_bool _ _); split; try ring.
  destruct leans; destruct (Rlt_bool X 0); try ring; destruct HL as [HL|HL]; try discriminate HL; rewrite HL; ring.
Qed.

(* The lane of a bump that is not shaded, given the depth and the force at the side or on the top. *)
Lemma sides_lane : forall R w K x z depth M factor_z n S (leans : bool) law sideways K_sine, parameters R w K -> in_range x -> in_range z ->
  value32 z = 0 \/ bpow radix2 (-30) <= Rabs (value32 z) ->
  is_beside_tie 9 (times depth K_sine) = false -> is_beside_tie 9 (times depth factor_z) = false ->
  (Rabs (value32 x) <= value32 w / 2 -> depth_is (7 / 2) depth M) ->
  computes factor_z n (value32 K * cosine_of S) (-50) 10 -> 0 <= n <= 2 -> 0 < cosine_of S ->
  (exists E, factor K_sine E /\ 0 < E /\ (leans = true -> E = value32 K * sine_of S)) ->
  leans = true \/ sine_of S = 0 ->
  law = (if Rle_bool (Rabs (value32 x)) (value32 w / 2) then M else - value32 z) ->
  let inside := is_at_most32 (absolute32 x) (rounded (half_width w)) in sideways = inside && leans ->
  right_lane (plus32 (where32 sideways (times_sign32 (rounded (times depth K_sine)) (plus32 x zero32))) zero32)
    (choice32 inside (rounded (times depth factor_z)) (wall_lane (rounded (opp (to64 K))) z))
    (0 < law) (side_x (value32 w) (value32 K) S (value32 x) law) (side_z (value32 w) (value32 K) S (value32 x) law).
Proof.
  intros R w K x z depth M fz n S leans law sideways K_sine Hp Hx Hz Tz T1 T2 D Cz Hn Hcos (E & HE & E0 & ES) HL -> inside Es.
  destruct (half_is _ _ _ Hp) as [_ Ih]. pose proof (plain_minus_K _ _ _ Hp) as Im. pose proof Hp as (_ & HR & Hw & HK).
  set (X := value32 x) in *. set (Z := value32 z) in *.
  pose proof (bump_lane 8 x z _ _ _ _ (times depth K_sine) (times depth fz) sideways leans (M * E) (M * (value32 K * cosine_of S)) M
    ltac:(lia) Hx Hz Tz Ih Im HK T1 T2 Es) as P. fold X in P. fold Z in P. fold inside in P.
  assert (Q : Rabs X <= value32 w / 2 -> (0 < M -> good 8 (times depth K_sine) (M * E) /\
      good 8 (times depth fz) (M * (value32 K * cosine_of S)) /\ not_negative (times depth fz)) /\
      (~ 0 < M -> times depth K_sine = zero64 /\ times depth fz = zero64)).
  { intro Hin. specialize (D Hin).
    destruct (unshaded_components depth M K_sine (101 / 100) E D (factor_computes _ _ HE) ltac:(lra) E0) as [X1 X2].
    destruct (unshaded_components depth M fz n (value32 K * cosine_of S) D Cz Hn ltac:(apply Rmult_lt_0_compat; lra)) as [Z1 Z2].
    split; intro HM; [split; [now apply X1|now apply Z1]|split; [now apply X2|now apply Z2]]. }
  specialize (P Q).
  destruct (force_of_sides (value32 w) (value32 K) S X (if Rle_bool (Rabs X) (value32 w / 2) then M else - Z) leans _ _ eq_refl
    eq_refl HL) as [<- <-].
  destruct (Rle_bool (Rabs X) (value32 w / 2)); [|exact P]. destruct leans; [|exact P]. now rewrite <- (ES eq_refl).
Qed.

Lemma depth_of_2p : forall R w x zv Z height height_tail slope slope_tail, parameters R w x ->
  linear height height_tail slope slope_tail (bump_height (value32 R) (value32 w)) (slope_2p (value32 R) (value32 w)) ->
  coordinate zv Z -> forall v X, coordinate v (Rabs X) -> Rabs X <= value32 w / 2 ->
  Rabs X = 0 \/ (bpow radix2 (-30) <= Rabs X /\ bpow radix2 (-28) * (value32 w / 2) <= Rabs X) ->
  let gap := gap_form slope slope_tail (minus (half_width w) v) zv in
  is_near (times (two_to (-20)) height) gap = false ->
  depth_is (7 / 2) (larger gap zero64) (bump_height (value32 R) (value32 w) - slope_2p (value32 R) (value32 w) * Rabs X - Z).
Proof.
  intros R w K zv Z h ht s st Hp L Cz v X Cv HX SX gap W. pose proof (half_width_is _ _ _ Hp) as Ic. destruct (half_is _ _ _ Hp) as [Gc _].
  destruct Hp as (_ & HR & Hw & _). apply depth_form_is with (value64 h) h; [|split; [reflexivity|apply L]|exact Cz|exact W].
  apply side_height_at with ht (value32 w / 2); try assumption; [now apply height_of_2p; lra|apply Cv|apply Cv|split; [apply
    Rabs_pos|exact HX]|lra].
Qed.

Lemma penetration_of_2p : forall Rad w X Z, 0 < w ->
  penetration_2p Rad w X Z = (if Rle_bool (Rabs X) (w / 2) then bump_height Rad w - slope_2p Rad w * Rabs X - Z else - Z).
Proof. intros Rad w X Z Hw. unfold penetration_2p, slope_2p. destruct (Rle_bool _ _); [field; lra|reflexivity]. Qed.

Theorem bump_2p_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_bump_2p R w K x z) (exact_bump_2p (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp H. destruct (constants_2p_are_right R w K Hp) as [L Hs Hc].
  destruct (free_lane _ _ H) as (A & B & C & _ & E). clear H.
  unfold form_of_bump_2p, with_gap, bump_2p_form in *. cbv zeta in *. revert A B C E. lane_fields. intros A B C E.
  destruct (watched_coordinates set R w K x z Hp A B) as (Hx & Hz & Cx & Cz & Ex & Ez & Tz & Tx).
  pose proof (size_coordinate x Hx Cx) as Cs. split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez.
  cbv zeta. unfold exact_bump_2p. cbn [force in_contact exact_x exact_z]. change (rounded zero64) with zero32.
  pose proof Hp as (_ & HR & Hw & HK).
  assert (Pc : forall v e, factor v (value32 K * e) -> 0 <= e -> 0 < e).
  { intros v e (_ & _ & [S _]) He. destruct He as [He|He]; [exact He|]. rewrite <- He, Rmult_0_r, Rabs_R0 in S.
    pose proof (bpow_gt_0 radix2 (-50)). lra. }
  assert (Hcos : 0 < cosine_of (slope_2p (value32 R) (value32 w))).
  { apply Pc with (1 := Hc). unfold cosine_of. apply Rlt_le. apply Rdiv_lt_0_compat; [lra|]. apply sqrt_lt_R0.
    pose proof (Rle_0_sqr (slope_2p (value32 R) (value32 w))). lra. }
  pose proof (E _ (or_introl eq_refl)) as E1. pose proof (E _ (or_intror (or_introl eq_refl))) as E2.
  pose proof (C _ (or_introl eq_refl)) as C1. clear A B C E.
  refine (sides_lane R w K x z _ _ _ (101 / 100)
    (slope_2p (value32 R) (value32 w)) true _ _ _ Hp Hx Hz Tz E1 E2 _ (factor_computes _ _ Hc) ltac:(lra) Hcos _ (or_introl eq_refl)
    (penetration_of_2p (value32 R) (value32 w) (value32 x) (value32 z) ltac:(lra)) _).
  - intro Hin. exact (depth_of_2p R w K (to64 z) (value32 z) (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w))
      (split_tail (tangent_2p R w)) Hp L Cz (widened (absolute32 x)) (value32 x) Cs Hin Tx C1).
  - exists (value32 K * sine_of (slope_2p (value32 R) (value32 w))). split; [exact Hs|]. split; [|reflexivity].
    apply Rmult_lt_0_compat; [lra|]. apply Pc with (1 := Hs). unfold sine_of. destruct L as [_ _ _ _ _ Rs Rst Rse].
    apply Rmult_le_pos; [|apply Rlt_le, Rinv_0_lt_compat, sqrt_lt_R0; pose proof (Rle_0_sqr (slope_2p (value32 R) (value32 w))); lra].
    apply Rabs_le_inv in Rst. apply Rabs_le_inv in Rse. unfold tail_share, slope_share in *. lra.
  - now rewrite andb_true_r.
Qed.

Theorem bump_2p_shaded_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_bump_2p_shaded R w K x z) (exact_bump_2p_shaded (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp H. pose proof (linear_2p_is_right R w K Hp) as L.
  destruct (free_lane _ _ H) as (A & B & C & _ & E). clear H.
  unfold form_of_bump_2p_shaded, with_gap, bump_2p_shaded_form in *. cbv zeta in *. revert A B C E. lane_fields. intros A B C E.
  destruct (watched_coordinates set R w K x z Hp A B) as (Hx & Hz & Cx & Cz & Ex & Ez & Tz & Tx).
  pose proof (size_coordinate x Hx Cx) as Cs. split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez.
  cbv zeta. unfold exact_bump_2p_shaded. cbn [force in_contact exact_x exact_z]. change (rounded zero64) with zero32.
  pose proof Hp as (_ & HR & Hw & HK). assert (H1 : 1 <= one <= 1001 / 1000) by (unfold one; lra).
  pose proof (E _ (or_introl eq_refl)) as E1. pose proof (E _ (or_intror (or_introl eq_refl))) as E2.
  pose proof (C _ (or_introl eq_refl)) as C1. clear A B C E.
  refine (shaded_lane 12 (7 / 2) R w K x z _
    _ _ Hp ltac:(lia) Hx Hz Cx Tz ltac:(lra) ltac:(lra) E1 E2 _ (penetration_of_2p (value32 R) (value32 w) (value32 x) (value32 z)
      ltac:(lra))).
  - intro Hin. exact (depth_of_2p R w K (to64 z) (value32 z) (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w))
      (split_tail (tangent_2p R w)) Hp L Cz (widened (absolute32 x)) (value32 x) Cs Hin Tx C1).
Qed.
