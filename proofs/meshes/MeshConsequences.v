(* SPDX-License-Identifier: BSD-3-Clause *)
(* What follows from the definitions of the god-object and of friction, for all meshes and paths: docs/god-object.md and
   docs/friction.md, "Consequences", and docs/energy.md, "Meshes". *)
From Coq Require Import Reals Lra Psatz.
From Forceshade Require Import Vectors.
Open Scope R_scope.

Definition size (a : vector) := sqrt (square a).

Lemma size_is_not_negative : forall a, 0 <= size a.
Proof. intro. apply sqrt_pos. Qed.

Lemma size_squared : forall a, size a * size a = square a.
Proof. intro. apply sqrt_sqrt, square_is_not_negative. Qed.

Lemma dot_is_no_larger : forall a b, dot a b <= size a * size b.
Proof.
  intros a b. apply Rle_trans with (Rabs (dot a b)); [apply Rle_abs|].
  unfold size. rewrite <- sqrt_mult by apply square_is_not_negative. rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt, cauchy_schwarz.
Qed.

Lemma size_of_scaled : forall t a, 0 <= t -> size (scaled t a) = t * size a.
Proof.
  intros t a T. unfold size. replace (square (scaled t a)) with (t * t * square a) by (components; ring).
  rewrite sqrt_mult by (nra || apply square_is_not_negative). now rewrite sqrt_square.
Qed.

Lemma size_of_sum : forall a b, size (plus a b) <= size a + size b.
Proof.
  intros a b. pose proof (size_is_not_negative a). pose proof (size_is_not_negative b). pose proof (dot_is_no_larger a b).
  apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite size_squared.
  replace (square (plus a b)) with (square a + 2 * dot a b + square b) by (components; ring).
  rewrite <- (size_squared a), <- (size_squared b). nra.
Qed.

(* ---- Energy. D and D' are the ways from the hand to the rest, of one tick and the next, step is the hand's, and rho what the state is
   off the rest. ---- *)

Theorem energy_of_a_tick : forall K D D' step rho, 0 <= K -> square D' <= square (plus (minus D step) rho) ->
  K * dot D step <= (K * square D - K * square D') / 2 + K * square step / 2 + K * (dot rho (minus D step) + square rho / 2).
Proof.
  intros K D D' step rho HK H.
  replace (square (plus (minus D step) rho)) with
    (square D - 2 * dot D step + square step + 2 * dot rho (minus D step) + square rho) in H by (components; ring).
  nra.
Qed.

(* Shaded, F = K |D| N for a unit vector N, and D = |D| n: what the turn adds. *)
Theorem energy_of_a_turn : forall K length N n step, 0 <= K -> 0 <= length ->
  dot (scaled (K * length) N) step <= K * dot (scaled length n) step + K * length * size (minus N n) * size step.
Proof.
  intros K length N n step HK HL. pose proof (dot_is_no_larger (minus N n) step) as H.
  replace (dot (scaled (K * length) N) step) with (K * dot (scaled length n) step + K * length *
    dot (minus N n) step) by (components; ring).
  assert (P : 0 <= K * length) by nra. pose proof (Rmult_le_compat_l _ _ _ P H) as L. lra.
Qed.

(* An interpolated normal is no farther from a direction n than the farthest of the corners': each corner's cosine is at least c. *)
Theorem interpolated_turn : forall n c N1 N2 N3 k l m, 0 <= c -> 0 <= k -> 0 <= l -> 0 <= m ->
  c * size N1 <= dot n N1 -> c * size N2 <= dot n N2 -> c * size N3 <= dot n N3 ->
  let N := plus (scaled k N1) (plus (scaled l N2) (scaled m N3)) in c * size N <= dot n N.
Proof.
  intros n c N1 N2 N3 k l m C HK HL HM H1 H2 H3 N.
  assert (S : size N <= k * size N1 + (l * size N2 + m * size N3)).
  { unfold N. apply Rle_trans with (1 := size_of_sum _ _). rewrite size_of_scaled by exact HK. apply Rplus_le_compat_l.
    apply Rle_trans with (1 := size_of_sum _ _). rewrite !size_of_scaled by assumption. lra. }
  replace (dot n N) with (k * dot n N1 + (l * dot n N2 + m * dot n N3)) by (unfold N; components; ring).
  pose proof (Rmult_le_compat_l _ _ _ C S). pose proof (Rmult_le_compat_l _ _ _ HK H1). pose proof (Rmult_le_compat_l _ _ _ HL H2).
  pose proof (Rmult_le_compat_l _ _ _ HM H3). lra.
Qed.

(* ---- Rounding. x is in the cell of the grid with the corners a, b and c, whose sides are no longer than h. ---- *)

Lemma weighted_squares : forall a b c p k l m, k + l + m = 1 ->
  let x := plus (scaled k a) (plus (scaled l b) (scaled m c)) in
  k * square (minus a p) + l * square (minus b p) + m * square (minus c p) =
  square (minus x p) + (k * l * square (minus a b) + k * m * square (minus a c) + l * m * square (minus b c)).
Proof. intros a b c p k l m H x. replace m with (1 - k - l) by lra. unfold x. components. replace m with (1 - k - l) by lra. ring. Qed.

Theorem one_corner_is_near : forall a b c p k l m h, 0 <= k -> 0 <= l -> 0 <= m -> k + l + m = 1 ->
  square (minus a b) <= h * h -> square (minus a c) <= h * h -> square (minus b c) <= h * h ->
  let x := plus (scaled k a) (plus (scaled l b) (scaled m c)) in
  square (minus a p) <= square (minus x p) + h * h / 3 \/ square (minus b p) <= square (minus x p) + h * h / 3 \/
  square (minus c p) <= square (minus x p) + h * h / 3.
Proof.
  intros a b c p k l m h HK HL HM H A B C x. pose proof (weighted_squares a b c p k l m H) as W. cbn zeta in W. fold x in W.
  set (A' := square (minus a p)) in *. set (B' := square (minus b p)) in *. set (C' := square (minus c p)) in *.
  set (X := square (minus x p)) in *.
  assert (S : k * l * square (minus a b) + k * m * square (minus a c) + l * m * square (minus b c) <= h * h / 3).
  { apply Rle_trans with ((k * l + k * m + l * m) * (h * h)).
    - assert (0 <= k * l) by nra. assert (0 <= k * m) by nra. assert (0 <= l * m) by nra. nra.
    - assert (k * l + k * m + l * m <= / 3).
      { replace m with (1 - k - l) by lra. pose proof (Rle_0_sqr (k - l)) as Q. pose proof (Rle_0_sqr (k + l - 2 / 3)) as R.
        unfold Rsqr in Q, R. lra. }
      assert (0 <= h * h) by nra. nra. }
  destruct (Rle_or_lt A' (X + h * h / 3)) as [L|GA]; [now left|].
  destruct (Rle_or_lt B' (X + h * h / 3)) as [L|GB]; [now right; left|].
  destruct (Rle_or_lt C' (X + h * h / 3)) as [L|GC]; [now right; right|].
  exfalso. assert (E : X + h * h / 3 < k * A' + l * B' + m * C'); [|lra].
  assert (0 <= k * (A' - (X + h * h / 3))) by nra. assert (0 <= l * (B' - (X + h * h / 3))) by nra.
  assert (0 <= m * (C' - (X + h * h / 3))) by nra.
  destruct (Rlt_or_le 0 k); [assert (0 < k * (A' - (X + h * h / 3))) by nra; nra|].
  destruct (Rlt_or_le 0 l); [assert (0 < l * (B' - (X + h * h / 3))) by nra; nra|].
  assert (0 < m * (C' - (X + h * h / 3))) by nra. nra.
Qed.

(* A move of the length d along a unit vector v from g, u = p - g, that is refused: no corner near its end is nearer to p than g. A slide
   has d <= u·v; a flight has v along u. *)
Theorem refused_move_is_short : forall u v d h nearest, square v = 1 -> 0 <= d -> d <= dot u v ->
  nearest <= square (minus u (scaled d v)) + h * h / 3 -> square u <= nearest -> d * dot u v <= h * h / 3.
Proof.
  intros u v d h nearest V D L N R.
  replace (square (minus u (scaled d v))) with (square u - 2 * d * dot u v + d * d * square v) in N by (components; ring).
  rewrite V in N. nra.
Qed.

(* ---- Friction ---- *)

(* A slide that is made, from g to r: both in the plane or on the line of which q is p's foot, and r is nearer to p. *)
Theorem never_against_the_slip : forall g r p q, dot (minus p q) (minus r g) = 0 -> square (minus r p) < square (minus g p) ->
  square (minus r g) / 2 < dot (minus r g) (minus q g).
Proof.
  intros g r p q F N.
  assert (E : square (minus g p) - square (minus r p) = 2 * dot (minus r g) (minus q g) - square (minus r g) + 2 *
    dot (minus p q) (minus r g))
    by (components; ring).
  rewrite F in E. lra.
Qed.

(* A refused slide that would have ended strictly inside: it goes the part lambda of the pull t, and slips to a pull of mu z at most. *)
Theorem refused_slide_is_short : forall t pressed lambda h, 0 <= t -> 0 <= lambda <= 1 -> t - pressed <= lambda * t ->
  t * t <= (1 - lambda) * (1 - lambda) * (t * t) + h * h / 3 -> (t - pressed) * t <= h * h / 3.
Proof.
  intros t pressed lambda h T L S R. assert (P : (t - pressed) * t <= lambda * t * t) by (apply Rmult_le_compat_r; lra).
  assert (Q : lambda * (t * t) <= (2 * lambda - lambda * lambda) * (t * t)) by (apply Rmult_le_compat_r; nra). nra.
Qed.

(* ---- The contact rule sub-goal: how far its goal, s (N - (N·n/n²) n) off p with s = N·(g - p)/N², is at most off ---- *)

Theorem sub_goal_is_near : forall n N way, n <> zero -> N <> zero ->
  let s := dot N way / square N in
  square (scaled s (minus N (scaled (dot N n / square n) n))) <= (1 - dot N n * dot N n / (square N * square n)) * square way.
Proof.
  intros n N way Hn HN s. pose proof (square_is_positive n Hn) as P. pose proof (square_is_positive N HN) as Q.
  replace (square (scaled s (minus N (scaled (dot N n / square n) n)))) with
    (s * s * (square N - 2 * (dot N n / square n) * dot N n + dot N n / square n * (dot N n / square n) * square n)) by (components;
      ring).
  replace (s * s * (square N - 2 * (dot N n / square n) * dot N n + dot N n / square n * (dot N n / square n) * square n)) with
    (dot N way * dot N way / square N * (1 - dot N n * dot N n / (square N * square n))) by (unfold s; field; lra).
  assert (A : dot N way * dot N way / square N <= square way).
  { apply Rmult_le_reg_r with (square N); [exact Q|]. replace (dot N way * dot N way / square N * square N) with (dot N way * dot N way)
      by (field; lra). rewrite (Rmult_comm (square way)). apply cauchy_schwarz. }
  assert (B : 0 <= 1 - dot N n * dot N n / (square N * square n)).
  { pose proof (cauchy_schwarz N n) as C. assert (D : dot N n * dot N n / (square N * square n) <= 1); [|lra].
    apply Rmult_le_reg_r with (square N * square n); [nra|]. replace (dot N n * dot N n / (square N * square n) * (square N *
      square n)) with
      (dot N n * dot N n) by (field; lra). lra. }
  rewrite Rmult_comm. now apply Rmult_le_compat_l.
Qed.

(* ---- Ways among sheets that cross: what a point of the grid that is held to delta in each coordinate may change. The sizes of
  vectors are
   those of their largest components. ---- *)

Definition at_most (s : R) (a : vector) := Rabs (x_of a) <= s /\ Rabs (y_of a) <= s /\ Rabs (z_of a) <= s.

Lemma product_at_most : forall x y p q, Rabs x <= p -> Rabs y <= q -> Rabs (x * y) <= p * q.
Proof. intros x y p q X Y. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. Qed.

Lemma dot_at_most : forall a b p q, at_most p a -> at_most q b -> Rabs (dot a b) <= 3 * (p * q).
Proof.
  intros a b p q (A1 & A2 & A3) (B1 & B2 & B3). unfold dot.
  pose proof (product_at_most _ _ _ _ A1 B1). pose proof (product_at_most _ _ _ _ A2 B2). pose proof (product_at_most _ _ _ _ A3 B3).
  pose proof (Rabs_triang (x_of a * x_of b + y_of a * y_of b) (z_of a * z_of b)).
  pose proof (Rabs_triang (x_of a * x_of b) (y_of a * y_of b)). lra.
Qed.

Lemma cross_at_most : forall a b p q, at_most p a -> at_most q b -> at_most (2 * (p * q)) (cross a b).
Proof.
  intros a b p q (A1 & A2 & A3) (B1 & B2 & B3).
  assert (One : forall s t v w, Rabs s <= p -> Rabs t <= q -> Rabs v <= p -> Rabs w <= q -> Rabs (s * t - v * w) <= 2 * (p * q)).
  { intros s t v w S T V W. pose proof (product_at_most _ _ _ _ S T). pose proof (product_at_most _ _ _ _ V W).
    pose proof (Rabs_triang (s * t) (- (v * w))) as Sum. rewrite Rabs_Ropp in Sum. unfold Rminus. lra. }
  repeat split; now apply One.
Qed.

Lemma plus_at_most : forall a b p q, at_most p a -> at_most q b -> at_most (p + q) (plus a b).
Proof.
  intros a b p q (A1 & A2 & A3) (B1 & B2 & B3).
  repeat split; (eapply Rle_trans; [apply Rabs_triang|now apply Rplus_le_compat]).
Qed.

Theorem side_of_plane_changes_by : forall e f w change s t delta, at_most s e -> at_most t f -> at_most delta change ->
  Rabs (dot (cross e f) (plus w change) - dot (cross e f) w) <= 6 * (s * t * delta).
Proof.
  intros e f w change s t delta E F D.
  replace (dot (cross e f) (plus w change) - dot (cross e f) w) with (dot (cross e f) change) by (components; ring).
  pose proof (dot_at_most _ _ _ _ (cross_at_most _ _ _ _ E F) D). lra.
Qed.

(* Both ends of the way u are held to delta, so that u changes by 2 delta at most. *)
Theorem passes_edge_changes_by : forall w u e a b size_w size_u size_e delta, at_most size_w w -> at_most size_u u -> at_most size_e e ->
  at_most delta a -> at_most (2 * delta) b ->
  Rabs (dot (cross (plus w a) (plus u b)) e - dot (cross w u) e) <= 6 * (size_e * (delta * size_u + 2 * delta * size_w + 2 * (delta *
    delta))).
Proof.
  intros w u e a b size_w size_u size_e delta W U E A B.
  replace (dot (cross (plus w a) (plus u b)) e - dot (cross w u) e) with (dot (plus (cross a u) (plus (cross w b) (cross a b))) e)
    by (components; ring).
  pose proof (dot_at_most _ _ _ _ (plus_at_most _ _ _ _ (cross_at_most _ _ _ _ A U)
    (plus_at_most _ _ _ _ (cross_at_most _ _ _ _ W B) (cross_at_most _ _ _ _ A B))) E) as H. lra.
Qed.
