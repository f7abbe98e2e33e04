(* SPDX-License-Identifier: BSD-3-Clause *)
(* Why a decision of the god-object is the sign of a polynomial (docs/proofs.md, "Why every decision is a sign"): each theorem has what
   docs/god-object.md or docs/friction.md compares on one side, and the polynomials of the code on the other. *)
From Coq Require Import Reals Lra Psatz.
From Forceshade Require Import Vectors.
Open Scope R_scope.

(* ---- Feet: the point of a triangle's plane, or of an edge's line, that is nearest to p ---- *)

Definition in_plane (a b c : vector) (beta gamma : R) := plus a (plus (scaled beta (minus b a)) (scaled gamma (minus c a))).

Theorem parameters_of_foot : forall a b c p beta gamma, normal a b c <> zero ->
  dot (minus p (in_plane a b c beta gamma)) (minus b a) = 0 -> dot (minus p (in_plane a b c beta gamma)) (minus c a) = 0 ->
  beta = dot (normal a b c) (cross (minus p a) (minus c a)) / square (normal a b c) /\
  gamma = dot (normal a b c) (cross (minus b a) (minus p a)) / square (normal a b c).
Proof.
  intros a b c p beta gamma N B C. pose proof (square_is_positive _ N) as P.
  set (r := minus p (in_plane a b c beta gamma)) in *. set (e := minus b a) in *. set (f := minus c a) in *.
  assert (Beta : dot (normal a b c) (cross (minus p a) f) = beta * square (normal a b c) + (dot r e * square f - dot r f * dot e f))
    by (unfold r, e, f, in_plane; components; ring).
  assert (Gamma : dot (normal a b c) (cross e (minus p a)) = gamma * square (normal a b c) + (dot r f * square e - dot r e * dot e f))
    by (unfold r, e, f, in_plane; components; ring).
  rewrite Beta, Gamma, B, C. split; field; lra.
Qed.

Lemma ratio_is_positive : forall x y, 0 < y -> (0 < x / y <-> 0 < x).
Proof.
  intros x y Y. split; intro H; [|now apply Rdiv_lt_0_compat].
  replace x with (x / y * y) by (field; lra). now apply Rmult_lt_0_compat.
Qed.

(* The foot lies on the triangle's side of the side (a, b). *)
Theorem foot_is_inside : forall a b c p beta gamma, normal a b c <> zero ->
  dot (minus p (in_plane a b c beta gamma)) (minus b a) = 0 -> dot (minus p (in_plane a b c beta gamma)) (minus c a) = 0 ->
  (0 < gamma <-> 0 < dot (cross (minus b a) (minus p a)) (normal a b c)).
Proof.
  intros a b c p beta gamma N B C. destruct (parameters_of_foot a b c p beta gamma N B C) as [_ ->].
  rewrite ratio_is_positive by now apply square_is_positive.
  replace (dot (cross (minus b a) (minus p a)) (normal a b c)) with (dot (normal a b c) (cross (minus b a) (minus p a))) by
    (components; ring).
  reflexivity.
Qed.

Theorem parameter_of_foot_on_edge : forall a b p t, minus b a <> zero -> dot (minus p (plus a (scaled t (minus b a)))) (minus b a) = 0 ->
  t = dot (minus b a) (minus p a) / square (minus b a).
Proof.
  intros a b p t E H. pose proof (square_is_positive _ E) as P.
  assert (X : dot (minus b a) (minus p a) = t * square (minus b a) + dot (minus p (plus a (scaled t (minus b a)))) (minus b a))
    by (components; ring).
  rewrite X, H. field. lra.
Qed.

(* Where the god-object is in the triangle, how far p is off the triangle's plane does not depend on where it is. *)
Theorem distance_off_plane : forall a b c p beta gamma,
  dot (normal a b c) (minus p (in_plane a b c beta gamma)) = dot (normal a b c) (minus p a).
Proof. intros. unfold in_plane. components. ring. Qed.

(* ---- Directions: u·v of the unit direction v along an edge, and of that in a triangle which has the largest u·v ---- *)

Definition along_edge (e u : vector) := dot e u / sqrt (square e).
Definition along_plane (n u : vector) := sqrt (square u - dot n u * dot n u / square n).

Lemma square_of_projection : forall n u, n <> zero ->
  square (minus u (scaled (dot n u / square n) n)) = square u - dot n u * dot n u / square n.
Proof.
  intros n u N. pose proof (square_is_positive n N) as P.
  replace (square (minus u (scaled (dot n u / square n) n))) with
    (square u - 2 * (dot n u / square n) * dot n u + dot n u / square n * (dot n u / square n) * square n) by (components; ring).
  field. lra.
Qed.

Theorem no_direction_in_a_plane_is_nearer : forall n u v, n <> zero -> square v = 1 -> dot n v = 0 -> dot u v <= along_plane n u.
Proof.
  intros n u v N V H. pose proof (cauchy_schwarz (minus u (scaled (dot n u / square n) n)) v) as C.
  assert (E : dot (minus u (scaled (dot n u / square n) n)) v = dot u v - dot n u / square n * dot n v) by (components; ring).
  rewrite E, H, V, square_of_projection in C by exact N. rewrite Rmult_0_r, Rminus_0_r, Rmult_1_r in C.
  unfold along_plane. apply Rle_trans with (Rabs (dot u v)); [apply Rle_abs|].
  rewrite <- sqrt_Rsqr_abs. now apply sqrt_le_1_alt.
Qed.

(* The projection of u has it. *)
Theorem the_projection_is_nearest : forall n u, n <> zero -> minus u (scaled (dot n u / square n) n) <> zero ->
  let w := minus u (scaled (dot n u / square n) n) in let v := scaled (/ sqrt (square w)) w in
  square v = 1 /\ dot n v = 0 /\ dot u v = along_plane n u.
Proof.
  intros n u N W w v. pose proof (square_is_positive n N) as P. pose proof (square_is_positive w W) as Q.
  pose proof (sqrt_lt_R0 _ Q) as S. pose proof (sqrt_sqrt _ (Rlt_le _ _ Q)) as SS.
  assert (Across : dot n w = 0).
  { unfold w. replace (dot n (minus u (scaled (dot n u / square n) n))) with (dot n u - dot n u / square n *
    square n) by (components; ring).
    field. lra. }
  assert (Along : dot u w = square w).
  { replace (dot u w) with (square w + dot n u / square n * dot n w) by (unfold w; components; ring). rewrite Across. ring. }
  unfold v. split; [|split].
  - replace (square (scaled (/ sqrt (square w)) w)) with (/ sqrt (square w) * / sqrt (square w) * square w) by (components; ring).
    rewrite <- SS at 3. field. lra.
  - replace (dot n (scaled (/ sqrt (square w)) w)) with (/ sqrt (square w) * dot n w) by (components; ring). rewrite Across. ring.
  - replace (dot u (scaled (/ sqrt (square w)) w)) with (/ sqrt (square w) * dot u w) by (components; ring). rewrite Along.
    rewrite <- SS at 2. unfold along_plane. rewrite <- (square_of_projection n u N). fold w. field. lra.
Qed.

(* The square with the number's sign. *)
Definition signed_square (x : R) := x * Rabs x.

Theorem signed_squares_are_in_order : forall x y, signed_square x < signed_square y <-> x < y.
Proof.
  intros x y. unfold signed_square, Rabs. destruct (Rcase_abs x), (Rcase_abs y); split; intro; nra.
Qed.

Lemma signed_square_of_edge : forall e u, e <> zero -> signed_square (along_edge e u) = dot e u * Rabs (dot e u) / square e.
Proof.
  intros e u E. pose proof (square_is_positive e E) as P. pose proof (sqrt_lt_R0 _ P) as S. pose proof (sqrt_sqrt _ (Rlt_le _ _ P)) as SS.
  unfold signed_square, along_edge, Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ sqrt (square e))) by now apply Rlt_le, Rinv_0_lt_compat.
  rewrite <- SS at 3. field. lra.
Qed.

Lemma signed_square_of_plane : forall n u, n <> zero -> signed_square (along_plane n u) = square u - dot n u * dot n u / square n.
Proof.
  intros n u N. unfold signed_square, along_plane. rewrite Rabs_pos_eq by apply sqrt_pos. apply sqrt_sqrt.
  rewrite <- square_of_projection by exact N. apply square_is_not_negative.
Qed.

Lemma fractions_in_order : forall a b c d, 0 < b -> 0 < d -> (a / b < c / d <-> a * d < c * b).
Proof.
  intros a b c d B D. assert (E : c / d - a / b = (c * b - a * d) / (d * b)) by (field; lra).
  assert (P : 0 < d * b) by now apply Rmult_lt_0_compat. pose proof (ratio_is_positive (c * b - a * d) (d * b) P) as H. lra.
Qed.

Theorem two_edges_in_order : forall e f u, e <> zero -> f <> zero ->
  (along_edge e u < along_edge f u <-> dot e u * Rabs (dot e u) * square f < dot f u * Rabs (dot f u) * square e).
Proof.
  intros e f u E F. rewrite <- signed_squares_are_in_order, !signed_square_of_edge by assumption.
  now apply fractions_in_order; apply square_is_positive.
Qed.

Theorem edge_and_triangle_in_order : forall e n u, e <> zero -> n <> zero ->
  (along_edge e u < along_plane n u <-> dot e u * Rabs (dot e u) * square n < (square u * square n - dot n u * dot n u) * square e).
Proof.
  intros e n u E N. rewrite <- signed_squares_are_in_order, signed_square_of_edge, signed_square_of_plane by assumption.
  pose proof (square_is_positive n N) as P.
  replace (square u - dot n u * dot n u / square n) with ((square u * square n - dot n u * dot n u) / square n) by (field; lra).
  now apply fractions_in_order; apply square_is_positive.
Qed.

Theorem two_triangles_in_order : forall n m u, n <> zero -> m <> zero ->
  (along_plane n u < along_plane m u <-> dot m u * dot m u * square n < dot n u * dot n u * square m).
Proof.
  intros n m u N M. rewrite <- signed_squares_are_in_order, !signed_square_of_plane by assumption.
  rewrite <- (fractions_in_order (dot m u * dot m u) (square m) (dot n u * dot n u) (square n)) by now apply square_is_positive. lra.
Qed.

(* u·v = |u|: u is on the surface. *)
Theorem on_plane : forall n u, n <> zero -> (along_plane n u = sqrt (square u) <-> dot n u = 0).
Proof.
  intros n u N. pose proof (square_is_positive n N) as P. split; intro H.
  - apply (f_equal signed_square) in H. rewrite signed_square_of_plane in H by exact N. unfold signed_square in H.
    rewrite Rabs_pos_eq in H by apply sqrt_pos. rewrite sqrt_sqrt in H by apply square_is_not_negative.
    assert (Z : dot n u * dot n u / square n * square n = 0) by (replace (dot n u * dot n u / square n) with 0 by lra; ring).
    replace (dot n u * dot n u / square n * square n) with (dot n u * dot n u) in Z by (field; lra). nra.
  - unfold along_plane. rewrite H. f_equal. field. lra.
Qed.

Theorem on_line : forall e u, e <> zero -> (along_edge e u = sqrt (square u) <-> 0 <= dot e u /\ dot e u * dot e u = square e * square u).
Proof.
  intros e u E. pose proof (square_is_positive e E) as P. pose proof (sqrt_lt_R0 _ P) as S.
  pose proof (sqrt_sqrt _ (Rlt_le _ _ P)) as SS. pose proof (sqrt_sqrt _ (square_is_not_negative u)) as UU. pose proof (sqrt_pos
    (square u)) as U.
  unfold along_edge. split.
  - intro H. assert (X : dot e u = sqrt (square u) * sqrt (square e)) by (rewrite <- H; field; lra). split; [nra|].
    rewrite X. replace (sqrt (square u) * sqrt (square e) * (sqrt (square u) * sqrt (square e)))
      with (sqrt (square e) * sqrt (square e) * (sqrt (square u) * sqrt (square u))) by ring. now rewrite SS, UU.
  - intros [H Q]. apply Rmult_eq_reg_r with (sqrt (square e)); [|lra]. replace (dot e u / sqrt (square e) *
    sqrt (square e)) with (dot e u) by (field; lra).
    apply Rsqr_inj; [exact H|nra|]. unfold Rsqr. rewrite Q.
    replace (sqrt (square u) * sqrt (square e) * (sqrt (square u) * sqrt (square e)))
      with (sqrt (square e) * sqrt (square e) * (sqrt (square u) * sqrt (square u))) by ring. now rewrite SS, UU.
Qed.

(* Whether the projection of u is strictly inside the half-plane or the sector that a triangle is at its side (a,
  b) or at its corner a. *)
Theorem parameters_of_projection : forall a b c u beta gamma, normal a b c <> zero ->
  minus u (scaled (dot (normal a b c) u / square (normal a b c)) (normal a b c)) = plus (scaled beta (minus b a)) (scaled gamma
    (minus c a)) ->
  (0 < beta <-> 0 < dot (cross u (minus c a)) (normal a b c)) /\ (0 < gamma <-> 0 < dot (cross (minus b a) u) (normal a b c)).
Proof.
  intros a b c u beta gamma N H. pose proof (square_is_positive _ N) as P. set (n := normal a b c) in *.
  set (k := dot n u / square n) in *.
  assert (U : u = plus (scaled k n) (plus (scaled beta (minus b a)) (scaled gamma (minus c a)))).
  { rewrite <- H. apply same_components; components; ring. }
  assert (Beta : dot (cross u (minus c a)) n = beta * square n) by (rewrite U; unfold n; components; ring).
  assert (Gamma : dot (cross (minus b a) u) n = gamma * square n) by (rewrite U; unfold n; components; ring).
  rewrite Beta, Gamma. split; split; intro; nra.
Qed.

(* ---- Flights: where the line from g along u meets a triangle ---- *)

Theorem crossing_of_a_plane : forall a b c g u s, dot (normal a b c) u <> 0 -> dot (normal a b c) (minus (plus g (scaled s u)) a) = 0 ->
  s = dot (normal a b c) (minus a g) / dot (normal a b c) u.
Proof.
  intros a b c g u s N H. assert (E : dot (normal a b c) (minus (plus g (scaled s u)) a) = s *
    dot (normal a b c) u - dot (normal a b c) (minus a g))
    by (components; ring).
  rewrite E in H. apply Rmult_eq_reg_r with (dot (normal a b c) u);
    [|exact N]. replace (dot (normal a b c) (minus a g) / dot (normal a b c) u *
    dot (normal a b c) u) with (dot (normal a b c) (minus a g)) by (field; exact N). lra.
Qed.

(* Its parameters: each is the volume at one side over the whole. *)
Theorem parameters_of_crossing : forall a b c g u s beta gamma, plus g (scaled s u) = in_plane a b c beta gamma ->
  beta * dot (normal a b c) u = dot (minus g a) (cross (minus c a) u) /\ gamma *
    dot (normal a b c) u = dot (minus g a) (cross u (minus b a)).
Proof.
  intros a b c g u s beta gamma H.
  assert (G : g = minus (in_plane a b c beta gamma) (scaled s u)) by (rewrite <- H; apply same_components; components; ring).
  rewrite G. unfold in_plane. components. split; ring.
Qed.

(* ---- Forces: a component's size is K |D| |N_i|/|N|; it is compared with a number m by their squares ---- *)

Theorem force_is_compared_by_squares : forall K d n N m, 0 <= K -> 0 <= d -> N <> zero -> 0 <= m ->
  (K * sqrt d * Rabs n / sqrt (square N) < m <-> K * K * d * (n * n) < m * m * square N).
Proof.
  intros K d n N m HK Hd HN Hm. pose proof (square_is_positive N HN) as P. pose proof (sqrt_lt_R0 _ P) as S.
  assert (X : 0 <= K * sqrt d * Rabs n) by (repeat apply Rmult_le_pos; auto using sqrt_pos, Rabs_pos).
  rewrite <- (Rmult_1_r m) at 1. replace (m * 1) with (m / 1) by field. rewrite fractions_in_order by lra. rewrite Rmult_1_r.
  assert (Squares : forall p q, 0 <= p -> 0 <= q -> (p < q <-> p * p < q * q)) by (intros; split; intro; nra).
  rewrite Squares by nra.
  replace (K * sqrt d * Rabs n * (K * sqrt d * Rabs n)) with (K * K * (sqrt d * sqrt d) * (Rabs n * Rabs n)) by ring.
  replace (m * sqrt (square N) * (m * sqrt (square N))) with (m * m * (sqrt (square N) * sqrt (square N))) by ring.
  rewrite !sqrt_sqrt by lra. replace (Rabs n * Rabs n) with (n * n); [reflexivity|]. rewrite <- Rabs_mult, Rabs_pos_eq; [ring|nra].
Qed.

(* ---- Friction: the pull t and the pressure z, in a triangle of normal n with z² = (n·u)²/n², and along an edge e with t² = (e·u)²/e²;
   t² + z² = u² ---- *)

Definition pressure_in_triangle (n u : vector) := dot n u * dot n u / square n.  (* z² *)
Definition pull_in_triangle (n u : vector) := square u - pressure_in_triangle n u.  (* t² *)
Definition pull_along_edge (e u : vector) := dot e u * dot e u / square e.
Definition pressure_along_edge (e u : vector) := square u - pull_along_edge e u.

(* x t² <= y z², in a triangle and along an edge. *)
Lemma pull_in_triangle_is_compared : forall n u x y, n <> zero ->
  (x * pull_in_triangle n u <= y * pressure_in_triangle n u <->
   x * (square u * square n - dot n u * dot n u) <= y * (dot n u * dot n u)).
Proof.
  intros n u x y N. pose proof (square_is_positive n N) as P. unfold pull_in_triangle, pressure_in_triangle.
  assert (X : x * (square u * square n - dot n u * dot n u) = x * (square u - dot n u * dot n u / square n) * square n) by (field; lra).
  assert (Y : y * (dot n u * dot n u) = y * (dot n u * dot n u / square n) * square n) by (field; lra).
  rewrite X, Y. split; intro H; [now apply Rmult_le_compat_r; [lra|]|now apply Rmult_le_reg_r with (square n)].
Qed.

Lemma pull_along_edge_is_compared : forall e u x y, e <> zero ->
  (x * pull_along_edge e u <= y * pressure_along_edge e u <->
   x * (dot e u * dot e u) <= y * (square u * square e - dot e u * dot e u)).
Proof.
  intros e u x y E. pose proof (square_is_positive e E) as P. unfold pressure_along_edge, pull_along_edge.
  assert (X : x * (dot e u * dot e u) = x * (dot e u * dot e u / square e) * square e) by (field; lra).
  assert (Y : y * (square u * square e - dot e u * dot e u) = y * (square u - dot e u * dot e u / square e) * square e) by (field; lra).
  rewrite X, Y. split; intro H; [now apply Rmult_le_compat_r; [lra|]|now apply Rmult_le_reg_r with (square e)].
Qed.

(* It sticks: t² <= μ²z². *)
Theorem sticking_in_a_triangle : forall n u mu, n <> zero ->
  (pull_in_triangle n u <= mu * mu * pressure_in_triangle n u <-> square u * square n <= (1 + mu * mu) * (dot n u * dot n u)).
Proof. intros n u mu N. pose proof (pull_in_triangle_is_compared n u 1 (mu * mu) N) as H. lra. Qed.

Theorem sticking_along_an_edge : forall e u mu, e <> zero ->
  (pull_along_edge e u <= mu * mu * pressure_along_edge e u <-> (1 + mu * mu) * (dot e u * dot e u) <= mu * mu * (square u * square e)).
Proof. intros e u mu E. pose proof (pull_along_edge_is_compared e u 1 (mu * mu) E) as H. lra. Qed.

(* The share: i <= 2^24 μ z/t. *)
Theorem share_in_a_triangle : forall n u mu i, n <> zero ->
  (i * i * pull_in_triangle n u <= 2 ^ 48 * (mu * mu) * pressure_in_triangle n u <->
   i * i * (square u * square n - dot n u * dot n u) <= 2 ^ 48 * (mu * mu) * (dot n u * dot n u)).
Proof. intros. now apply pull_in_triangle_is_compared. Qed.

Theorem share_along_an_edge : forall e u mu i, e <> zero ->
  (i * i * pull_along_edge e u <= 2 ^ 48 * (mu * mu) * pressure_along_edge e u <->
   i * i * (dot e u * dot e u) <= 2 ^ 48 * (mu * mu) * (square u * square e - dot e u * dot e u)).
Proof. intros. now apply pull_along_edge_is_compared. Qed.

(* The bit: 4t² > μ²z². *)
Theorem keeping_the_bit : forall n u mu, n <> zero ->
  (mu * mu * pressure_in_triangle n u < 4 * pull_in_triangle n u <-> (4 + mu * mu) * (dot n u * dot n u) < 4 * (square u * square n)).
Proof.
  intros n u mu N. pose proof (pull_in_triangle_is_compared n u 4 (mu * mu) N) as [H1 H2]. split; intro H.
  - apply Rnot_le_lt. intro L. apply (Rlt_not_le _ _ H). apply H2. lra.
  - apply Rnot_le_lt. intro L. apply H1 in L. lra.
Qed.
