(* SPDX-License-Identifier: BSD-3-Clause *)
(* On which side of a triangle's plane a position is: side_of() of fast/meshes/decide.h is right wherever binary64 decides it, for all
   triangles and positions of the domain. *)
From Coq Require Import ZArith Reals Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness Vectors MeshConstants MeshSigns.
Open Scope R_scope.

(* A corner or a position, and a vector of binary64. *)
Record point := Point { x32 : binary32; y32 : binary32; z32 : binary32 }.
Record vector64 := Vector64 { x64 : binary64; y64 : binary64; z64 : binary64 }.

(* difference(), cross(), dot() and size_of() of fast/meshes/vector3.h *)
Definition difference64 (a b : point) : vector64 :=
  Vector64 (Operations.minus (to64 (x32 a)) (to64 (x32 b))) (Operations.minus (to64 (y32 a)) (to64 (y32 b)))
    (Operations.minus (to64 (z32 a)) (to64 (z32 b))).
Definition cross64 (a b : vector64) : vector64 :=
  Vector64 (Operations.minus (times (y64 a) (z64 b)) (times (z64 a) (y64 b)))
    (Operations.minus (times (z64 a) (x64 b)) (times (x64 a) (z64 b)))
    (Operations.minus (times (x64 a) (y64 b)) (times (y64 a) (x64 b))).
Definition dot64 (a b : vector64) : binary64 :=
  Operations.plus (Operations.plus (times (x64 a) (x64 b)) (times (y64 a) (y64 b))) (times (z64 a) (z64 b)).
Definition size_of64 (a : vector64) : binary64 :=
  let x := absolute (x64 a) in let y := absolute (y64 a) in let z := absolute (z64 a) in
  let larger := if is_less y x then x else y in if is_less z larger then larger else z.

(* side_of(): `exact` is exact_side_of(), the sign of the polynomial in integers. *)
Definition side_of (a b c p : point) (exact : Z) : Z :=
  let e1 := difference64 b a in let e2 := difference64 c a in let w := difference64 p a in
  let across := dot64 (cross64 e1 e2) w in
  let error := times (times (code_error code_across) (times (size_of64 e1) (size_of64 e2))) (size_of64 w) in
  if is_less error (absolute across) then if is_less zero64 across then 1%Z else (-1)%Z else exact.

Definition sign (x : R) : Z := match Rcompare x 0 with Lt => (-1)%Z | Eq => 0%Z | Gt => 1%Z end.
Definition place (a : point) : vector := Vector (value32 (x32 a)) (value32 (y32 a)) (value32 (z32 a)).
(* In the domain, and a whole number of 2^-53 mm: positions and vertices are. *)
Definition is_coordinate (c : binary32) : Prop :=
  is_finite 24 128 c = true /\ is_grained 53 (value32 c) /\ Rabs (value32 c) <= 10000.
Definition is_point (a : point) : Prop := is_coordinate (x32 a) /\ is_coordinate (y32 a) /\ is_coordinate (z32 a).

(* ---- A difference of coordinates ---- *)

Definition part (a b : binary32) (scale : R) (known : bound) : polynomial :=
  component (Operations.minus (to64 a) (to64 b)) (value32 a - value32 b) scale 53 known.

Lemma difference_is : forall a b, is_coordinate a -> is_coordinate b ->
  let v := Operations.minus (to64 a) (to64 b) in
  is_finite 53 1024 v = true /\ is_grained 53 (value64 v) /\ Rabs (value64 v) <= bpow radix2 41 /\
  Rabs (value64 v - (value32 a - value32 b)) <= (1 + 2 * unit53) * unit53 * Rabs (value64 v).
Proof.
  intros a b (Fa & Ga & Ba) (Fb & Gb & Bb) v. pose proof (to64_is_exact a Fa) as Ia. pose proof (to64_is_exact b Fb) as Ib.
  pose proof unit_is_small as U.
  assert (B : Rabs (value32 a - value32 b) <= 20000).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  assert (B41 : 20000 <= bpow radix2 41) by (simpl; lra).
  assert (B1000 : Rabs (value32 a - value32 b) <= bpow radix2 1000).
  { apply Rle_trans with (1 := B), Rle_trans with (1 := B41), bpow_le. lia. }
  destruct (minus_is _ _ _ _ Ia Ib B1000) as [V F]. fold v in V, F.
  pose proof (grained_sum _ _ _ Ga (grained_opposite _ _ Gb)) as G. fold (value32 a - value32 b) in G.
  pose proof (grained_is_normal 53 _ ltac:(lia) G) as N. rewrite V. set (d := value32 a - value32 b) in *.
  split; [exact F|]. split; [now apply grained_rounded|]. split; [apply below_power; [lia|lra]|].
  assert (T : Rabs d <= Rabs (nearest64 d) + Rabs (nearest64 d - d)).
  { replace d with (nearest64 d - (nearest64 d - d)) at 1 by ring. unfold Rminus at 1. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite Rabs_Ropp. lra. }
  set (r := Rabs (nearest64 d)) in *. set (q := Rabs (nearest64 d - d)) in *. assert (0 <= r) by apply Rabs_pos.
  assert (unit53 * Rabs d <= unit53 * (r + q)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= unit53 * unit53 * r) by (repeat apply Rmult_le_pos; lra).
  assert (unit53 * (unit53 * unit53 * r) <= / 1000000000000 * (unit53 * unit53 * r)) by (apply Rmult_le_compat_r; lra).
  apply Rmult_le_reg_l with (1 - unit53); lra.
Qed.

Lemma part_is_homogeneous : forall a b s k, is_coordinate a -> is_coordinate b ->
  Rabs (value64 (Operations.minus (to64 a) (to64 b))) <= s -> size k = 1 -> (1 + 2 * unit53) * unit53 <= off k ->
  is_homogeneous (part a b s k).
Proof.
  intros a b s k A B S K O. destruct (difference_is a b A B) as (F & G & M & E). cbv zeta in F, G, M, E.
  pose proof unit_is_small as U. pose proof (Rabs_pos (value64 (Operations.minus (to64 a) (to64 b)))) as P.
  cbn [part is_homogeneous grain_of reach_of]. repeat split; try assumption; try lia; try lra.
  - assert (0 <= (1 + 2 * unit53) * unit53) by (apply Rmult_le_pos; lra). lra.
  - rewrite K. lra.
  - apply Rle_trans with (1 := E). apply Rmult_le_compat; try lra. apply Rmult_le_pos; lra.
Qed.

Lemma size_of_is : forall a b, is_point a -> is_point b ->
  let v := difference64 a b in let s := value64 (size_of64 v) in
  is_finite 53 1024 (size_of64 v) = true /\ is_grained 53 s /\ 0 <= s <= bpow radix2 41 /\
  Rabs (value64 (x64 v)) <= s /\ Rabs (value64 (y64 v)) <= s /\ Rabs (value64 (z64 v)) <= s.
Proof.
  intros a b (A1 & A2 & A3) (B1 & B2 & B3) v s.
  destruct (difference_is _ _ A1 B1) as (F1 & G1 & M1 & _). destruct (difference_is _ _ A2 B2) as (F2 & G2 & M2 & _).
  destruct (difference_is _ _ A3 B3) as (F3 & G3 & M3 & _). cbv zeta in *.
  change (Operations.minus (to64 (x32 a)) (to64 (x32 b))) with (x64 v) in *.
  change (Operations.minus (to64 (y32 a)) (to64 (y32 b))) with (y64 v) in *.
  change (Operations.minus (to64 (z32 a)) (to64 (z32 b))) with (z64 v) in *.
  pose proof (larger_is _ _ _ _ (larger_is _ _ _ _ (absolute_is _ _ (conj eq_refl F1)) (absolute_is _ _ (conj eq_refl F2)))
    (absolute_is _ _ (conj eq_refl F3))) as L.
  change (larger (larger (absolute (x64 v)) (absolute (y64 v))) (absolute (z64 v))) with (size_of64 v) in L.
  destruct L as [V F]. unfold s. rewrite V. split; [exact F|].
  assert (grained_size : forall x, is_grained 53 x -> is_grained 53 (Rabs x)) by (intros x X; now apply generic_format_abs).
  pose proof (Rabs_pos (value64 (x64 v))).
  unfold Rmax; repeat destruct (Rle_dec _ _); repeat split; try lra; try assumption; try (now apply grained_size).
Qed.

(* The bound of the code covers the polynomial's, times the sizes. *)
Lemma bound_covers : forall k s t w, is_finite 53 1024 k = true -> is_grained 100 (value64 k) -> 0 <= value64 k <= 1 ->
  is_finite 53 1024 s = true -> is_grained 53 (value64 s) -> 0 <= value64 s <= bpow radix2 41 ->
  is_finite 53 1024 t = true -> is_grained 53 (value64 t) -> 0 <= value64 t <= bpow radix2 41 ->
  is_finite 53 1024 w = true -> is_grained 53 (value64 w) -> 0 <= value64 w <= bpow radix2 41 ->
  is_finite 53 1024 (times (times k (times s t)) w) = true /\
  (1 - 4 * unit53) * (value64 k * (value64 s * value64 t) * value64 w) <= value64 (times (times k (times s t)) w).
Proof.
  intros k s t w Fk Gk Bk Fs Gs Bs Ft Gt Bt Fw Gw Bw. pose proof unit_is_small as U.
  set (K := value64 k) in *. set (S := value64 s) in *. set (T := value64 t) in *. set (W := value64 w) in *.
  assert (P : forall g a b x y, is64 a x -> is64 b y -> 0 <= x <= bpow radix2 100 -> 0 <= y <= bpow radix2 100 ->
    (0 <= g <= 1000)%Z -> is_grained g (x * y) ->
    exists z, is64 (times a b) z /\ is_grained g z /\ (1 - unit53) * (x * y) <= z <= 2 * (x * y)).
  { intros g a b x y A B X Y G H. exists (nearest64 (x * y)). assert (Q : 0 <= x * y) by (apply Rmult_le_pos; lra).
    assert (M : x * y <= bpow radix2 100 * bpow radix2 100) by (apply Rmult_le_compat; lra). rewrite <- bpow_plus in M.
    split.
    { apply times_is; try assumption. rewrite Rabs_pos_eq by exact Q. apply Rle_trans with (1 := M), bpow_le. lia. }
    split; [now apply grained_rounded|]. pose proof (grained_is_normal g _ G H) as N. rewrite (Rabs_pos_eq (x * y)) in N by exact Q.
    assert (unit53 * (x * y) <= 1 * (x * y)) by (apply Rmult_le_compat_r; lra). apply Rabs_le_inv in N. lra. }
  assert (B41 : bpow radix2 41 * bpow radix2 41 = bpow radix2 82) by now rewrite <- bpow_plus.
  assert (B82 : 2 * bpow radix2 82 = bpow radix2 83) by (change 2 with (bpow radix2 1); now rewrite <- bpow_plus).
  assert (B84 : 2 * bpow radix2 83 = bpow radix2 84) by (change 2 with (bpow radix2 1); now rewrite <- bpow_plus).
  assert (H100 : bpow radix2 84 <= bpow radix2 100) by (apply bpow_le; lia).
  assert (H41 : bpow radix2 41 <= bpow radix2 100) by (apply bpow_le; lia).
  assert (H83 : bpow radix2 83 <= bpow radix2 100) by (apply bpow_le; lia).
  assert (H1 : 1 <= bpow radix2 100) by (apply (bpow_le radix2 0); lia).
  destruct (P (53 + 53)%Z s t S T (conj eq_refl Fs) (conj eq_refl Ft)) as (st & Ist & Gst & Est); try lra; try lia;
    [now apply grained_product|].
  assert (Pst : 0 <= S * T <= bpow radix2 82).
  { rewrite <- B41. split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra. }
  assert (Qst : 0 <= (1 - unit53) * (S * T)) by (apply Rmult_le_pos; lra).
  destruct (P (100 + (53 + 53))%Z k (times s t) K st (conj eq_refl Fk) Ist) as (kst & Ikst & Gkst & Ekst); try lra; try lia;
    [now apply grained_product|].
  assert (Pkst : 0 <= K * st <= bpow radix2 83).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (1 * st); [apply Rmult_le_compat_r; lra|lra]. }
  assert (Qkst : 0 <= (1 - unit53) * (K * st)) by (apply Rmult_le_pos; lra).
  destruct (P (100 + (53 + 53) + 53)%Z (times k (times s t)) w kst W Ikst (conj eq_refl Fw)) as (r & [Vr Fr] & _ & Er); try lra; try lia;
    [now apply grained_product|].
  split; [exact Fr|]. rewrite Vr.
  assert (A1 : K * ((1 - unit53) * (S * T)) <= K * st) by (apply Rmult_le_compat_l; lra).
  assert (A2 : (1 - unit53) * (K * ((1 - unit53) * (S * T))) <= (1 - unit53) * (K * st)) by (apply Rmult_le_compat_l; lra).
  assert (A3 : (1 - unit53) * (K * ((1 - unit53) * (S * T))) * W <= kst * W) by (apply Rmult_le_compat_r; lra).
  assert (A4 : (1 - unit53) * ((1 - unit53) * (K * ((1 - unit53) * (S * T))) * W) <= (1 - unit53) * (kst * W))
    by (apply Rmult_le_compat_l; lra).
  assert (A5 : 0 <= K * (S * T) * W) by (repeat apply Rmult_le_pos; lra).
  assert (A6 : (1 - 4 * unit53) * (K * (S * T) * W) <= (1 - unit53) * (1 - unit53) * (1 - unit53) * (K * (S * T) * W))
    by (apply Rmult_le_compat_r; [exact A5|nra]).
  lra.
Qed.

(* n.w of the edges e and f and the way w, as decide.h writes it. *)
Definition across_of (ex ey ez fx fy fz wx wy wz : polynomial) : polynomial :=
  sum (sum (product (difference (product ey fz) (product ez fy)) wx) (product (difference (product ez fx) (product ex fz)) wy))
    (product (difference (product ex fy) (product ey fx)) wz).
Definition is_component (s : R) (p : polynomial) : Prop :=
  is_homogeneous p /\ grain_of p = 53%Z /\ reach_of p = 41%Z /\ scale_of p = s.
Lemma across_is_homogeneous : forall ex ey ez fx fy fz wx wy wz s t w, is_component s ex -> is_component s ey -> is_component s ez ->
  is_component t fx -> is_component t fy -> is_component t fz -> is_component w wx -> is_component w wy -> is_component w wz ->
  is_homogeneous (across_of ex ey ez fx fy fz wx wy wz).
Proof.
  intros ex ey ez fx fy fz wx wy wz s t w (H1 & G1 & R1 & S1) (H2 & G2 & R2 & S2) (H3 & G3 & R3 & S3) (H4 & G4 & R4 & S4)
    (H5 & G5 & R5 & S5) (H6 & G6 & R6 & S6) (H7 & G7 & R7 & S7) (H8 & G8 & R8 & S8) (H9 & G9 & R9 & S9).
  unfold across_of. cbn [is_homogeneous grain_of reach_of scale_of].
  rewrite ?G1, ?G2, ?G3, ?G4, ?G5, ?G6, ?G7, ?G8, ?G9, ?R1, ?R2, ?R3, ?R4, ?R5, ?R6, ?R7, ?R8, ?R9.
  rewrite ?S1, ?S2, ?S3, ?S4, ?S5, ?S6, ?S7, ?S8, ?S9.
  repeat split; try assumption; try lia; try (rewrite Rmult_comm with (r1 := s); reflexivity).
Qed.

Theorem side_of_is_right : forall a b c p exact, is_point a -> is_point b -> is_point c -> is_point p ->
  let side := dot (normal (place a) (place b) (place c)) (minus (place p) (place a)) in
  exact = sign side -> side_of a b c p exact = sign side.
Proof.
  intros a b c p exact A B C P side E. unfold side_of. cbv zeta.
  destruct (is_less _ _) eqn:L; [|exact E]. clear E.
  destruct (size_of_is b a B A) as (Fs & Gs & Bs & S1 & S2 & S3). destruct (size_of_is c a C A) as (Ft & Gt & Bt & T1 & T2 & T3).
  destruct (size_of_is p a P A) as (Fw & Gw & Bw & W1 & W2 & W3). cbv zeta in *.
  set (s := size_of64 (difference64 b a)) in *. set (t := size_of64 (difference64 c a)) in *.
  set (w := size_of64 (difference64 p a)) in *.
  destruct A as (A1 & A2 & A3), B as (B1 & B2 & B3), C as (C1 & C2 & C3), P as (P1 & P2 & P3).
  pose proof unit_is_small as U.
  assert (Hd : forall x y r, is_coordinate x -> is_coordinate y -> Rabs (value64 (Operations.minus (to64 x) (to64 y))) <= r ->
    is_homogeneous (part x y r difference_bound)).
  { intros. apply part_is_homogeneous; cbn [difference_bound size off]; auto; lra. }
  assert (Ho : forall x y r, is_coordinate x -> is_coordinate y -> Rabs (value64 (Operations.minus (to64 x) (to64 y))) <= r ->
    is_homogeneous (part x y r offset_bound)).
  { intros. apply part_is_homogeneous; cbn [offset_bound size off]; auto. nra. }
  set (e i j := part i j (value64 s) difference_bound). set (f i j := part i j (value64 t) difference_bound).
  set (d i j := part i j (value64 w) offset_bound).
  set (across := across_of (e (x32 b) (x32 a)) (e (y32 b) (y32 a)) (e (z32 b) (z32 a)) (f (x32 c) (x32 a)) (f (y32 c) (y32 a))
    (f (z32 c) (z32 a)) (d (x32 p) (x32 a)) (d (y32 p) (y32 a)) (d (z32 p) (z32 a))).
  assert (H : is_homogeneous across).
  { apply across_is_homogeneous with (value64 s) (value64 t) (value64 w);
      (split; [first [now apply Hd|now apply Ho]|repeat split]). }
  destruct (polynomial_is_near across H) as (Fn & _ & _ & _ & _ & _ & _ & N).
  change (computed_of across) with (dot64 (cross64 (difference64 b a) (difference64 c a)) (difference64 p a)) in Fn, N.
  change (exact_of across) with side in N. change (bound_of across) with across_bound in N.
  change (scale_of across) with (value64 s * value64 t * value64 w) in N. clearbody side across.
  set (v := dot64 _ _) in *. destruct constants_are_above as (_ & (Fk & Pk & K) & _).
  assert (Parts : parts (code_error code_across) = Some (7318349394508295%positive, (-100)%Z)) by (vm_compute; reflexivity).
  destruct (value_of_parts _ _ _ Parts) as [_ Vk].
  assert (Gk : is_grained 100 (value64 (code_error code_across))).
  { rewrite Vk. apply generic_format_FIX. exists (Float radix2 7318349394508295 (-100)); reflexivity. }
  assert (Bk : 0 <= value64 (code_error code_across) <= 1) by (rewrite Vk; simpl; lra).
  destruct (bound_covers _ s t w Fk Gk Bk Fs Gs Bs Ft Gt Bt Fw Gw Bw) as [Fe Le].
  set (limit := times _ _) in *. destruct (absolute_is v _ (conj eq_refl Fn)) as [Va Fa].
  rewrite (less_is _ _ _ _ (conj eq_refl Fe) (conj Va Fa)) in L. rewrite (less_is _ _ _ _ zero_is (conj eq_refl Fn)).
  destruct (Rlt_bool_spec (value64 limit) (Rabs (value64 v))) as [M|M]; [clear L|discriminate L].
  set (k := value64 (code_error code_across)) in *. set (S := value64 s * value64 t) in *. clearbody k. set (q := off across_bound) in *.
  clearbody q. assert (PS : 0 <= S * value64 w) by (unfold S; repeat apply Rmult_le_pos; lra).
  assert (Q : q * (S * value64 w) <= value64 limit).
  { apply Rle_trans with (2 := Le). replace (k * S * value64 w) with (k * (S * value64 w)) by ring.
    assert (X : (1 + 1024 * unit53) * q * (S * value64 w) <= k * (S * value64 w)) by now apply Rmult_le_compat_r.
    assert (Y : (1 - 4 * unit53) * ((1 + 1024 * unit53) * q * (S * value64 w)) <= (1 - 4 * unit53) * (k * (S * value64 w)))
      by (apply Rmult_le_compat_l; lra).
    assert (Z : 0 <= q * (S * value64 w)) by now apply Rmult_le_pos.
    assert (W : 1 * (q * (S * value64 w)) <= (1 - 4 * unit53) * (1 + 1024 * unit53) * (q * (S * value64 w)))
      by (apply Rmult_le_compat_r; [exact Z|nra]).
    lra. }
  replace (q * (S * value64 w)) with (q * (value64 s * value64 t * value64 w)) in Q by (unfold S; ring).
  apply Rabs_le_inv in N. unfold sign. case Rlt_bool_spec; intro O.
  - rewrite Rabs_pos_eq in M by lra. rewrite Rcompare_Gt; [reflexivity|]. unfold S in *. lra.
  - rewrite Rabs_left1 in M by lra. rewrite Rcompare_Lt; [reflexivity|]. unfold S in *. lra.
Qed.
