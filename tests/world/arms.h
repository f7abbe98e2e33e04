// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The arms that sessions are run over: each a device of the product, and the scripted end of what it speaks to.

#include <string>
#include <vector>

#include "tests/world/searches.h"

namespace forceshade::world {

struct ArmKind {
  std::string name;
  Open open;
  Ns own_watchdog = 0;        // of the device; how long it holds a force that is not renewed
  std::vector<Fault> faults;  // of what the product speaks to, with the words that end the run
  Ns longest_force = Plan{}.longest_force;
  bool may_be_lost = false;
};

// Frames over a plain link; the vendor's library DHD; a program (docs/command-device.md), with a clock of its own where a
// period is given; Haply's service.
ArmKind framed_arm();
ArmKind dhd_arm();
ArmKind command_arm(Ns period = 0);
ArmKind haply_arm();
std::vector<ArmKind> arms();

// Faults that no arm can know of: the machine stands still, one of its threads does, the loop dies, the process dies.
std::vector<Fault> faults_of_the_machine();

// The options that the devices are opened with: nothing waits long for a calibration.
inline constexpr device::FramedOptions kOptions{.calibration = std::chrono::milliseconds(500)};

// The parts of a session in which faults are placed, each as short as it can be: the first forces, the hand in the wall, a jump
// of the arm that trips the supervisor, and the last frames.
struct Part {
  std::string name;
  Ns from;  // since the session's begin
  double seconds;
  std::vector<Event> events = {};
};
const std::vector<Part>& parts();

// A session that lasts for that part, over such an arm.
Plan plan_for(const Part& part, const ArmKind& arm);

}  // namespace forceshade::world
