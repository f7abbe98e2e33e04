(* SPDX-License-Identifier: BSD-3-Clause *)
(* The theorems that docs/proofs.md claims, all in one list, and what they assume together. scripts/proofs reads what this file prints. *)
From Coq Require Import List.
From Forceshade Require Import RoundingTest Evaluate Inputs Wall Shaded Gap Polygons ThreePolygons ErrorFree Acceptance.
From Forceshade Require Import CylinderForce CylinderFirst CylinderOutside CylinderAnswers DoubleDouble Depth Split.
From Forceshade Require Import CylinderConstants DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants.
From Forceshade Require Import ThreePolygonsFace ThreePolygonsConstants NewtonStart NewtonRounded.
From Forceshade Require Import DoubleDoubleTerms DoubleDoubleOff NewtonThird NewtonRest SineOfThird ExactSign TopEdge ThreePolygonsRight.
From Forceshade Require Import Separation SeparationOfCylinder SeparationOfBump2pShaded SeparationOfBump2p.
From Forceshade Require Import SeparationOfCubic SeparationOfBump3p SeparationOfBump3pShaded SeparationOfContact.
From Forceshade Require Import Enclosures EnclosedProducts EnclosedQuotients BesideTie SumOfTwo EnclosedSums SecondStage SecondAlong.
From Forceshade Require Import Bump1pShaded.
From Forceshade Require Import TwoPolygonsGap Bump2p ShadedAlong Bump2pShaded ThreePolygonsEnclosed.
From Forceshade Require Import NewtonEnclosed SineEnclosed ThreePolygonsGap Bump3p Bump3pShaded.
From Forceshade Require Import Contained CylinderNearness CylinderSecondParts CylinderSecondBorder CylinderSecondForce CylinderSecond.
From Forceshade Require Import BumpCylinder.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow
  BigFloatNarrowQuotient.
From Forceshade Require Import BigFloatNarrowRoot BigFloatNewton BigFloatNewtonLoop BigFloatRight BigFloatTight BigFloatSearch
  BigFloatDecide.
From Forceshade Require Import ThirdAlong TwoPolygonsThird.
From Forceshade Require Import BigFloatBounded Cylinder.
From Forceshade Require Import Limbs LimbShifts LimbNumbers LimbsAreDigits WideRefined WideSums WideNewton ThirdStagesRefined.
From Forceshade Require Import MeshBounds MeshBoundsMoves MeshBoundsShaded MeshBoundsPulled MeshDecisions MeshConsequences Intervals.
From Forceshade Require Import Damping Placement.
From Forceshade Require Import MeshConstants MeshSigns MeshSide SoupNumbers SoupProducts SoupSigns.
From Forceshade Require Import NewtonThirdStage SineThirdStage ThreePolygonsThird.
From Forceshade Require Import BumpLanes PolygonLanes ThreePolygonLanes WalkRight CylinderLaneV CylinderLaneRough CylinderLaneRoughForm
  CylinderLaneStep CylinderLaneScale CylinderLanes.
From Forceshade Require Import Work Conservative EdgeLoops EdgeLoopsExist Strokes StrokesExist.
From Forceshade Require Import Main RecordedParts RecordedLaws.
Import ListNotations.
Arguments third_nearest_is_recorded : clear implicits. Arguments third_sine_is_recorded : clear implicits.
Arguments members_are_recorded : clear implicits. Arguments laws_are_recorded : clear implicits.
Arguments planes_are_recorded : clear implicits.

Inductive claim : Prop := claimed (P : Prop) (_ : P).
Arguments claimed {P} _.

Definition claims : list claim := [
  claimed wall_is_correctly_rounded; claimed cylinder_is_correctly_rounded; claimed bump_cylinder_is_correctly_rounded;
  claimed bump_1p_is_correctly_rounded; claimed bump_2p_is_correctly_rounded; claimed bump_3p_is_correctly_rounded;
  claimed bump_1p_shaded_is_correctly_rounded; claimed bump_2p_shaded_is_correctly_rounded; claimed bump_3p_shaded_is_correctly_rounded;
  claimed wall_batches_agree; claimed cylinder_batches_agree; claimed bump_cylinder_batches_agree;
  claimed bump_1p_batches_agree; claimed bump_2p_batches_agree; claimed bump_3p_batches_agree;
  claimed bump_1p_shaded_batches_agree; claimed bump_2p_shaded_batches_agree; claimed bump_3p_shaded_batches_agree;
  claimed wall_lane_is_right; claimed bump_1p_lane_is_right;
  claimed bump_1p_shaded_lane_is_right; claimed bump_2p_lane_is_right; claimed bump_2p_shaded_lane_is_right;
  claimed bump_3p_lane_is_right; claimed bump_3p_shaded_lane_is_right; claimed gap_form_is_near; claimed top_height_at;
  claimed v_form_is_near; claimed rough_t_is; claimed rough_form_is; claimed step_is; claimed scale_form_is;
  claimed cylinder_lane_is_right; claimed bump_cylinder_lane_is_right;
  claimed rounding_test_is_sound; claimed first_stage_returns_the_nearest; claimed right_first_stage_gives_right_answers;
  claimed product_is_exact; claimed wall_answers_right; claimed bump_1p_shaded_first_stage_answers_right; claimed gap_is_near;
  claimed bump_2p_first_stage_answers_right; claimed bump_2p_shaded_first_stage_answers_right; claimed bump_3p_first_stage_answers_right;
  claimed bump_3p_shaded_first_stage_answers_right; claimed cylinder_v_is_near; claimed cylinder_l_is_near;
  claimed cylinder_force_is_near; claimed cylinder_v_is_not_positive; claimed cylinder_first_stage_answers_right;
  claimed bump_cylinder_first_stage_answers_right; claimed sum_of_exact; claimed product_of_exact; claimed root_of_both;
  claimed computed_depth_is; claimed split_head_is; claimed split_is; claimed cylinder_constants_are_right;
  claimed cylinder_first_stage_answers_right_for_all; claimed bump_cylinder_first_stage_answers_right_for_all; claimed sum_of_is_near;
  claimed product_of_is_near; claimed quotient_of_is_near; claimed holds_multiply; claimed holds_divide; claimed holds_root;
  claimed holds_add; claimed holds_subtract; claimed linear_2p_is_right; claimed constants_2p_are_right;
  claimed bump_2p_first_stage_answers_right_for_all; claimed bump_2p_shaded_first_stage_answers_right_for_all; claimed third_sine_is;
  claimed is_on_top_is_right; claimed top_is_decided; claimed shape_3p_is_right; claimed factors_3p_are_right;
  claimed bump_3p_first_stage_answers_right_given_t; claimed bump_3p_shaded_first_stage_answers_right_given_t;
  claimed newton_for_third_starts; claimed newton_for_third_converges; claimed newton_for_rest_starts; claimed newton_for_rest_converges;
  claimed third_step_is; claimed rest_step_is; claimed third_start_is; claimed rest_start_is; claimed sum_of_is_off;
  claimed product_of_is_off; claimed quotient_of_is_off; claimed third_step_in_double_double; claimed rest_step_in_double_double;
  claimed sine_of_third_is; claimed exact_sign_is; claimed is_on_top32_is; claimed largest_on_top_is_right; claimed top_is_right;
  claimed bump_3p_first_stage_answers_right_for_all; claimed bump_3p_shaded_first_stage_answers_right_for_all; claimed two_sum_is_exact;
  claimed fast_two_sum_is_exact; claimed two_product_is_exact; claimed accepted_candidate_is_nearest; claimed separation_of_degree_2;
  claimed separation_of_degree_4; claimed bump_1p_shaded_is_separated; claimed cylinder_is_separated; claimed bump_cylinder_is_separated;
  claimed bump_2p_shaded_is_separated; claimed bump_2p_is_separated; claimed separation_of_degree_3; claimed separation_of_degree_6;
  claimed separation_of_degree_12; claimed bump_3p_is_separated; claimed bump_3p_shaded_is_separated;
  claimed cylinder_contact_is_separated; claimed bump_2p_contact_is_separated; claimed bump_3p_contact_is_separated; claimed encloses_sum;
  claimed multiply_encloses; claimed encloses_multiply; claimed encloses_divide; claimed encloses_root; claimed sign_is_right;
  claimed sum_contains; claimed difference_of_two_contains; claimed encloses_add; claimed difference_contains;
  claimed rounded_to_binary32_is_nearest; claimed decided_is_right; claimed along_is_right; claimed on_plane_is_right;
  claimed bump_1p_shaded_second_stage_answers_right; claimed bump_1p_shaded_two_stages_answer_right; claimed difference_is_settled;
  claimed settled_positive; claimed quotient_of_settled; claimed along_shaded_is_right; claimed bump_2p_second_stage_answers_right;
  claimed bump_2p_two_stages_answer_right; claimed bump_2p_shaded_second_stage_answers_right;
  claimed bump_2p_shaded_two_stages_answer_right; claimed encloses_subtract; claimed face_3p_enclosed; claimed sum_within;
  claimed divide_within; claimed newton_root_encloses; claimed sine_of_third_encloses; claimed side_gap_is_settled;
  claimed shape_enclosed; claimed gap_3p_is_settled; claimed bump_3p_second_stage_answers_right; claimed bump_3p_two_stages_answer_right;
  claimed bump_3p_shaded_second_stage_answers_right; claimed bump_3p_shaded_two_stages_answer_right; claimed divide_encloses;
  claimed sum_of_contained; claimed rounded_from_contained_is_nearest; claimed decided_outcome_is_right; claimed beside_a_root;
  claimed l_is_near; claimed m_is_near; claimed second_v_is; claimed rho_enclosed; claimed scale_enclosed; claimed cylinder_outcome_is;
  claimed cylinder_second_stage_answers_right; claimed cylinder_two_stages_answer_right; claimed bump_cylinder_second_stage_answers_right;
  claimed bump_cylinder_two_stages_answer_right; claimed big_negated_contains; claimed big_scaled_contains; claimed big_midpoint_contains;
  claimed big_widened_contains; claimed limbs_add; claimed limbs_subtract; claimed limbs_multiply; claimed limbs_shift_right;
  claimed limbs_added; claimed limbs_normalised; claimed limbs_compare; claimed highest_limb; claimed limbs_cut; claimed one_limb;
  claimed more_limbs; claimed fewer_limbs; claimed limbs_of_product; claimed is_zero_in_limbs; claimed is_larger_in_limbs;
  claimed shift_in_limbs; claimed add_in_limbs; claimed subtract_in_limbs; claimed multiply_in_limbs; claimed exactly_holds;
  claimed truncated_holds; claimed wide_sign_is; claimed approximately_holds; claimed add_holds; claimed multiply_holds;
  claimed divide_holds; claimed root_holds; claimed cylinder_in_limbs; claimed bump_cylinder_in_limbs; claimed bump_2p_in_limbs;
  claimed bump_3p_in_limbs; claimed bump_1p_shaded_in_limbs; claimed bump_2p_shaded_in_limbs; claimed bump_3p_shaded_in_limbs;
  claimed big_exactly_contains;
  claimed big_converted_contains; claimed big_sum_contains; claimed big_difference_contains; claimed big_product_contains;
  claimed big_quotient_contains; claimed big_root_contains; claimed big_root_contains_for; claimed big_sum_is_narrow;
  claimed big_product_is_narrow; claimed big_quotient_is_narrow; claimed big_sign_is_right; claimed big_proved_sign_is_right;
  claimed big_root_is_narrow; claimed newton_inverse_is_good; claimed newton_inverse_root_is_good; claimed loop_ends;
  claimed big_quotient_is_right; claimed big_root_is_right; claimed tight_multiply; claimed tight_divide; claimed tight_root;
  claimed tight_sum; claimed search_ends; claimed rounded_big_is_nearest; claimed decided_big_is_right; claimed along_big_is_right;
  claimed shading_root_tight; claimed bump_1p_shaded_third_stage_answers_right; claimed bump_1p_shaded_answers_right; claimed face_third;
  claimed side_gap_third_is; claimed bump_2p_third_stage_answers_right; claimed bump_2p_answers_right;
  claimed bump_2p_shaded_third_stage_answers_right; claimed bump_2p_shaded_answers_right; claimed rounded_fine_is_nearest;
  claimed decided_fine_is_right; claimed bounded_add; claimed bounded_multiply; claimed bounded_is_tight; claimed scale_tight;
  claimed cylinder_outcome_third_is; claimed cylinder_third_stage_answers_right; claimed cylinder_answers_right;
  claimed bump_cylinder_third_stage_answers_right; claimed bump_cylinder_answers_right; claimed newton_root_is_tight;
  claimed sine_of_third_is_tight; claimed shape_third; claimed gap_3p_third_is; claimed bump_3p_third_stage_answers_right;
  claimed bump_3p_answers_right; claimed bump_3p_shaded_third_stage_answers_right; claimed bump_3p_shaded_answers_right;
  claimed distance_in_cube; claimed area_in_cube; claimed volume_in_cube; claimed grid_of_triangle_is_gridded; claimed side_of_plane_fits;
  claimed along_edge_fits; claimed along_edge_from_grid_fits; claimed inside_fits; claimed inside_from_grid_fits; claimed two_edges_fit;
  claimed edge_and_triangle_fit; claimed two_triangles_fit; claimed on_edge_fits; claimed plane_from_grid_fits;
  claimed way_across_plane_fits; claimed passes_edge_fits; claimed two_crossings_fit; claimed crossed_edge_fits;
  claimed crossed_triangle_fits; claimed distance_fits; claimed foot_on_edge_fits; claimed foot_in_triangle_fits;
  claimed beside_a_sheet_fits; claimed foot_on_a_sheet_fits; claimed two_crossings_in_a_plane_fit; claimed part_of_a_way_fits;
  claimed from_landing_fits; claimed from_landing_in_a_plane_fits; claimed sub_goal_fits; claimed binary32_is_multiple;
  claimed textured_normal_fits; claimed textured_on_crease_fits; claimed square_of_textured_force_fits; claimed share_or_border_fits;
  claimed sticking_in_a_triangle_fits; claimed sticking_along_an_edge_fits; claimed share_in_a_triangle_fits;
  claimed share_along_an_edge_fits; claimed keeping_the_bit_fits; claimed pulled_force_in_triangle_fits;
  claimed pulled_force_along_edge_fits; claimed parameters_of_foot; claimed foot_is_inside; claimed parameter_of_foot_on_edge;
  claimed distance_off_plane; claimed no_direction_in_a_plane_is_nearer; claimed the_projection_is_nearest;
  claimed signed_squares_are_in_order; claimed two_edges_in_order; claimed edge_and_triangle_in_order; claimed two_triangles_in_order;
  claimed on_plane; claimed on_line; claimed parameters_of_projection; claimed crossing_of_a_plane; claimed parameters_of_crossing;
  claimed force_is_compared_by_squares; claimed sticking_in_a_triangle; claimed sticking_along_an_edge; claimed share_in_a_triangle;
  claimed share_along_an_edge; claimed keeping_the_bit; claimed energy_of_a_tick; claimed energy_of_a_turn; claimed interpolated_turn;
  claimed one_corner_is_near; claimed refused_move_is_short; claimed never_against_the_slip; claimed refused_slide_is_short;
  claimed sub_goal_is_near; claimed placed_is_rotation; claimed placement_keeps_power; claimed turned_back;
  claimed placed_force_is_nearest; claimed position_is_rounded_once; claimed unshifted_position_is_exact;
  claimed polynomial_is_near; claimed constants_are_above; claimed side_of_is_right;
  claimed exactly_contains; claimed negated_contains; claimed add_contains; claimed subtract_contains; claimed multiply_contains;
  claimed difference_of_products_contains; claimed dot_contains; claimed sure_is_right; claimed sign_of_is_right;
  claimed sign_of_determinant_is_right; claimed side_of_plane_is_right;
  claimed closed_path_gives_nothing; claimed wall_is_conservative; claimed cylinder_is_conservative;
  claimed bump_cylinder_is_conservative; claimed bump_1p_is_conservative; claimed bump_2p_loop_gives_at_most;
  claimed bump_3p_loop_gives_at_most; claimed bump_2p_loop_gives_all; claimed bump_3p_loop_gives_all;
  claimed bump_1p_shaded_stroke_gives; claimed bump_2p_shaded_stroke_gives; claimed bump_3p_shaded_stroke_gives;
  claimed bump_1p_shaded_stroke_exists; claimed bump_2p_shaded_stroke_exists; claimed bump_3p_shaded_stroke_exists;
  claimed damper_dissipates; claimed sampling_gives_at_most; claimed side_of_plane_changes_by;
  claimed passes_edge_changes_by; claimed product_is_off_by; claimed quotient_is_off_by; claimed root_is_off_by; claimed sum_is_recorded;
  claimed difference_is_recorded; claimed product_is_recorded; claimed quotient_is_recorded; claimed root_is_recorded;
  claimed sign_is_recorded; claimed rest_is_recorded; claimed domain_is_recorded; claimed operations_are_recorded;
  claimed doubt_is_recorded; claimed exact_sign_is_recorded; claimed on_top_is_recorded; claimed largest_on_top_is_recorded;
  claimed second_nearest_is_recorded;
  claimed third_nearest_is_recorded; claimed second_sine_is_recorded; claimed third_sine_is_recorded; claimed members_are_recorded;
  claimed laws_are_recorded; claimed planes_are_recorded].
Print Assumptions claims.
