// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one list of the contact rules of this side.

#include <memory>

#include "reference/meshes/contact/contact_rule.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::reference::meshes {

// That of a rendering in which first_error() finds nothing. ground: of its mesh.
std::unique_ptr<const ContactRule> contact_of(const MeshRendering& rendering, const Ground& ground);

}  // namespace forceshade::reference::meshes
