// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object of a contact inside a triangle goes for the hand's position as a plane through it would hold it that is turned
// to the interpolated normal (Ruspini, Kolarov and Khatib 1997; docs/god-object.md).

#include <optional>

#include "reference/meshes/contact/contact_rule.h"
#include "reference/meshes/schemes/vertex_scheme.h"

namespace forceshade::reference::meshes {

class SubGoal final : public ContactRule {
 public:
  SubGoal(const Ground& ground, mesh::CornerNormals normals);

  Descended move(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const override;

 private:
  // mm; none where it is the position itself.
  std::optional<std::array<float, 3>> goal(const mesh::GodObject& before, const std::array<float, 3>& position) const;

  const Ground ground_;
  const VertexScheme scheme_;
};

}  // namespace forceshade::reference::meshes
