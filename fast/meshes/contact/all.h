// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one list of the contact rules of this side, the usual one first.

#include "fast/meshes/contact/direct.h"
#include "fast/meshes/contact/friction.h"
#include "fast/meshes/contact/sub_goal.h"

namespace forceshade::fast {

template <class First, class... Rest>
struct ContactList {
  static constexpr std::size_t kCount = 1 + sizeof...(Rest);
  using Usual = First;  // its goal is the hand's position
  using Others = ContactList<Rest...>;
};
template <class First>
struct ContactList<First> {};
using ContactRules = ContactList<Direct, SubGoal, Frictional>;
static_assert(ContactRules::kCount == mesh::kContactNames.size() && ContactRules::Usual::kContact == mesh::kUsualContact);

// The rule that a rule is on this mesh: where nothing is rough, friction is the usual one.
inline mesh::Contact contact_in(const Mesh& mesh, mesh::Contact contact) noexcept {
  return contact == mesh::Contact::friction && !mesh.has_friction() ? mesh::kUsualContact : contact;
}

// Moves `at` by a rule of the list, from where its grid point is. p: the hand's position, mm, in the domain and quantised. The
// mesh has what the rule uses.
template <class Stages, class First, class... Others>
FORCESHADE_INLINE Goal move_by(mesh::Contact contact, const Mesh& mesh, Arrival& at, const std::array<float, 3>& p,
                               const Stages& stages, ContactList<First, Others...>) noexcept {
  if constexpr (sizeof...(Others) > 0)
    if (contact != First::kContact) return move_by(contact, mesh, at, p, stages, ContactList<Others...>());
  return First::move(mesh, at, p, stages);
}

}  // namespace forceshade::fast
