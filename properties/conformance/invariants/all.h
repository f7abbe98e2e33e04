// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The invariants of a renderer. Each opens what it needs, and throws files::ProcessFailed or Interrupted.

#include <array>

#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/invariants/trial.h"

namespace forceshade::conformance {

// repetition.cpp
Invariant same_path_twice(const Trial& trial);
Invariant reset_equals_fresh_start(const Trial& trial);
Invariant rest_is_still(const Trial& trial);

// odd_positions.cpp
Invariant any_position_gets_a_finite_force(const Trial& trial);
Invariant odd_position_leaves_nothing_behind(const Trial& trial);
Invariant no_position_no_force(const Trial& trial);

// contact.cpp
Invariant no_force_in_the_air(const Trial& trial);
Invariant contact_pushes_back(const Trial& trial);
Invariant first_force_opposes(const Trial& trial);
Invariant loops_give_no_energy(const Trial& trial);

// other_scenes.cpp
Invariant flat_however_triangulated(const Trial& trial);
Invariant no_jump_through_a_plate(const Trial& trial);
Invariant renumbered_scene(const Trial& trial);
Invariant turned_scene(const Trial& trial);
Invariant mirrored_scene(const Trial& trial);

// touching_faces.cpp
Invariant nothing_passes_where_faces_meet(const Trial& trial);
Invariant coinciding_faces_feel_like_one(const Trial& trial);
Invariant split_face_feels_like_the_whole(const Trial& trial);
Invariant meeting_faces_are_as_defined(const Trial& trial);

// damping.cpp: of renderers that declare damping.
Invariant leaving_does_not_pull(const Trial& trial);
Invariant landing_has_no_step(const Trial& trial);
Invariant rest_is_without_damping(const Trial& trial);
Invariant pause_leaves_no_speed(const Trial& trial);
Invariant missed_positions_are_even(const Trial& trial);
Invariant one_position_counts_by_share(const Trial& trial);

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
