// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/object_door.h"

#include <unistd.h>

#include <filesystem>

#include "files/shell.h"
#include "properties/conformance/doors/process_door.h"

namespace forceshade::conformance {

OpenRenderer object_door(const std::string& file, const files::ProcessLimits& limits) {
  // This very program, also where its file was replaced since. A name without a slash would be looked for among the system's
  // libraries.
  const std::string program = "/proc/" + std::to_string(::getpid()) + "/exe";
  files::ProcessLimits its = limits;
  its.ended_well = kObjectEndedWell;
  return process_door("exec " + program + ' ' + kRenderObject + ' ' + files::quoted_for_shell(std::filesystem::absolute(file)),
                      its, std::string(kAllocations));
}

}  // namespace forceshade::conformance
