(* SPDX-License-Identifier: BSD-3-Clause *)
(* The theorems that docs/proofs.md claims, and what each assumes. scripts/proofs reads what this file prints. *)
From Forceshade Require Import RoundingTest Evaluate Inputs Wall Shaded Gap Polygons ThreePolygons ErrorFree Acceptance.
From Forceshade Require Import CylinderForce Cylinder CylinderOutside CylinderAnswers DoubleDouble Depth Split.
From Forceshade Require Import CylinderConstants DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants.
From Forceshade Require Import ThreePolygonsFace ThreePolygonsConstants NewtonStart NewtonRounded.
From Forceshade Require Import DoubleDoubleTerms NewtonThird NewtonRest SineOfThird ExactSign TopEdge ThreePolygonsRight.

Print Assumptions rounding_test_is_sound.
Print Assumptions first_stage_returns_the_nearest.
Print Assumptions right_first_stage_gives_right_answers.
Print Assumptions product_is_exact.
Print Assumptions wall_is_correctly_rounded.
Print Assumptions bump_1p_shaded_first_stage_answers_right.
Print Assumptions gap_is_near.
Print Assumptions bump_2p_first_stage_answers_right.
Print Assumptions bump_2p_shaded_first_stage_answers_right.
Print Assumptions bump_3p_first_stage_answers_right.
Print Assumptions bump_3p_shaded_first_stage_answers_right.
Print Assumptions cylinder_v_is_near.
Print Assumptions cylinder_l_is_near.
Print Assumptions cylinder_force_is_near.
Print Assumptions cylinder_v_is_not_positive.
Print Assumptions cylinder_first_stage_answers_right.
Print Assumptions bump_cylinder_first_stage_answers_right.
Print Assumptions sum_of_exact.
Print Assumptions product_of_exact.
Print Assumptions root_of_both.
Print Assumptions computed_depth_is.
Print Assumptions split_head_is.
Print Assumptions split_is.
Print Assumptions cylinder_constants_are_right.
Print Assumptions cylinder_first_stage_answers_right_for_all.
Print Assumptions bump_cylinder_first_stage_answers_right_for_all.
Print Assumptions sum_of_is_near.
Print Assumptions product_of_is_near.
Print Assumptions quotient_of_is_near.
Print Assumptions holds_multiply.
Print Assumptions holds_divide.
Print Assumptions holds_root.
Print Assumptions holds_add.
Print Assumptions holds_subtract.
Print Assumptions linear_2p_is_right.
Print Assumptions constants_2p_are_right.
Print Assumptions bump_2p_first_stage_answers_right_for_all.
Print Assumptions bump_2p_shaded_first_stage_answers_right_for_all.
Print Assumptions third_sine_is.
Print Assumptions is_on_top_is_right.
Print Assumptions top_is_decided.
Print Assumptions shape_3p_is_right.
Print Assumptions factors_3p_are_right.
Print Assumptions bump_3p_first_stage_answers_right_given_t.
Print Assumptions bump_3p_shaded_first_stage_answers_right_given_t.
Print Assumptions newton_for_third_starts.
Print Assumptions newton_for_third_converges.
Print Assumptions newton_for_rest_starts.
Print Assumptions newton_for_rest_converges.
Print Assumptions third_step_is.
Print Assumptions rest_step_is.
Print Assumptions third_start_is.
Print Assumptions rest_start_is.
Print Assumptions sum_of_is_off.
Print Assumptions product_of_is_off.
Print Assumptions quotient_of_is_off.
Print Assumptions third_step_in_double_double.
Print Assumptions rest_step_in_double_double.
Print Assumptions sine_of_third_is.
Print Assumptions exact_sign_is.
Print Assumptions is_on_top32_is.
Print Assumptions largest_on_top_is_right.
Print Assumptions top_is_right.
Print Assumptions bump_3p_first_stage_answers_right_for_all.
Print Assumptions bump_3p_shaded_first_stage_answers_right_for_all.
Print Assumptions two_sum_is_exact.
Print Assumptions fast_two_sum_is_exact.
Print Assumptions two_product_is_exact.
Print Assumptions accepted_candidate_is_nearest.
