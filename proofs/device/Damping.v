(* SPDX-License-Identifier: BSD-3-Clause *)
(* The energy of damping: docs/damping.md. At its own velocity the damper dissipates, and sampling gives at most γ B/T times the squares
   of the hand's steps. *)
From Coq Require Import Reals Lra Psatz.
From Forceshade Require Import Vectors.
Open Scope R_scope.

(* s of the page. c is v·f/f². S = ∞ is any S from 1 - B c on. *)
Definition limited (B S c : R) := Rmin S (Rmax 0 (1 - B * c)).

(* The limits bring s - 1 nearer to 0: it is -w c for some w of [0, B]. *)
Lemma limits_lessen : forall B S c, 0 <= B -> 1 <= S -> exists w, 0 <= w <= B /\ limited B S c - 1 = - (w * c).
Proof.
  intros B S c HB HS. unfold limited.
  destruct (Req_dec c 0) as [->|N].
  { exists 0. split; [lra|]. rewrite Rmax_right by lra. rewrite Rmin_right by lra. ring. }
  exists ((1 - Rmin S (Rmax 0 (1 - B * c))) / c). split; [|field; exact N].
  destruct (Rtotal_order c 0) as [L|[E|G]]; [|contradiction|].
  - rewrite Rmax_right by nra.
    assert (R : Rmin S (1 - B * c) - 1 = - ((1 - Rmin S (1 - B * c)) / c * c)) by (field; exact N).
    assert (1 <= Rmin S (1 - B * c)) by (apply Rmin_glb; nra).
    assert (Rmin S (1 - B * c) <= 1 - B * c) by apply Rmin_r.
    set (w := (1 - Rmin S (1 - B * c)) / c) in *. split; nra.
  - rewrite Rmin_right by (apply Rmax_lub; nra).
    assert (R : Rmax 0 (1 - B * c) - 1 = - ((1 - Rmax 0 (1 - B * c)) / c * c)) by (field; exact N).
    assert (1 - B * c <= Rmax 0 (1 - B * c)) by apply Rmax_r.
    assert (Rmax 0 (1 - B * c) <= 1) by (apply Rmax_lub; nra).
    set (w := (1 - Rmax 0 (1 - B * c)) / c) in *. split; nra.
Qed.

(* v is its part along f and the rest, which is across f; f is not 0. *)
Definition part_along (f v : vector) := scaled (dot v f / square f) f.
Definition part_across (f v : vector) := minus v (part_along f v).

(* F - f of the page, before it is rounded: t is λ B_t. *)
Definition damper (B S t : R) (f v : vector) :=
  minus (scaled (limited B S (dot v f / square f) - 1) f) (scaled t (part_across f v)).

Lemma across_is_across : forall f v, f <> zero -> dot (part_across f v) f = 0.
Proof.
  intros f v H. apply square_is_positive in H. unfold part_across, part_along.
  assert (E : dot v f / square f * square f = dot v f) by (field; lra).
  set (c := dot v f / square f) in *.
  transitivity (dot v f - c * square f); [components; ring | lra].
Qed.

Theorem damper_dissipates : forall B S t m f v, f <> zero -> 0 <= B <= m -> 1 <= S -> 0 <= t <= m ->
  m * dot (damper B S t f v) v <= - square (damper B S t f v).
Proof.
  intros B S t m f v H HB HS Ht. pose proof (across_is_across f v H) as O.
  destruct (limits_lessen B S (dot v f / square f) (proj1 HB) HS) as [w [Hw E]].
  unfold damper. rewrite E. set (b := part_across f v) in *. set (c := dot v f / square f) in *.
  assert (V : v = Vectors.plus (scaled c f) b)
    by (unfold b, part_across, part_along; fold c; apply same_components; components; ring).
  assert (D : dot (minus (scaled (- (w * c)) f) (scaled t b)) v = - (w * (c * c * square f) + t * square b)).
  { rewrite V at 1. transitivity (- (w * c * c * square f) - (w * c + t * c) * dot b f - t * square b).
    - components. ring.
    - rewrite O. ring. }
  assert (Q : square (minus (scaled (- (w * c)) f) (scaled t b)) = w * w * (c * c * square f) + t * t * square b).
  { transitivity (w * w * (c * c * square f) + 2 * w * c * t * dot b f + t * t * square b).
    - components. ring.
    - rewrite O. ring. }
  rewrite D, Q. pose proof (square_is_not_negative f) as F. pose proof (square_is_not_negative b) as P.
  assert (bounded : forall z y, 0 <= z <= m -> 0 <= y -> z * z * y <= m * (z * y)).
  { intros z y Hz Hy. rewrite Rmult_assoc. apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra. }
  pose proof (bounded w (c * c * square f) ltac:(lra) ltac:(pose proof (Rle_0_sqr c) as C; unfold Rsqr in C; nra)).
  pose proof (bounded t (square b) Ht P). lra.
Qed.

(* γ of the page. *)
Definition bound_factor (a : R) := if Rle_dec (1 / 2) a then a / (2 - a) else 1 / (4 * (1 - a) * (2 - a)).
(* p of its proof. *)
Definition stored_factor (a : R) := if Rle_dec (1 / 2) a then 1 / (2 * a) else 1 / (4 * a * (1 - a)).

Lemma stored_factor_is_positive : forall a, 0 < a <= 1 -> 0 < stored_factor a.
Proof.
  intros a H. unfold stored_factor. destruct (Rle_dec (1 / 2) a) as [L|L];
    (apply Rdiv_lt_0_compat; [lra|]); [lra|]. apply Rmult_lt_0_compat; lra.
Qed.

(* A step of one number x of the state, with a share w of the damping. *)
Lemma step_of_a_number : forall a w x d, 0 < a <= 1 -> 0 <= w <= 1 ->
  - (w * (x * d)) + stored_factor a * (((1 - a) * x + a * d) * ((1 - a) * x + a * d) - x * x) <= bound_factor a * (d * d).
Proof.
  intros a w x d Ha Hw.
  set (rest := fun w => bound_factor a * (d * d) + w * (x * d)
    - stored_factor a * (((1 - a) * x + a * d) * ((1 - a) * x + a * d) - x * x)).
  assert (Z : 0 <= rest 0 /\ 0 <= rest 1).
  { unfold rest, bound_factor, stored_factor. destruct (Rle_dec (1 / 2) a) as [L|L].
    - split.
      + replace (_ - _) with ((2 - a) / 2 * ((x - (1 - a) / (2 - a) * d) * (x - (1 - a) / (2 - a) * d))
          + (a * a - (1 - a) * (1 - a)) / (2 * (2 - a)) * (d * d)) by (field; lra).
        assert (0 <= (a * a - (1 - a) * (1 - a)) / (2 * (2 - a)))
          by (apply Rmult_le_pos; [nra | left; apply Rinv_0_lt_compat; lra]).
        pose proof (Rle_0_sqr (x - (1 - a) / (2 - a) * d)) as S1. pose proof (Rle_0_sqr d) as S2. unfold Rsqr in *. nra.
      + replace (_ - _) with ((2 - a) / 2 * ((x + a / (2 - a) * d) * (x + a / (2 - a) * d))) by (field; lra).
        pose proof (Rle_0_sqr (x + a / (2 - a) * d)) as S1. unfold Rsqr in *. nra.
    - assert (0 <= (2 - a) / (4 * (1 - a))) by (apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra]).
      split.
      + replace (_ - _) with ((2 - a) / (4 * (1 - a)) * ((x - (1 - a) / (2 - a) * d) * (x - (1 - a) / (2 - a) * d)))
          by (field; lra).
        pose proof (Rle_0_sqr (x - (1 - a) / (2 - a) * d)) as S1. unfold Rsqr in *. nra.
      + replace (_ - _) with ((2 - a) / (4 * (1 - a)) * ((x + (1 - a) / (2 - a) * d) * (x + (1 - a) / (2 - a) * d)))
          by (field; lra).
        pose proof (Rle_0_sqr (x + (1 - a) / (2 - a) * d)) as S1. unfold Rsqr in *. nra. }
  assert (rest w = (1 - w) * rest 0 + w * rest 1) by (unfold rest; ring).
  assert (0 <= rest w) by nra. unfold rest in *. lra.
Qed.

(* The same of a vector. *)
Definition filtered (a : R) (x d : vector) := Vectors.plus (scaled (1 - a) x) (scaled a d).
Lemma step_of_a_vector : forall a w x d, 0 < a <= 1 -> 0 <= w <= 1 ->
  - (w * dot x d) + stored_factor a * (square (filtered a x d) - square x) <= bound_factor a * square d.
Proof.
  intros a w [x1 x2 x3] [d1 d2 d3] Ha Hw. unfold filtered. components.
  pose proof (step_of_a_number a w x1 d1 Ha Hw). pose proof (step_of_a_number a w x2 d2 Ha Hw).
  pose proof (step_of_a_number a w x3 d3 Ha Hw). lra.
Qed.

(* A tick: what the damper gives in the hand's step d, in units of B/T, with shares w along the spring's force and u across it. *)
Definition given (w u : R) (f x d : vector) := - (w * dot (part_along f x) d + u * dot (part_across f x) d).

Lemma step_of_a_tick : forall a w u f x d, 0 < a <= 1 -> 0 <= w <= 1 -> 0 <= u <= 1 -> f <> zero ->
  given w u f x d + stored_factor a * (square (filtered a x d) - square x) <= bound_factor a * square d.
Proof.
  intros a w u f x d Ha Hw Hu Hf.
  pose proof (step_of_a_vector a w (part_along f x) (part_along f d) Ha Hw) as A.
  pose proof (step_of_a_vector a u (part_across f x) (part_across f d) Ha Hu) as B.
  pose proof (across_is_across f x Hf) as Ox. pose proof (across_is_across f d Hf) as Od.
  unfold given, filtered in *. unfold part_across in *.
  set (xa := part_along f x) in *. set (da := part_along f d) in *.
  set (cx := dot x f / square f) in *. set (cd := dot d f / square f) in *.
  assert (Ex : xa = scaled cx f) by reflexivity. assert (Ed : da = scaled cd f) by reflexivity.
  assert (Xd : dot xa d = dot xa da).
  { replace (dot xa d) with (dot xa da + cx * dot (minus d da) f) by (rewrite Ex; components; ring). rewrite Od. ring. }
  assert (Bd : dot (minus x xa) d = dot (minus x xa) (minus d da)).
  { replace (dot (minus x xa) d) with (dot (minus x xa) (minus d da) + cd * dot (minus x xa) f) by (rewrite Ed; components; ring).
    rewrite Ox. ring. }
  assert (pythagoras : forall s t, square (Vectors.plus (scaled s x) (scaled t d)) =
    square (Vectors.plus (scaled s xa) (scaled t da)) + square (Vectors.plus (scaled s (minus x xa)) (scaled t (minus d da)))).
  { intros s t.
    transitivity (square (Vectors.plus (scaled s xa) (scaled t da)) + square (Vectors.plus (scaled s (minus x xa)) (scaled t (minus d da)))
      + 2 * (s * cx + t * cd) * (s * dot (minus x xa) f + t * dot (minus d da) f)).
    - rewrite Ex, Ed. components. ring.
    - rewrite Ox, Od. ring. }
  assert (Sx : square x = square xa + square (minus x xa)).
  { pose proof (pythagoras 1 0) as P. components. lra. }
  assert (Sd : square d = square da + square (minus d da)).
  { pose proof (pythagoras 0 1) as P. components. lra. }
  rewrite (pythagoras (1 - a) a), Xd, Bd, Sx, Sd. lra.
Qed.

(* Ticks of a path: shares, the spring's force, which is 0 where w and u are, and the hand's step. *)
Record tick := Tick { along_share : R; across_share : R; spring : vector; step : vector }.
Definition is_tick (k : tick) :=
  0 <= along_share k <= 1 /\ 0 <= across_share k <= 1 /\ (spring k = zero -> along_share k = 0 /\ across_share k = 0).

Fixpoint state (a : R) (x : vector) (path : list tick) : vector :=
  match path with nil => x | cons k rest => state a (filtered a x (step k)) rest end.
Fixpoint sum_given (a : R) (x : vector) (path : list tick) : R :=
  match path with
  | nil => 0
  | cons k rest => given (along_share k) (across_share k) (spring k) x (step k) + sum_given a (filtered a x (step k)) rest
  end.
Fixpoint sum_of_squares (path : list tick) : R :=
  match path with nil => 0 | cons k rest => square (step k) + sum_of_squares rest end.

Theorem sampling_gives_at_most : forall a path x, 0 < a <= 1 -> (forall k, List.In k path -> is_tick k) ->
  sum_given a x path <= bound_factor a * sum_of_squares path + stored_factor a * square x.
Proof.
  intros a path x Ha all.
  enough (sum_given a x path + stored_factor a * square (state a x path)
    <= bound_factor a * sum_of_squares path + stored_factor a * square x) as E.
  { pose proof (stored_factor_is_positive a Ha). pose proof (square_is_not_negative (state a x path)). nra. }
  revert x. induction path as [|k path IH]; intros x; cbn [sum_given sum_of_squares state]; [lra|].
  specialize (IH (fun j H => all j (or_intror H)) (filtered a x (step k))).
  destruct (all k (or_introl eq_refl)) as [Hw [Hu Hz]].
  enough (given (along_share k) (across_share k) (spring k) x (step k)
    + stored_factor a * (square (filtered a x (step k)) - square x) <= bound_factor a * square (step k)) by lra.
  destruct (Req_dec (square (spring k)) 0) as [Z|N].
  - destruct (Hz (square_is_zero _ Z)) as [-> ->]. unfold given.
    pose proof (step_of_a_vector a 0 x (step k) Ha ltac:(lra)). lra.
  - apply step_of_a_tick; try assumption. intros E. apply N. rewrite E. components. ring.
Qed.
