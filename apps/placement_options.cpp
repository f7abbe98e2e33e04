// SPDX-License-Identifier: BSD-3-Clause
#include "apps/placement_options.h"

#include "apps/options.h"
#include "device/placement_text.h"

namespace forceshade::apps {

PlacementOptions::PlacementOptions(CLI::App& command) {
  command
      .add_option("--origin", origin_,
                  "the place of the law's or map's origin in the device's workspace: X,Y,Z in mm, or with units (mm, mil, "
                  "in, cm, m); default: 0,0,0")
      ->type_name("X,Y,Z")
      ->group(kPlaceGroup);
  command
      .add_option("--turn", turn_,
                  "the turn of the law or map there, about the device's axes and through its own origin: z90, or x-90,z180 "
                  "one after the other; multiples of 90 degrees")
      ->type_name("TURNS")
      ->group(kPlaceGroup);
}

device::Placement PlacementOptions::placement() const {
  return device::parse_placement(origin_, turn_);
}

}  // namespace forceshade::apps
