(* SPDX-License-Identifier: BSD-3-Clause *)
(* t = (R - rho) / rho as a batch computes it in binary32, from its v, where rho is not too small. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap DoubleDouble ErrorFree.
From Forceshade Require Import SecondAlong CylinderFirst.
From Forceshade Require Import Lanes LaneAnswers BumpLanes CylinderLaneRough.
Import ListNotations.
Open Scope R_scope.

Lemma sixteen_hundredths_is : exists x, is64 sixteen_hundredths x /\ Rabs (x - 16 / 100) <= / 1000000000000000.
Proof.
  exists (value64 sixteen_hundredths). split.
  - split; [reflexivity|]. unfold sixteen_hundredths, b64_of_bits, binary_float_of_bits. rewrite is_finite_FF2B. reflexivity.
  - unfold sixteen_hundredths, b64_of_bits, binary_float_of_bits. rewrite B2R_FF2B.
    match goal with |- context [FF2R radix2 ?x] => let y := eval vm_compute in x in change x with y end.
    unfold FF2R, F2R. cbn [Fnum Fexp SpecFloat.cond_Zopp]. change (bpow radix2 (-55)) with (/ 36028797018963968). apply Rabs_le. lra.
Qed.

Notation square_form R := (times (to64 R) (to64 R)) (only parsing).
Notation rho_squared_form R v32 :=
  (plus32 (minus32 (to32 (square_form R)) v32) (to32 (minus (square_form R) (to64 (to32 (square_form R)))))) (only parsing).
Notation rough_form R v32 :=
  (over32 v32 (plus32 (times32 (to32 (to64 R)) (square_root32 (rho_squared_form R v32))) (rho_squared_form R v32))) (only parsing).
Notation least_form R := (to32 (times (times sixteen_hundredths (to64 R)) (to64 R))) (only parsing).

Lemma rough_form_is : forall R w K v vv V P rho, parameters R w K -> let Q := value32 R * value32 R in
  is64 v vv -> Rabs (vv - V) <= 128 * unit53 * Rabs V -> / 16777300 * Q < Rabs vv -> P = Q - V -> 0 < rho -> rho * rho = P ->
  P <= 700000000 -> is_less32 (rho_squared_form R (to32 v)) (least_form R) = false ->
  let r := value32 R / rho in 0 < r <= 25002 / 10000 /\
  exists t, is32 (rough_form R (to32 v)) t /\ Rabs (t - (r - 1)) <= rough * Rabs (r - 1).
Proof.
  intros R w K v vv V P rho ((FR & _) & HR & _) Q Iv Ev Lv EP Hrho Erho UP Doubt r. set (Rad := value32 R) in *.
  pose proof (to64_is_exact R FR) as IR. fold Rad in IR. pose proof (generic_format_B2R 24 128 R) as GR. fold Rad in GR.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Hti. pose proof tiny32_is_tiny as Ht3. set (e := unit24) in *.
  assert (He : 59 / 1000000000 <= e <= 60 / 1000000000) by (unfold e, unit24; lra).
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; clear -HR; nra).
  assert (big64 : forall a, Rabs a <= 1000000000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 50); [simpl; lra|apply bpow_le; lia]. }
  assert (big32 : forall a, Rabs a <= 1000000000000 -> Rabs a <= bpow radix2 100).
  { intros a Ha. apply Rle_trans with (bpow radix2 50); [simpl; lra|apply bpow_le; lia]. }
  assert (IQ : is64 (square_form R) Q).
  { apply times_exact with Rad Rad; try assumption; [reflexivity|now apply product_is_binary64|apply big64; rewrite Rabs_pos_eq; lra]. }
  (* v, rounded *)
  pose proof (Rabs_pos V) as V0. assert (P0 : 0 < P) by (rewrite <- Erho; now apply Rmult_lt_0_compat).
  assert (BV : Rabs V <= 800000000) by (apply Rabs_le; lra).
  assert (Bvv : Rabs vv <= 1000001 / 1000000 * Rabs V) by (pose proof (Rabs_triang_inv vv V); unfold unit53 in *; lra).
  assert (LV : / 16777400 * Q <= Rabs V) by lra.
  set (a := nearest32 vv). assert (Ia : is32 (to32 v) a) by (apply to32_is; [exact Iv|apply big32; lra]).
  pose proof (close32 vv) as Ea. fold a e in Ea.
  assert (Ba : Rabs (a - V) <= 100001 / 100000 * e * Rabs V).
  { replace (a - V) with ((a - vv) + (vv - V)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (e * Rabs vv <= e * (1000001 / 1000000 * Rabs V)) by (apply Rmult_le_compat_l; lra).
    assert (59 / 1000000000 * Rabs V <= e * Rabs V) by (apply Rmult_le_compat_r; lra). unfold unit53 in *. lra. }
  set (u := e * Rabs V) in *. set (q := e * Q) in *. set (p := e * P) in *.
  assert (Bau : Rabs (a - V) <= 100001 / 100000 * u) by (unfold u; lra).
  assert (HVQ : Q <= P + Rabs V) by (pose proof (Rle_abs V); lra).
  assert (u0 : 0 <= u) by (apply Rmult_le_pos; lra). assert (p0 : 0 <= p) by (apply Rmult_le_pos; lra).
  assert (Hq : 0 <= q <= p + u).
  { split; [apply Rmult_le_pos; lra|]. unfold p, q, u. rewrite <- Rmult_plus_distr_l. apply Rmult_le_compat_l; lra. }
  assert (eu : e * u <= / 10000000 * u) by (apply Rmult_le_compat_r; lra). assert (ep : e * p <= / 10000000 * p) by (apply
    Rmult_le_compat_r; lra).
  assert (eq : e * q <= / 10000000 * q) by (apply Rmult_le_compat_r; lra).
  assert (Lq : 59 / 100000000000 <= q).
  { unfold q. apply Rle_trans with (59 / 1000000000 * / 100); [lra|apply Rmult_le_compat; lra]. }
  assert (uV : u <= / 10000000 * Rabs V) by (apply Rmult_le_compat_r; lra). assert (pP : p <= / 10000000 * P) by (apply Rmult_le_compat_r;
    lra).
  assert (qQ : q <= / 10000000 * Q) by (apply Rmult_le_compat_r; lra).
  (* R^2 in two *)
  set (hd := nearest32 Q). assert (Ihd : is32 (to32 (square_form R)) hd) by (apply to32_is; [exact IQ|apply big32; rewrite Rabs_pos_eq;
    lra]).
  pose proof (close32 Q) as Eh. fold hd e in Eh. rewrite (Rabs_pos_eq Q) in Eh by lra. fold q in Eh.
  destruct (to64_is_exact _ (proj2 Ihd)) as [Vh64 Fh64]. rewrite (proj1 Ihd) in Vh64.
  assert (Ih64 : is64 (to64 (to32 (square_form R))) hd) by now split.
  set (g := nearest64 (Q - hd)). assert (Ig : is64 (minus (square_form R) (to64 (to32 (square_form R)))) g).
  { apply minus_is; try assumption. apply big64. rewrite Rabs_minus_sym. lra. }
  pose proof (difference_is_close Q hd (format_of _ _ IQ) (format_of _ _ Ih64)) as Eg. fold g in Eg. rewrite (Rabs_minus_sym Q hd) in Eg.
  assert (Bg : Rabs g <= 1001 / 1000 * q) by (pose proof (Rabs_triang_inv g (Q - hd)) as T; rewrite (Rabs_minus_sym Q hd) in T; unfold
    unit53 in *; lra).
  set (tl := nearest32 g). assert (Itl : is32 (to32 (minus (square_form R) (to64 (to32 (square_form R))))) tl) by (apply to32_is; [exact
    Ig|apply big32; lra]).
  pose proof (close32 g) as Et. fold tl e in Et.
  assert (Et2 : Rabs (hd + tl - Q) <= 3 / 10000000 * q).
  { replace (hd + tl - Q) with ((tl - g) + (g - (Q - hd))) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (e * Rabs g <= e * (1001 / 1000 * q)) by (apply Rmult_le_compat_l; lra). unfold unit53 in *. lra. }
  assert (Btl : Rabs tl <= 1002 / 1000 * q).
  { pose proof (Rabs_triang_inv tl g). assert (e * Rabs g <= e * (1001 / 1000 * q)) by (apply Rmult_le_compat_l; lra). lra. }
  (* rho^2 *)
  set (y1 := hd - a). assert (By1 : Rabs y1 <= P + 11 / 10 * q + 11 / 10 * u).
  { unfold y1. replace (hd - a) with ((hd - Q) + P + (V - a)) by (rewrite EP; ring).
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_minus_sym V a).
    apply Rle_trans with (Rabs (hd - Q) + Rabs P + Rabs (a - V)); [apply Rplus_le_compat_r, Rabs_triang|]. rewrite (Rabs_pos_eq P) by lra.
      lra. }
  set (s := nearest32 y1). assert (Is : is32 (minus32 (to32 (square_form R)) (to32 v)) s) by (apply minus32_is; try assumption; apply
    big32; fold y1; lra).
  pose proof (close32 y1) as Es. fold s e in Es.
  assert (ey1 : e * Rabs y1 <= p + / 1000000 * (q + u)).
  { apply Rle_trans with (e * (P + 11 / 10 * q + 11 / 10 * u)); [apply Rmult_le_compat_l; lra|]. rewrite !Rmult_plus_distr_l. fold p.
    replace (e * (11 / 10 * q)) with (11 / 10 * (e * q)) by ring. replace (e * (11 / 10 * u)) with (11 / 10 * (e * u)) by ring. lra. }
  set (y2 := s + tl).
  assert (Ey2 : Rabs (y2 - P) <= 100001 / 100000 * p + 100002 / 100000 * u).
  { unfold y2. replace (s + tl - P) with ((s - y1) + (hd + tl - Q) + (V - a)) by (unfold y1; rewrite EP; ring).
    apply Rle_trans with (Rabs (s - y1) + Rabs (hd + tl - Q) + Rabs (V - a)).
    { apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat_r, Rabs_triang. }
    rewrite (Rabs_minus_sym V a). lra. }
  assert (By2 : Rabs y2 <= P + 2 * p + 2 * u).
  { pose proof (Rabs_triang_inv y2 P) as T. rewrite (Rabs_pos_eq P) in T by lra. lra. }
  set (s2 := nearest32 y2). assert (Is2 : is32 (rho_squared_form R (to32 v)) s2) by (apply plus32_is; try assumption; apply big32; fold
    y2; lra).
  pose proof (close32 y2) as E2. fold s2 e in E2.
  assert (Es2 : Rabs (s2 - P) <= 10001 / 10000 * u + 20001 / 10000 * p).
  { replace (s2 - P) with ((s2 - y2) + (y2 - P)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (e * Rabs y2 <= p + / 1000000 * (p + u)).
    { apply Rle_trans with (e * (P + 2 * p + 2 * u)); [apply Rmult_le_compat_l; lra|]. rewrite !Rmult_plus_distr_l. fold p.
      replace (e * (2 * p)) with (2 * (e * p)) by ring. replace (e * (2 * u)) with (2 * (e * u)) by ring. lra. }
    lra. }
  (* the axis is not near *)
  assert (HP : Q <= 62505 / 10000 * P).
  { destruct sixteen_hundredths_is as (h & Ihh & Eh16). apply Rabs_le_inv in Eh16.
    set (h1 := nearest64 (h * Rad)). assert (Bh1 : Rabs (h * Rad) <= 10000).
    { rewrite Rabs_pos_eq by (apply Rmult_le_pos; lra). apply Rle_trans with (1 * 10000); [apply Rmult_le_compat; lra|lra]. }
    pose proof (product_is_close (h * Rad)) as E1. fold h1 in E1. rewrite (Rabs_pos_eq (h * Rad)) in E1 by (apply Rmult_le_pos; lra).
    assert (Ih1 : is64 (times sixteen_hundredths (to64 R)) h1) by (apply times_is; try assumption; apply big64; lra).
    apply Rabs_le_inv in E1. assert (hR : 1599999 / 10000000 * Rad <= h * Rad <= 17 / 100 * Rad) by (split; apply Rmult_le_compat_r; lra).
    assert (Lh1 : 1599998 / 10000000 * Rad <= h1 <= 18 / 100 * Rad) by (unfold unit53 in *; lra).
    assert (hQ : 1599998 / 10000000 * Q <= h1 * Rad <= 18 / 100 * Q).
    { unfold Q. rewrite <- !Rmult_assoc. split; apply Rmult_le_compat_r; lra. }
    pose proof (product_is_close (h1 * Rad)) as E3. set (h2 := nearest64 (h1 * Rad)) in *. rewrite (Rabs_pos_eq (h1 * Rad)) in E3 by lra.
    assert (Ih2 : is64 (times (times sixteen_hundredths (to64 R)) (to64 R)) h2) by (apply times_is; try assumption; apply big64; rewrite
      Rabs_pos_eq; lra).
    apply Rabs_le_inv in E3. assert (Lh2 : 1599997 / 10000000 * Q <= h2 <= Q) by (unfold unit53 in *; lra).
    pose proof (close32 h2) as E4. fold e in E4. rewrite (Rabs_pos_eq h2) in E4 by lra.
    assert (Ih3 : is32 (least_form R) (nearest32 h2)) by (apply to32_is; [exact Ih2|apply big32; rewrite Rabs_pos_eq; lra]).
    rewrite (less32_is _ _ (proj2 Is2) (proj2 Ih3)), (proj1 Is2), (proj1 Ih3) in Doubt.
    assert (Hs2 : nearest32 h2 <= s2) by (revert Doubt; case Rlt_bool_spec; [discriminate|trivial]).
    apply Rabs_le_inv in E4. assert (e * h2 <= e * Q) by (apply Rmult_le_compat_l; lra). fold q in H.
    apply Rabs_le_inv in Es2. destruct (Rle_or_lt V 0) as [HV|HV]; [lra|]. assert (u <= q) by (unfold u, q; apply Rmult_le_compat_l;
      [lra|rewrite Rabs_pos_eq; lra]). lra. }
  assert (Hr0 : 0 < r) by (apply Rdiv_lt_0_compat; lra).
  assert (Err : r * r * P = Q) by (unfold r, Q; rewrite <- Erho; field; lra).
  assert (Hr : 0 < r <= 25002 / 10000).
  { split; [exact Hr0|]. destruct (Rle_or_lt r (25002 / 10000)) as [H|H]; [exact H|exfalso].
    assert (25002 / 10000 * (25002 / 10000) <= r * r) by (apply Rmult_le_compat; lra).
    assert (25002 / 10000 * (25002 / 10000) * P <= r * r * P) by (apply Rmult_le_compat_r; lra). lra. }
  split; [exact Hr|].
  assert (EV : V = (r * r - 1) * P) by (rewrite Rmult_minus_distr_r, Err; lra).
  set (m := Rabs (r * r - 1)) in *. assert (Em : Rabs V = m * P) by (rewrite EV, Rabs_mult, (Rabs_pos_eq P) by lra; reflexivity).
  assert (LP : / 1000 <= P) by lra. assert (M0 : 0 <= m) by apply Rabs_pos.
  assert (pm : p <= / 10000000 * P) by exact pP.
  (* the root *)
  apply Rabs_le_inv in Es2 as Es2'. assert (u1 : u <= / 10000000 * (7 * P)).
  { apply Rle_trans with (1 := uV). apply Rmult_le_compat_l; [lra|]. apply Rabs_le. lra. }
  assert (Bs2 : 99999 / 100000 * P <= s2 <= 100001 / 100000 * P) by lra.
  set (rt := sqrt s2). assert (Rt : rt * rt = s2) by (apply sqrt_sqrt; lra). assert (rt0 : 0 <= rt) by apply sqrt_pos.
  assert (rtB : 999 / 1000 * rho <= rt <= 1001 / 1000 * rho).
  { split.
    - destruct (Rle_or_lt (999 / 1000 * rho) rt) as [H|H]; [exact H|exfalso].
      assert (rt * rt <= 999 / 1000 * rho * (999 / 1000 * rho)) by (apply Rmult_le_compat; lra).
      replace (999 / 1000 * rho * (999 / 1000 * rho)) with (998001 / 1000000 * P) in H0 by (rewrite <- Erho; field). lra.
    - destruct (Rle_or_lt rt (1001 / 1000 * rho)) as [H|H]; [exact H|exfalso].
      assert (1001 / 1000 * rho * (1001 / 1000 * rho) <= rt * rt) by (apply Rmult_le_compat; lra).
      replace (1001 / 1000 * rho * (1001 / 1000 * rho)) with (1002001 / 1000000 * P) in H0 by (rewrite <- Erho; field). lra. }
  assert (Lrho : / 100 <= rho <= 30000).
  { split; [destruct (Rle_or_lt (/ 100) rho) as [H|H]; [exact H|exfalso]; assert (rho * rho <= / 100 * / 100) by (apply Rmult_le_compat;
    lra); lra|].
    destruct (Rle_or_lt rho 30000) as [H|H]; [exact H|exfalso]; assert (30000 * 30000 <= rho * rho) by (apply Rmult_le_compat; lra); lra. }
  set (root := nearest32 rt). pose proof (close32 rt) as Eroot. fold root e in Eroot. rewrite (Rabs_pos_eq rt) in Eroot by lra.
  pose proof (square_root32_is _ _ Is2 ltac:(lra)) as Iroot. fold rt root in Iroot.
  assert (ert : 59 / 1000000000 * rt <= e * rt <= / 10000000 * rt) by (split; apply Rmult_le_compat_r; lra).
  assert (Eroot2 : Rabs (root - rt) <= 10001 / 10000 * e * rt) by lra.
  pose proof (Rabs_le_inv _ _ Eroot2) as Eroot3.
  assert (rootB : 998 / 1000 * rho <= root <= 1002 / 1000 * rho) by lra.
  (* the product with R *)
  assert (ER : Rad = r * rho) by (unfold r; field; lra).
  set (x := Rad * root). assert (xB : 998 / 1000 * (r * P) <= x <= 1002 / 1000 * (r * P)).
  { unfold x. replace (998 / 1000 * (r * P)) with (Rad * (998 / 1000 * rho)) by (rewrite ER, <- Erho; ring).
    replace (1002 / 1000 * (r * P)) with (Rad * (1002 / 1000 * rho)) by (rewrite ER, <- Erho; ring). split; apply Rmult_le_compat_l; lra. }
  assert (xL : / 2000 <= x <= 400000000).
  { unfold x. split; [apply Rle_trans with (/ 10 * (998 / 1000 * / 100)); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (10000 * (1002 / 1000 * 30000)); [apply Rmult_le_compat; lra|lra]. }
  set (prod := nearest32 x). pose proof (close32 x) as Eprod. fold prod e in Eprod. rewrite (Rabs_pos_eq x) in Eprod by lra.
  assert (IR32 : is32 (to32 (to64 R)) Rad).
  { apply to32_exact; [exact IR|exact GR|]. apply big32. rewrite Rabs_pos_eq; lra. }
  pose proof (times32_is _ _ _ _ IR32 Iroot ltac:(apply big32; fold x; rewrite Rabs_pos_eq; lra)) as Iprod. fold x prod in Iprod.
  assert (ex : 59 / 1000000000 * x <= e * x <= / 10000000 * x) by (split; apply Rmult_le_compat_r; lra).
  assert (Eprod2 : Rabs (prod - x) <= 10001 / 10000 * e * x) by lra. pose proof (Rabs_le_inv _ _ Eprod2) as Eprod3.
  (* the sum *)
  set (y := prod + s2). assert (yL : / 2000 <= y <= 1200000000) by (unfold y; lra).
  set (sum := nearest32 y). pose proof (close32 y) as Esum. fold sum e in Esum. rewrite (Rabs_pos_eq y) in Esum by lra.
  pose proof (plus32_is _ _ _ _ Iprod Is2 ltac:(apply big32; fold y; rewrite Rabs_pos_eq; lra)) as Isum. fold y sum in Isum.
  assert (ey : 59 / 1000000000 * y <= e * y <= / 10000000 * y) by (split; apply Rmult_le_compat_r; lra).
  assert (Esum2 : Rabs (sum - y) <= 10001 / 10000 * e * y) by lra. pose proof (Rabs_le_inv _ _ Esum2) as Esum3.
  assert (sumB : / 3000 <= sum <= 1300000000) by lra.
  (* the quotient *)
  assert (aB : / 3000000000 <= Rabs a <= 900000000).
  { pose proof (Rabs_triang_inv V a) as T1. rewrite (Rabs_minus_sym V a) in T1. pose proof (Rabs_triang_inv a V) as T2. lra. }
  set (z := a / sum). assert (zB : / 10000000000000000000 <= Rabs z <= 3000000000000).
  { unfold z, Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq sum) by lra.
    assert (I1 : / 1300000000 <= / sum <= 3000).
    { split; [apply Rinv_le; lra|]. replace 3000 with (/ / 3000) by field. apply Rinv_le; lra. }
    split; [apply Rle_trans with (/ 3000000000 * / 1300000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (900000000 * 3000); [apply Rmult_le_compat; lra|lra]. }
  set (t := nearest32 z). pose proof (close32 z) as Etq. fold t e in Etq.
  assert (zbig : Rabs z <= bpow radix2 100) by (apply Rle_trans with (bpow radix2 50); [simpl; lra|apply bpow_le; lia]).
  pose proof (over32_is _ _ _ _ Ia Isum ltac:(lra) zbig) as Iq. fold z t in Iq.
  assert (ez : 59 / 1000000000 * Rabs z <= e * Rabs z) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  exists t. split; [exact Iq|].
  (* everything divided by rho *)
  assert (scale : forall b c k n, Rabs (b - c) <= k -> 0 < n -> Rabs (b / n - c / n) <= k / n).
  { intros b c k n H Hn. replace (b / n - c / n) with ((b - c) / n) by (field; lra). unfold Rdiv. rewrite Rabs_mult, Rabs_inv,
    (Rabs_pos_eq n) by lra.
    apply Rmult_le_compat_r; [apply Rlt_le; now apply Rinv_0_lt_compat|exact H]. }
  apply (rough_t_is r (a / P) (s2 / P) (root / rho) (prod / P) (sum / P) t Hr); fold e m.
  - replace (r * r - 1) with (V / P) by (rewrite EV; field; lra).
    replace (10001 / 10000 * e * m) with (10001 / 10000 * u / P) by (unfold u; rewrite Em; field; lra). apply scale; [lra|exact P0].
  - replace 1 with (P / P) at 1 by (field; lra).
    replace (e * (10001 / 10000 * m + 20001 / 10000)) with ((10001 / 10000 * u + 20001 / 10000 * p) / P) by (unfold u, p; rewrite Em;
      field; lra).
    apply scale; [|exact P0]. lra.
  - assert (Eq : sqrt (s2 / P) = rt / rho).
    { unfold rt. rewrite sqrt_div_alt by lra. f_equal. rewrite <- Erho. apply sqrt_square. lra. }
    rewrite Eq. replace (10001 / 10000 * e * (rt / rho)) with (10001 / 10000 * e * rt / rho) by (field; lra). now apply scale.
  - replace (r * (root / rho)) with (x / P) by (unfold x; rewrite ER, <- Erho; field; lra).
    replace (10001 / 10000 * e * (x / P)) with (10001 / 10000 * e * x / P) by (field; lra). now apply scale.
  - replace (prod / P + s2 / P) with (y / P) by (unfold y; field; lra).
    replace (10001 / 10000 * e * (y / P)) with (10001 / 10000 * e * y / P) by (field; lra). now apply scale.
  - replace (a / P / (sum / P)) with z by (unfold z; field; lra). lra.
Qed.
