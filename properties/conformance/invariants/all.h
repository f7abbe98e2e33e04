// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The invariants of a renderer. Each opens what it needs, and throws files::ProcessFailed or Interrupted.

#include <array>

#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/invariants/trial.h"

namespace forceshade::conformance {

using InvariantOf = Invariant(const Trial& trial);

InvariantOf same_path_twice, reset_equals_fresh_start, rest_is_still;                                    // repetition.cpp
InvariantOf any_position_gets_a_finite_force, odd_position_leaves_nothing_behind, no_position_no_force;  // odd_positions.cpp
InvariantOf no_force_in_the_air, contact_pushes_back, first_force_opposes, loops_give_no_energy;         // contact.cpp
// other_scenes.cpp
InvariantOf flat_however_triangulated, no_jump_through_a_plate, renumbered_scene, turned_scene, mirrored_scene;
// touching_faces.cpp
InvariantOf nothing_passes_where_faces_meet, coinciding_faces_feel_like_one, split_face_feels_like_the_whole,
    meeting_faces_are_as_defined;
// damping.cpp: of renderers that declare damping.
InvariantOf leaving_does_not_pull, landing_has_no_step, rest_is_without_damping, pause_leaves_no_speed,
    missed_positions_are_even, one_position_counts_by_share;

inline constexpr std::array kInvariants{&same_path_twice,
                                        &reset_equals_fresh_start,
                                        &rest_is_still,
                                        &any_position_gets_a_finite_force,
                                        &odd_position_leaves_nothing_behind,
                                        &no_position_no_force,
                                        &no_force_in_the_air,
                                        &contact_pushes_back,
                                        &first_force_opposes,
                                        &loops_give_no_energy,
                                        &flat_however_triangulated,
                                        &no_jump_through_a_plate,
                                        &renumbered_scene,
                                        &turned_scene,
                                        &mirrored_scene,
                                        &nothing_passes_where_faces_meet,
                                        &coinciding_faces_feel_like_one,
                                        &split_face_feels_like_the_whole,
                                        &meeting_faces_are_as_defined};
inline constexpr std::array kDampingInvariants{&leaving_does_not_pull,     &landing_has_no_step,
                                               &rest_is_without_damping,   &pause_leaves_no_speed,
                                               &missed_positions_are_even, &one_position_counts_by_share};

}  // namespace forceshade::conformance
