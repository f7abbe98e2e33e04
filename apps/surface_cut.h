// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The subject cut by a plane y = constant, for the window of drive: for the eye alone. Lengths in mm.

#include <memory>
#include <optional>

#include "forceshade/description.h"
#include "forceshade/renderer.h"
#include "window/section.h"

namespace forceshade::apps {

class SurfaceCut {
 public:
  // The description lives longer.
  SurfaceCut(const Description& what, const Rendering& rendering);

  // The part that is shown, 1.9 times as wide as it is high; its middle is also where a mesh has its middle along y.
  const window::Region& region() const { return region_; }
  double middle_y() const { return middle_y_; }

  // Kept, and given again while y moves by less than kKept.
  const window::Section& at(double y);

 private:
  static constexpr double kKept = 0.02;

  const mesh::TriangleMesh* mesh_ = nullptr;  // of a mesh; otherwise:
  std::unique_ptr<fast::Session> session_;
  bool has_felt_shape_ = true;  // its force follows from the position alone
  window::Region region_;
  double middle_y_ = 0, y_ = 0;
  std::optional<window::Section> section_;
};

// The place of a god-object that touches the mesh, by its state; nothing where it is free.
std::optional<window::Position> place_on(const mesh::TriangleMesh& mesh, const mesh::GodObject& state);

}  // namespace forceshade::apps
