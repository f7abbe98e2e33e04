// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A god-object on a mesh as a subject.

#include <mutex>
#include <optional>

#include "forceshade/fast.h"
#include "forceshade/identity.h"
#include "forceshade/properties.h"
#include "forceshade/reference.h"
#include "properties/kind_of_library.h"

namespace forceshade::properties {

// The god-object of the fast path. Throws std::invalid_argument for what is no surface.
OpenTicks fast_god_object(const MeshRendering& rendering);

class MeshSubject final : public KindOfLibrary {
 public:
  // name: of its file. The mesh has been checked (include/forceshade/meshes.h). Throws std::invalid_argument where a side
  // refuses it.
  MeshSubject(const std::string& name, const MeshRendering& rendering)
      : MeshSubject(name, rendering, fast_god_object(rendering), true) {}
  // Any renderer of it.
  MeshSubject(const std::string& name, MeshRendering rendering, OpenTicks open, bool is_rendered_by_library = false);

  const Rendering& rendering() const override { return rendering_; }
  std::vector<std::string> parts() const override;
  std::unique_ptr<ReferenceSession> open_reference() const override;
  std::unique_ptr<Positions> positions(std::uint64_t seed) const override;
  std::vector<Eigen::Vector3f> draw_path(Chooser& choose) const override;
  // properties/mesh_properties.h says what each of them is on a mesh.
  Violation check_continuity(Chooser& choose) const override;
  Violation check_unit_normals(Chooser& choose) const override;
  Violation check_passivity(Chooser& choose) const override;
  // "states": the renderer's state, status, moves and force are the definition's, tick by tick, also with a path that goes on
  // from a state of it. "repeats": a position that is repeated changes neither state nor force once the tick is finished.
  std::vector<FurtherProperty> further_properties() const override;
  Expected expected() const override;
  // No bound is known.
  std::vector<LoopEnergy> energies(const Monitor&) const override { return {}; }
  DrawnSubject with_drawn_parameters(std::uint64_t seed) const override;
  std::uint64_t points_of_a_set(std::uint64_t points) const override { return (points + 7) / 8; }

 private:
  std::shared_ptr<const MeshRendering> mesh_;  // of all stiffnesses but its own
  float stiffness_;
  OpenTicks open_;
  Rendering rendering_;
  // Built when it is first needed: it takes some 2 kB for each triangle, and a servo loop needs none.
  const reference::GodObject& reference() const;
  mutable std::once_flag is_built_;
  mutable std::optional<reference::GodObject> reference_;
};

}  // namespace forceshade::properties
