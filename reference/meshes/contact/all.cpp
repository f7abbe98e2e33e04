// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/contact/all.h"

#include <stdexcept>

#include "reference/meshes/contact/direct.h"
#include "reference/meshes/contact/friction.h"
#include "reference/meshes/contact/sub_goal.h"

namespace forceshade::reference::meshes {

std::unique_ptr<const ContactRule> contact_of(const MeshRendering& rendering, const Ground& ground) {
  switch (rendering.contact) {
    case mesh::Contact::direct: return std::make_unique<const Direct>(ground);
    case mesh::Contact::sub_goal: return std::make_unique<const SubGoal>(ground, rendering.normals);
    case mesh::Contact::friction: return std::make_unique<const Frictional>(ground);
  }
  throw std::logic_error("a contact rule that the exact side's list lacks");
}

}  // namespace forceshade::reference::meshes
