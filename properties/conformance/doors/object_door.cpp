// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/object_door.h"

#include <unistd.h>

#include <filesystem>

#include "properties/conformance/doors/process_door.h"

namespace forceshade::conformance {
namespace {

std::string quoted_for_shell(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
  return quoted + '\'';
}

}  // namespace

OpenRenderer object_door(const std::string& file, const ProcessLimits& limits) {
  // This very program, also where its file was replaced since. A name without a slash would be looked for among the system's
  // libraries.
  const std::string program = "/proc/" + std::to_string(::getpid()) + "/exe";
  return process_door("exec " + program + ' ' + kRenderObject + ' ' + quoted_for_shell(std::filesystem::absolute(file)),
                      limits);
}

}  // namespace forceshade::conformance
