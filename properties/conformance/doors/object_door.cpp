// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/object_door.h"

#include <filesystem>

#include "files/shell.h"
#include "forceshade/error.h"
#include "properties/conformance/doors/process_door.h"

namespace forceshade::conformance {

OpenRenderer object_door(const std::string& file, const files::ProcessLimits& limits) {
  namespace fs = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / kObjectProgram;
  if (!fs::exists(program)) throw Error("--command: expected the program " + program.string() + ", which is not there");
  files::ProcessLimits its = limits;
  its.ended_well = kObjectEndedWell;
  // A name without a slash would be looked for among the system's libraries.
  return process_door("exec " + files::quoted_for_shell(program) + ' ' + files::quoted_for_shell(fs::absolute(file)), its,
                      std::string(kAllocations));
}

}  // namespace forceshade::conformance
