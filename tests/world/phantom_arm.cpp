// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/phantom_arm.h"

#include <chrono>
#include <functional>

#include "tests/world/hd.h"

namespace forceshade::world {
namespace {

using std::chrono::milliseconds;

// Changes what the driver does from this step on.
Fault told(const char* name, const std::function<void(Orders&)>& change) {
  return {name, [change](World&, Arm&) {
            Orders orders = Hd::current().orders();
            change(orders);
            Hd::current().tell(orders);
          }};
}
Fault blocked(const char* name, Blocks where) {
  return told(name, [where](Orders& orders) { orders.blocks = where; });
}

}  // namespace

Fault endless_frame() {
  return blocked("hdEndFrame never returns", Blocks::end_frame);
}

std::vector<Fault> blocking_calls() {
  return {blocked("hdInitDevice never returns", Blocks::init_device),
          blocked("hdBeginFrame never returns", Blocks::begin_frame),
          endless_frame(),
          blocked("hdStartScheduler never returns", Blocks::start_scheduler),
          blocked("hdStopScheduler never returns", Blocks::stop_scheduler),
          blocked("hdDisableDevice never returns", Blocks::disable_device),
          told("no frame runs", [](Orders& orders) { orders.hung = true; })};
}

std::vector<Fault> errors_of_the_driver() {
  return {told("hdBeginFrame fails", [](Orders& orders) { orders.begin = hdapi::kCommunication; }),
          told("hdEndFrame fails", [](Orders& orders) { orders.end = {hdapi::kDeviceFault}; }),
          told("hdSetDoublev fails", [](Orders& orders) { orders.set = hdapi::kForceError; }),
          told("the position is withheld", [](Orders& orders) { orders.withholds_position = true; }),
          told("the connection is lost, and an error says so", [](Orders& orders) { orders.comm_lost = true; }),
          told("the output goes off", [](Orders& orders) { orders.output_goes_off = true; }),
          told("frames take 10 ms", [](Orders& orders) { orders.frame_time = milliseconds(10); }),
          told("frames take 60 ms", [](Orders& orders) { orders.frame_time = milliseconds(60); })};
}

Fault crash_of_the_driver() {
  return {"the driver's process crashes", [](World& world, Arm&) {
            if (world.process() == kDriver) world.crash();
          }};
}

Fault stop_of_the_driver() {
  return {"the driver's process is stopped", [](World& world, Arm&) { world.stop_process(kDriver); }};
}

std::vector<Fault> losses_of_the_driver() {
  return {{"the driver's process is killed", [](World& world, Arm&) { world.kill_process(kDriver); }},
          {"the driver's own thread goes no further", [](World& world, Arm&) { world.kill(kScheduler); }}};
}

ArmKind phantom_arm() {
  ArmKind kind{"phantom", kImpatient, 0, errors_of_the_driver()};
  for (const auto& more : {blocking_calls(), {crash_of_the_driver(), stop_of_the_driver()}, losses_of_the_driver()})
    kind.faults.insert(kind.faults.end(), more.begin(), more.end());
  kind.longest_force = 4 * system::kSecond;  // until a process is killed that does not end
  kind.may_be_lost = true;
  return kind;
}

}  // namespace forceshade::world
