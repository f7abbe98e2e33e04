#!/usr/bin/env bash
# refused_test.sh SOURCE COMPILER EIGEN: scripts/proofs must refuse a wrong line of the code, a wrong constant in a definition, a wrong
# statement or specification, a proof that is missing, and an axiom; recorded_test.sh, a first stage that has changed, and scripts/proofs
# again where what is recorded has changed as well. Each is planted in a copy. Exits 77 where scripts/proofs does.
set -euo pipefail
source=$(realpath "$1") compiler=$2 eigen=$3
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/scripts"
cp "$source/scripts/proofs" "$copy/scripts"
cp -r "$source/proofs" "$source/fast" "$source/include" "$source/rendering" "$source/text" "$copy"
mkdir "$copy/tests"
cp -r "$source/tests/proofs" "$copy/tests"
code=0
"$copy/scripts/proofs" "$copy/build" > "$copy/said" 2>&1 || code=$?
[ "$code" = 0 ] || { cat "$copy/said"; exit "$code"; }

wrong=0 planted=0
plant() {  # file, what stands there, what is planted
  planted=$((planted + 1))
  cp "$copy/$1" "$copy/kept"
  python3 - "$copy/$1" "$2" "$3" <<'EOF'
import sys
path, old, new = sys.argv[1:]
with open(path) as file:
    text = file.read()
assert text.count(old) == 1, f"{path}: {text.count(old)} times: {old}"
with open(path, "w") as file:
    file.write(text.replace(old, new))
EOF
}
restore() { cp "$copy/kept" "$copy/$1"; }  # file
proofs_refuse() {  # words of the refusal
  rm -rf "$copy/tried"
  cp -a "$copy/build" "$copy/tried"
  ! "$copy/scripts/proofs" "$copy/tried" > "$copy/said" 2>&1 && grep -q "$1" "$copy/said"
}
not_refused() {  # file, what stands there, what is planted
  echo "NOT REFUSED: $1: \"$3\" in the place of \"$2\""
  tail -n 5 "$copy/said"
  wrong=$((wrong + 1))
}
refuses() {  # file, what stands there, what is planted, words of the refusal
  plant "$@"
  proofs_refuse "$4" || not_refused "$@"
  restore "$1"
}
# Another definition or specification: it is refused as one that nobody has read, and, were it read, as one of which the theorems are not
# true.
defines_otherwise() {  # file, what stands there, what is planted
  plant "$@"
  proofs_refuse "does not state" || not_refused "$@"
  cp "$copy/proofs/code.txt" "$copy/stored"
  "$copy/proofs/digests.py" --renew "$1"
  proofs_refuse "Error" || not_refused "$@"
  cp "$copy/stored" "$copy/proofs/code.txt"
  restore "$1"
}
states_otherwise() { defines_otherwise proofs/spec/Laws.v "$@"; }  # what stands there, what is planted
# A header of which the first stages that are recorded are no longer those stored; and, were they stored, no longer those proved.
records_otherwise() {  # file, what stands there, what is planted
  plant "$@"
  "$compiler" -std=c++20 -ffp-contract=off -I"$copy" -I"$copy/include" -isystem "$eigen" "$copy/tests/proofs/recorded_terms.cpp" \
    -o "$copy/recorded_terms"
  if "$copy/tests/proofs/recorded_test.sh" "$copy/recorded_terms" "$copy/proofs/recorded/Recorded.v" > "$copy/said" 2>&1; then
    not_refused "$@"
  fi
  cp "$copy/proofs/recorded/Recorded.v" "$copy/stored"
  "$copy/recorded_terms" > "$copy/proofs/recorded/Recorded.v"
  proofs_refuse "Error" || not_refused "$@"
  cp "$copy/stored" "$copy/proofs/recorded/Recorded.v"
  restore "$1"
}
refuses proofs/recorded/RecordedStages.v "Definition bump_3p_limbs : nat := 64." "Definition bump_3p_limbs : nat := 32." "Error"
records_otherwise fast/laws/wall.h "larger(Real(-K) * z, Real(0))" "larger(Real(K) * z, Real(0))"
records_otherwise fast/laws/shading.h "(Real(R) - x) * (Real(R) + x)" "(Real(R) - x) * (Real(R) - x)"
records_otherwise fast/laws/bump_1p_shaded.h "absolute(x) <= Real(half_width)" "x <= Real(half_width)"
records_otherwise fast/laws/bump_1p_shaded.h "kErrorBound = 0x1p-50" "kErrorBound = 0x1p-51"
refuses proofs/numbers/RoundingTest.v "(2 ^ 29 - 1 - 2 * W <=?" "(2 ^ 29 - 2 * W <=?" "Error"
refuses proofs/numbers/RoundingTest.v "((2 ^ 29 - 1) / 2 - W)) mod 2 ^ 64)" "((2 ^ 29 - 1) / 2 + W)) mod 2 ^ 64)" "Error"
refuses proofs/numbers/RoundingTest.v "(0 < k <= 2 ^ 20)%Z ->" "(0 <= k <= 2 ^ 20)%Z ->" "Error"
refuses proofs/numbers/RoundingTest.v "in_doubt (k + 1) (bits_of_b64 v) = false -> is" "in_doubt k (bits_of_b64 v) = false -> is" "Error"
refuses proofs/numbers/Comparisons.v "false 8388608 (-53) eq_refl" "false 8388608 (-52) eq_refl" "Error"
refuses proofs/numbers/Comparisons.v "if is_at_most32 quantum (b32_abs x) then x else zero32" \
  "if is_at_most32 quantum x then x else zero32" "Error"
refuses proofs/recorded/Recorded.v "Definition wall_window : Z := 0" "Definition wall_window : Z := 1" "Error"
refuses proofs/geometry/Shaded.v "(n + 11 / 2 * one) * (1001 / 1000) <= IZR k ->" "(n + 9 / 2 * one) * (1001 / 1000) <= IZR k ->" "Error"
states_otherwise "then K * M * (X / Rad) else 0." "then K * M * (X / w) else 0."
states_otherwise "if Rle_bool (Rabs X) (w / 2) then sqrt (Rsqr Rad - Rsqr X) / Rad else 1" \
  "if Rlt_bool (Rabs X) (w / 2) then sqrt (Rsqr Rad - Rsqr X) / Rad else 1"
records_otherwise fast/laws/polygon_gap.h "absolute(value) < Real(0x1p-27) * height" "absolute(value) < Real(0x1p-29) * height"
records_otherwise fast/laws/polygon_gap.h "(error + (height_tail - slope_tail * ax))" "(error - (height_tail - slope_tail * ax))"
records_otherwise fast/laws/bump_2p.h "x < Real(0), Real(-K_sine), Real(K_sine)" "x <= Real(0), Real(-K_sine), Real(K_sine)"
records_otherwise fast/laws/bump_3p.h "on_side = inside & !on_top" "on_side = inside & on_top"
records_otherwise fast/laws/bump_2p_shaded.h "kErrorBound = 0x1.8p-50" "kErrorBound = 0x1p-50"
refuses proofs/geometry/Gap.v "height_share : R := / 19807040628566084398385987584." "height_share : R := / 1980704062856608439838." "Error"
refuses proofs/geometry/Gap.v "in_binary64 h -> in_binary64 p -> 0 <= p <= 2 * h ->" "in_binary64 h -> in_binary64 p -> 0 <= p ->" "Error"
states_otherwise "bump_height Rad w * (1 - 2 * Rabs X / w) - Z" "bump_height Rad w * (1 - Rabs X / w) - Z"
refuses proofs/geometry/Polygons.v "unit53 * (1 + / 1000000) * Rabs exact" "unit53 * 5 * Rabs exact" "Error"
states_otherwise "2 * bump_height Rad w / w." "bump_height Rad w / w."
states_otherwise "(top_width Rad w / 2) then 0 else slope_3p Rad w." "(top_width Rad w / 2) then slope_3p Rad w else 0."
records_otherwise fast/laws/cylinder.h "multiply_subtract(z, z, a - b)" "multiply_subtract(z, z, b - a)"
records_otherwise fast/laws/cylinder.h "force.doubt = force.doubt | (z == Real(axis));" "force.doubt = force.doubt | (z == Real(R));"
records_otherwise fast/laws/cylinder.h "Real(0x1p-47 * R * R)" "Real(0x1p-50 * R * R)"
refuses proofs/laws/CylinderFirst.v "depth_anchor : is64 anchor (8 *" "depth_anchor : is64 anchor (4 *" "Error"
refuses proofs/laws/CylinderOutside.v "value32 R * value32 R <= X * X + L * L ->" "value32 R * value32 R - 1 <= X * X + L * L ->" "Error"
states_otherwise "K * (Rad - rho) * (if Req_bool rho 0 then 0" "K * (Rad + rho) * (if Req_bool rho 0 then 0"
records_otherwise fast/laws/bump_cylinder.h "cylinder.contact & (z <= Real(axis))" "cylinder.contact & (z < Real(axis))"
records_otherwise fast/laws/bump_cylinder.h "cylinder.z + from_wall, contact" "cylinder.z - from_wall, contact"
refuses proofs/laws/CylinderAnswers.v "X Z + Rmax (- value32 K * Z) 0)." "X Z + - value32 K * Z)." "Error"
records_otherwise fast/numbers/double_double.h "fused(-root, root, a.hi) + a.lo" "fused(-root, root, a.hi) - a.lo"
records_otherwise fast/numbers/double_double.h "remainder / (root + root)" "remainder / root"
refuses proofs/laws/CylinderFirst.v "in_binary32 Z -> Z = 0 \\/ bpow radix2 (-30) <= Rabs Z -> Z <>" "in_binary32 Z -> Z <>" "Error"
refuses proofs/geometry/Depth.v "almost_one : binary64 := constant (2 ^ 50 - 1) (-50)" \
  "almost_one : binary64 := constant (2 ^ 50 - 1) (-80)" "Error"
refuses proofs/geometry/Depth.v "Rabs (d - (h + l)) <= 9 * (unit53 * unit53) * h" \
  "Rabs (d - (h + l)) <= 9 * (unit53 * unit53 * unit53) * h" "Error"
refuses proofs/double_double/Split.v "times (constant (2 ^ 24 + 1) 0) (hi a)" "times (constant (2 ^ 23 + 1) 0) (hi a)" "Error"
refuses proofs/laws/CylinderConstants.v "times (times (two_to 3) (to64 R)) (to64 R)" "times (times (two_to 2) (to64 R)) (to64 R)" "Error"
records_otherwise fast/numbers/double_double.h "fused(-quotient, b.lo, a.lo)" "fused(quotient, b.lo, a.lo)"
refuses proofs/geometry/TwoPolygonsConstants.v "multiply (tangent_2p R w) (exactly64 (half_width w))" \
  "multiply (tangent_2p R w) (exactly64 (to64 w))" "Error"
refuses proofs/double_double/DoubleDoubleNear.v "13 * (unit53 * unit53) * ((c + k) / (h + l)))." \
  "4 * (unit53 * unit53) * ((c + k) / (h + l)))." "Error"
refuses proofs/double_double/DoubleDoubleHolds.v "holds (n + m + 8) (3" "holds (n + m + 6) (3" "Error"
refuses proofs/double_double/DoubleDoubleHolds.v "holds (n / 2 + 10) (3" "holds (n / 3 + 10) (3" "Error"
refuses proofs/geometry/TwoPolygonsConstants.v "root_of (divide (sum_2p R w) (diameter R))" "root_of (divide (diameter R) (sum_2p R w))" \
  "Error"
refuses proofs/geometry/ThreePolygonsFace.v "Definition side_cosine (t : R) : R := 1 - 2 * t * t." \
  "Definition side_cosine (t : R) : R := 1 - t * t." "Error"
refuses proofs/geometry/ThreePolygonsFace.v "2 * c <= Rad /\\ 0 <=" "c <= Rad /\\ 0 <=" "Error"
refuses proofs/geometry/ThreePolygonsConstants.v "multiply (twice (half_top_3p R t)) (sine_3p_of t)" \
  "multiply (half_top_3p R t) (sine_3p_of t)" "Error"
refuses proofs/sine_of_third/NewtonStart.v "15 / 100 * (rho * rho) * t." "14 / 100 * (rho * rho) * t." "Error"
refuses proofs/sine_of_third/NewtonStart.v "Rabs (sqrt (r / 5) - u)" "Rabs (sqrt (r / 4) - u)" "Error"
refuses proofs/sine_of_third/NewtonRounded.v "(times (times (whole 12) t) t)" "(times (times (whole 11) t) t)" "Error"
refuses proofs/sine_of_third/NewtonRounded.v "Rabs (y - v) <= 8 * unit53 * v" "Rabs (y - v) <= 6 * unit53 * v" "Error"
refuses proofs/sine_of_third/NewtonThird.v "(unit53 * t)) + 24 * (unit53 * (rho * t)))" "(unit53 * t)) + 14 * (unit53 * (rho * t)))" "Error"
refuses proofs/sine_of_third/NewtonRest.v "is_off (rest_slope a) (12 * y * (1 - y))" "is_off (rest_slope a) (12 * y * (1 + y))" "Error"
refuses proofs/sine_of_third/SineOfThird.v "holds 70 (/ 10000) (sine_of_third R w)" "holds 60 (/ 10000) (sine_of_third R w)" "Error"
refuses proofs/double_double/DoubleDoubleTerms.v \
  "<= 7 * (unit53 * (unit53 * M)) /\\ Rabs p <= 101 / 100 * M /\\ Rabs q <= 101 / 100 * (unit53 * M) /\\" \
  "<= 5 * (unit53 * (unit53 * M)) /\\ Rabs p <= 101 / 100 * M /\\ Rabs q <= 101 / 100 * (unit53 * M) /\\" "Error"
refuses proofs/double_double/DoubleDoubleOff.v "- (h + l) / (c + k)) <= 20 * (unit53 * Q)" "- (h + l) / (c + k)) <= 10 * (unit53 * Q)" \
  "Error"
refuses proofs/double_double/DoubleDoubleOff.v "(101 / 100 * (m' * e) + Rabs x * e' + 7 " "(101 / 100 * (m' * e) + 7 " "Error"
refuses proofs/numbers/ExactSign.v "first_sign (rev (expansion terms))" "first_sign (expansion terms)" "Error"
refuses proofs/numbers/ExactSign.v "sum_low carry x :: grow (plus carry x) rest" "plus carry x :: grow (sum_low carry x) rest" "Error"
refuses proofs/geometry/TopEdge.v "times (whole (-2)) scaled; opp scaled;" "times (whole (-2)) scaled; scaled;" "Error"
refuses proofs/geometry/TopEdge.v "if is_on_top32 (next_above c) R w then next_above c" "if is_on_top32 c R w then next_above c" "Error"
refuses proofs/geometry/ThreePolygonsRight.v "(half_top_3p R (sine_of_third R w)))." "(half_top_3p w (sine_of_third R w)))." "Error"
refuses proofs/numbers/Nearness.v "Definition one : R := 1001 / 1000." "Definition one : R := 999 / 1000." "Error"
refuses proofs/stages/Inputs.v "times (two_to (-1)) (to64 w)" "times (two_to (-2)) (to64 w)" "Error"
refuses proofs/stages/Evaluate.v "negb (in_doubt window (bits_of_b64 (first_x first))) &&" "" "Error"
refuses proofs/laws/Wall.v "(Z < 0) 0 (- value32 K * Z)." "(Z < 0) 0 (value32 K * Z)." "Error"
refuses proofs/laws/Wall.v "(Z < 0) 0 (- value32 K * Z)." "(Z <= 0) 0 (- value32 K * Z)." "Error"
defines_otherwise proofs/batches/Lanes.v "(bits_of_b32 ten_thousand <? bits_of_b32 size)" "(bits_of_b32 size <? bits_of_b32 ten_thousand)"
defines_otherwise proofs/code/Walk.v "if is_in_place && negb answered then s" "if negb is_in_place && negb answered then s"
refuses proofs/recorded/RecordedForms.v "let t44 := orb t41 t43 in" "let t44 := andb t41 t43 in" "Error"
refuses proofs/recorded/RecordedForms.v "let t25 := if t8 then K else K_cosine in" "let t25 := if t8 then K_cosine else K in" "Error"
refuses proofs/Main.v "(exact_bump_2p (value32 R)" "(exact_bump_3p (value32 R)" "does not state"
refuses proofs/code/Code.v "code_of_wall (is_fused : bool) (R w K" "code_of_wall (is_fused : bool) (R K w" "does not state"
refuses proofs/stages/Inputs.v "Theorem product_is_exact : forall a b : binary32, generic" \
  "Axiom product_is_exact : forall a b : binary32, generic" "no proofs"
refuses proofs/numbers/Formats.v "Global Instance prec24" "Lemma lost : 1 = 2. Admitted.
Global Instance prec24" "no proofs"
refuses proofs/numbers/ErrorFree.v "nearest64 (nearest64 (a - nearest64 (s - t)) + nearest64 (b - t)) = a + b." \
  "nearest64 (nearest64 (a - s) + nearest64 (b - t)) = a + b." "Error"
refuses proofs/numbers/ErrorFree.v "Rabs b <= Rabs a \\/ a = 0 ->" "Rabs a <= Rabs b \\/ a = 0 ->" "Error"
refuses proofs/numbers/ErrorFree.v "bpow radix2 (-1074 + 2 * 53 - 1) <=" "bpow radix2 (-1074 + 53) <=" "Error"
refuses proofs/meshes/MeshBounds.v "-> fits 159 203" "-> fits 159 202" "Error"
refuses proofs/meshes/MeshBounds.v "Definition end_of_domain := 10000%Z." "Definition end_of_domain := 20000%Z." "Error"
refuses proofs/meshes/MeshBoundsMoves.v "fits 212 319" "fits 212 318" "Error"
refuses proofs/meshes/MeshBoundsMoves.v "(scaled (over_landing a b c p) (minus p g))." "(scaled (over_landing a b c p) (minus g p))." \
  "Error"
refuses proofs/meshes/MeshBoundsShaded.v "all_fit 987 1226" "all_fit 987 1225" "Error"
refuses proofs/meshes/MeshBoundsPulled.v "fits 810 1230 (rest_squared" "fits 810 1229 (rest_squared" "Error"
refuses proofs/meshes/MeshDecisions.v "(along_plane n u = sqrt (square u) <-> dot n u = 0)" \
  "(along_plane n u = sqrt (square u) <-> dot n u <= 0)" "Error"
refuses proofs/meshes/MeshConsequences.v "square (minus r g) / 2 < dot" "square (minus r g) < dot" "Error"
refuses proofs/meshes/MeshConsequences.v "<= 6 * (s * t * delta)." "<= 3 * (s * t * delta)." "Error"
refuses proofs/device/Damping.v "m * dot (damper B S t f v) v <= - square" "m * dot (damper B S t f v) v <= - 2 * square" "Error"
refuses proofs/device/Damping.v "1 / (4 * (1 - a) * (2 - a))." "1 / (4.01 * (1 - a) * (2 - a))." "Error"
refuses proofs/device/Damping.v "(spring k = zero -> along_share k = 0 /\\ across_share k = 0)." "True." "Error"
refuses proofs/energy/Conservative.v "K * half_square (Rad - distance" "K * half_square (distance" "Error"
refuses proofs/energy/EdgeLoops.v "(1 - sqrt ((Rad + axis_depth Rad w) / (2 * Rad)))" "(1 - sqrt ((Rad + axis_depth Rad w) / Rad))" "Error"
refuses proofs/energy/Strokes.v "p e - work p a = K * D / Rad * (w * w / 8)." "p e - work p a = K * D / Rad * (w * w / 4)." "Error"
refuses proofs/device/Placement.v "then (from, negb (snd d)) else d" "then (from, snd d) else d" "Error"
refuses include/forceshade/placement.h "direction = {from, !direction.is_against};" "direction = {from, direction.is_against};" \
  "is not the code"
refuses proofs/meshes/MeshSigns.v "Definition code_normal : code_bound := code_cross" \
  "Definition code_normal : code_bound := code_multiply" "Error"
refuses proofs/meshes/MeshConstants.v "once_rounded (s o : R) : bound := Bound ((1 + unit53) * s) (o + unit53 * s)." \
  "once_rounded (s o : R) : bound := Bound ((1 + unit53) * s) o." "Error"
refuses proofs/meshes/MeshSide.v "(times (code_error code_across) (times" "(times (code_error code_along) (times" "Error"
refuses fast/meshes/rounding_bound.h "kSlack * (propagated + kUnit * size)" "kSlack * propagated" "is not the code"
refuses proofs/soups/SoupNumbers.v "plus (two_to 0) (two_to (-48))." "plus (two_to 0) (two_to (-51))." "Error"
refuses proofs/soups/SoupNumbers.v "least : binary64 := two_to (-1040)." "least : binary64 := two_to (-1070)." "Error"
refuses proofs/soups/SoupSigns.v "in_units t b -> in_units (s * t) (product a b)" "in_units t b -> in_units s (product a b)" "Error"
refuses fast/soups/numbers.h "kSlack * (propagated + kUnit * __builtin_fabs(value)) + kLeast" "propagated + kUnit * __builtin_fabs(value)" \
  "is not the code"
refuses proofs/numbers/Intervals.v "Rabs c * s + (Rabs d + s) * r." "Rabs c * s + Rabs d * r." "Error"
refuses proofs/stages/Acceptance.v "exact = up /\\ is_even c = true ->" "exact = up ->" "Error"
refuses proofs/stages/Acceptance.v ": bool := Z.even (bits_of_b32 c)." ": bool := Z.odd (bits_of_b32 c)." "Error"
refuses proofs/separation/Separation.v "multiple (2 * k) (t * t) -> a + t <> 0 ->" "multiple (3 * k) (t * t) -> a + t <> 0 ->" "Error"
refuses proofs/separation/Separation.v "(m = (c + succ radix2 fexp32 c) / 2 \\/" "(m = (c + succ radix2 fexp32 c) / 4 \\/" "Error"
refuses proofs/separation/SeparationOfCylinder.v "(Fx <> m -> bpow radix2 (-946)" "(Fx <> m -> bpow radix2 (-945)" "Error"
refuses proofs/separation/SeparationOfCylinder.v "multiple 53 y0 -> multiple 150 M ->" "multiple 53 y0 -> multiple 151 M ->" "Error"
refuses proofs/separation/SeparationOfBump2pShaded.v "multiple 53 Z -> multiple 87 A ->" "multiple 53 Z -> multiple 107 A ->" "Error"
refuses proofs/double_double/SumOfTwo.v "Rabs (p + q - (h + l + (c + k))) <= 3 * (unit53" \
  "Rabs (p + q - (h + l + (c + k))) <= 2 * (unit53" "Error"
refuses proofs/double_double/EnclosedSums.v "  encloses (3 * (s + t) + 3 * share101) (add a b)" \
  "  encloses (3 * s + 3 * share101) (add a b)" "Error"
refuses proofs/separation/SeparationOfBump2p.v "(Fx <> m -> bpow radix2 (-859)" "(Fx <> m -> bpow radix2 (-858)" "Error"
refuses proofs/separation/SeparationOfCubic.v "multiple (k - 29) b /\\ multiple (k - 58) c /\\" \
  "multiple (k - 29) b /\\ multiple (k - 57) c /\\" "Error"
refuses proofs/separation/SeparationOfBump3p.v "om * r2 * r3 = - (w * (Rad * Rad));" "om * r2 * r3 = - (2 * w * (Rad * Rad));" "Error"
refuses proofs/separation/SeparationOfBump3p.v "(Fx <> m -> bpow radix2 (-2033)" "(Fx <> m -> bpow radix2 (-2032)" "Error"
refuses proofs/separation/SeparationOfBump3pShaded.v "multiple 106 (s * s) -> s * s <= Rad * Rad -> multiple 33 K" \
  "multiple 116 (s * s) -> s * s <= Rad * Rad -> multiple 33 K" "Error"
refuses proofs/separation/SeparationOfContact.v "Z + d <> 0 -> bpow radix2 (-121)" "Z + d <> 0 -> bpow radix2 (-120)" "Error"
refuses proofs/separation/SeparationOfContact.v "M <> 0 -> bpow radix2 (-909)" "M <> 0 -> bpow radix2 (-908)" "Error"
refuses proofs/double_double/Enclosures.v "    Rabs (h + l - x) <= e." "    Rabs (h + l - x) <= e / 2." "Error"
refuses proofs/stages/BesideTie.v "(times (absolute (hi a)) almost_one)) then is_unknown" "(absolute (hi a))) then is_unknown" "Error"
refuses proofs/stages/SecondStage.v ": binary64 := times (two_to (-1)) (plus" ": binary64 := times (two_to (-2)) (plus" "Error"
refuses proofs/laws/Bump1pShaded.v "decide_along K (divide gap radius) X (root_of" "decide_along K gap X (root_of" "Error"
refuses proofs/double_double/EnclosedProducts.v "Prop := 98 / 100 * (share101" "Prop := 102 / 100 * (share101" "Error"
refuses proofs/stages/SecondAlong.v "h * c <= 25000)." "h * c <= 30000)." "Error"
refuses proofs/geometry/TwoPolygonsGap.v "Z = 0 \\/ / 10000000000 <= Rabs Z <= 10000 ->" "Rabs Z <= 10000 ->" "Error"
refuses proofs/geometry/TwoPolygonsGap.v "(hi gap)) <= 22400 /\\ value64" "(hi gap)) <= 26400 /\\ value64" "Error"
refuses proofs/stages/SecondAlong.v "forall answer p q Fx Fz, (p <-> q) ->" "forall answer p q Fx Fz, (p -> q) ->" "Error"
refuses proofs/stages/ShadedAlong.v "Rabs (value64 (hi (divide gap b))) * c <= 22700 /\\" \
  "Rabs (value64 (hi (divide gap b))) * c <= 22600 /\\" "Error"
refuses proofs/stages/ShadedAlong.v "Lemma sign_unknown : forall a h e, is64 (hi a) h -> is64 (error a) e -> 0 < e -> Rabs h <= e ->" \
  "Lemma sign_unknown : forall a h e, is64 (hi a) h -> is64 (error a) e -> 0 < e -> Rabs h <= 2 * e ->" "Error"
refuses proofs/stages/ShadedAlong.v "(value32 w / 2 < Rabs X -> M = - Z) ->" "(value32 w / 2 < Rabs X -> M = Z) ->" "Error"
refuses proofs/geometry/ThreePolygonsEnclosed.v "encloses (7 * (s + t) + 3 * share101) (add a" \
  "encloses (2 * (s + t) + 3 * share101) (add a" "Error"
refuses proofs/geometry/ThreePolygonsEnclosed.v "encloses (1300 * s + 1300 * share101) (tangent_3p t)" \
  "encloses (1100 * s + 1300 * share101) (tangent_3p t)" "Error"
refuses proofs/sine_of_third/NewtonEnclosed.v "encloses (/ 1000000000000) (widened (midpoint x)) y." \
  "encloses (/ 2000000000000) (widened (midpoint x)) y." "Error"
refuses proofs/sine_of_third/SineEnclosed.v "encloses (80000 * share101) (sine_of_third R w)" \
  "encloses (60000 * share101) (sine_of_third R w)" "Error"
refuses proofs/geometry/TwoPolygonsGap.v "T * (value32 w / 2 - Rabs X) <= 10000 ->" "T * (value32 w / 2 - Rabs X) <= 20000 ->" "Error"
refuses proofs/double_double/EnclosedQuotients.v "encloses s a x -> encloses t b y -> 0 <= s <= 10 -> 0 <= t <= / 1000 ->" \
  "encloses s a x -> encloses t b y -> 0 <= s <= 10 -> 0 <= t <= 1 ->" "Error"
refuses proofs/laws/CylinderNearness.v "bpow radix2 (2 * k - 70) <= Rabs (A * A - C * C - Y * Y)." \
  "bpow radix2 (2 * k - 69) <= Rabs (A * A - C * C - Y * Y)." "Error"
refuses proofs/laws/CylinderSecondBorder.v "  encloses (21 * share101) (second_squares w xv) A" \
  "  encloses (17 * share101) (second_squares w xv) A" "Error"
refuses proofs/laws/CylinderSecond.v "(is_positive, exactly64 zero64, multiply" "(is_positive, exactly64 (to64 K), multiply" "Error"
refuses proofs/laws/BumpCylinder.v "| is_unknown => cylinder" "| is_unknown => plane_outcome K z" "Error"
refuses proofs/limbs/Limbs.v "Forall is_limb sum /\\ length sum = length a /\\ 0 <= last <= 1 /\\" \
  "Forall is_limb sum /\\ length sum = length a /\\ last = 0 /\\" "Error"
defines_otherwise proofs/limbs/LimbShifts.v "Z.lor (low / 2 ^ part) (word (high * 2 ^ (64 - part)))." \
  "Z.lor (low / 2 ^ part) (word (high * 2 ^ (63 - part)))."
defines_otherwise proofs/limbs/LimbNumbers.v "Z.lor (word (a * 2 ^ part)) (lower / 2 ^ (64 - part))." \
  "Z.lor (word (a * 2 ^ part)) (lower / 2 ^ (63 - part))."
defines_otherwise proofs/limbs/WideNumbers.v "if a =? 0 then S (lowest_limb rest) else O" "S (lowest_limb rest)"
defines_otherwise proofs/limbs/WideNumbers.v "(error_exponent small)) rounding +! 2)" "(error_exponent small)) rounding +! 1)"
defines_otherwise proofs/limbs/WideNumbers.v "Z.quot (1 -! binary_exponent a) 2" "Z.quot (0 -! binary_exponent a) 2"
defines_otherwise proofs/code/ThirdStages.v "number_of 12 * y * y - number_of 3" "number_of 12 * y * y * y - number_of 3"
defines_otherwise proofs/code/Code.v "third 32 Third.bump_2p R" "third 16 Third.bump_2p R"
refuses fast/numbers/big_float_ball.h "static_cast<std::uint64_t>(t >> 64) & 1" "static_cast<std::uint64_t>(t >> 63) & 1" "is not the code"
refuses proofs/limbs/WideRefined.v "- 2 ^ 63 <= t < 2 ^ 63 -> int64" "- 2 ^ 63 <= t <= 2 ^ 63 -> int64" "Error"
refuses proofs/code/ThirdStagesRefined.v "k < 2 ^ 31 -> limbs_hold k l a -> approximation" \
  "k <= 2 ^ 31 -> limbs_hold k l a -> approximation" "Error"
refuses proofs/limbs/LimbsAreDigits.v "(if dropped then Z.max (error a) (e - width) else error a)." \
  "(if dropped then Z.max (error a) (e - width - 1) else error a)." "Error"
refuses proofs/big_float/BigFloat.v "(Z.max (Z.max (error result) (error small)) rounding + 2)." \
  "(Z.max (Z.max (error result) (error small)) rounding + 1)." "Error"
refuses proofs/big_float/BigFloat.v "(if lost then Z.max (error a) (exponent a - width + 1) + 1 else error a)." \
  "(if lost then Z.max (error a) (exponent a - width) else error a)." "Error"
refuses proofs/big_float/BigFloat.v "(if product <? 2 ^ (2 * width - 1) then 1 else 0)%Z in" \
  "(if product <? 2 ^ (2 * width - 2) then 1 else 0)%Z in" "Error"
refuses proofs/big_float/BigFloat.v "Z.max (Z.max (exponent a + error b) (exponent b + error a)) (error a + error b)." \
  "Z.max (exponent a + error b) (error a + error b)." "Error"
refuses proofs/big_float/BigFloat.v "else error a - exponent b + 3)" "else error a - exponent b + 1)" "Error"
refuses proofs/big_float/BigFloat.v "(exponent a + error b - 2 * exponent b) + 4)%Z in" \
  "(exponent a + error b - 2 * exponent b) + 2)%Z in" "Error"
refuses proofs/big_float/BigFloat.v "(error a - exponent root + 2) + 1)." "(error a - exponent root) + 1)." "Error"
refuses proofs/big_float/BigFloatProducts.v "(error a < - s - 1)%Z" "(error a < - s)%Z" "Error"
refuses proofs/big_float/BigFloatQuotients.v "(error a < boundless)%Z ->" "True ->" "Error"
refuses proofs/big_float/BigFloatNarrow.v "(exponent a) (exponent b) - width + 1)) + 2)%Z." \
  "(exponent a) (exponent b) - width + 1)) + 1)%Z." "Error"
refuses proofs/big_float/BigFloatNarrow.v "inverse * value width inverse) <= 2) ->" "inverse * value width inverse) <= 4) ->" "Error"
refuses proofs/big_float/BigFloatNarrowQuotient.v "(width - 4 <= 2 * j)%Z" "(width - 5 <= 2 * j)%Z" "Error"
refuses proofs/big_float/BigFloatNewton.v "(width / 64 - (bits / 64 + 2))" "(width / 64 - (bits / 64 + 1))" "Error"
refuses proofs/big_float/BigFloatRight.v "(error a - exponent a + 4) (13 - width)" "(error a - exponent a + 3) (13 - width)" "Error"
refuses proofs/laws/Bump1pShaded.v "exactly 768 (opp (to64 z)) in" "exactly 768 (to64 z) in" "Error"
refuses proofs/geometry/TwoPolygonsThird.v "(-218) <= Rabs M) -> seen" "(-219) <= Rabs M) -> seen" "Error"
refuses proofs/stages/BigFloatDecide.v "(error a <= - s - 5)%Z." "(error a <= - s - 4)%Z." "Error"
refuses proofs/big_float/BigFloatBounded.v "(b - width + 1) + 2) (b + 1) (add" "(b - width + 1) + 1) (b + 1) (add" "Error"
refuses proofs/laws/Cylinder.v "(add 2048 (l_third R w z) (depth_third R w)))." "(l_third R w z))." "Error"
refuses proofs/laws/BumpCylinder.v "| _ => plane_outcome_third K z" "| _ => cylinder" "Error"
refuses proofs/sine_of_third/NewtonThirdStage.v "slope_of 7 50 (exactly width start) in" "slope_of 6 50 (exactly width start) in" "Error"
refuses proofs/sine_of_third/SineThirdStage.v "tight width 50000000 (60 - width) (sine_of_third_big" \
  "tight width 50000000 (56 - width) (sine_of_third_big" "Error"
refuses proofs/geometry/ThreePolygonsThird.v "m <= 926)%Z /\\ Rabs M <= bpow radix2 (17 - m) /\\ (M" \
  "m <= 924)%Z /\\ Rabs M <= bpow radix2 (17 - m) /\\ (M" "Error"
echo "$planted planted, $wrong not refused"
[ "$wrong" = 0 ]
