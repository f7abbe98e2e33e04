// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The window of drive: the surface in section, the tip that it pushes back, and the force; the mouse steers the hand.

#include <atomic>
#include <string>
#include <vector>

#include "apps/surface_cut.h"
#include "device/simulated/steering.h"
#include "forceshade/placement.h"
#include "forceshade/run.h"
#include "window/canvas.h"

namespace forceshade::apps {

class DriveWindow {
 public:
  // Opens the window; throws Error. What is given by reference lives longer. certified: words about the certificate.
  DriveWindow(const Description& what, SurfaceCut& cut, const device::Placement& placement, device::Steering& steering,
              const std::string& certified);

  // run::run() in a thread of its own, with the window in this one, until the run is over, the window was closed, Escape or S
  // was typed, or `asked` is set. Throws what run::run() does.
  run::Outcome run(device::Device& device, const Rendering& what, run::Plan plan, const std::atomic<bool>& asked);

 private:
  // One frame. False when the person has ended the run.
  bool show(const std::optional<device::Sample>& latest, const mesh::GodObject& god_object);

  const Description& what_;
  SurfaceCut& cut_;
  const device::Placement placement_;
  device::Steering& steering_;
  double y_;  // mm, of the plane in which the mouse moves the hand
  window::SectionScene scene_;
  window::Canvas canvas_;
};

}  // namespace forceshade::apps
