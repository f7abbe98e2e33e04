// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines of JSON with a child process: those that docs/conformance-protocol.md has for renderers and for simulators.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "files/child_process.h"

namespace forceshade::conformance {

// All of it throws files::ProcessFailed; then no further call is of use.
class Dialogue {
 public:
  // whose: "renderer", for messages; it has to outlive this.
  Dialogue(const std::string& command, const files::ProcessLimits& limits, const char* whose);

  // The hello on this scene, in this version of the protocol.
  nlohmann::ordered_json open(const nlohmann::ordered_json& scene);

  std::string say(const std::string& line);             // the line that answers it
  nlohmann::ordered_json ask(const std::string& line);  // the object in it
  void say_goodbye();

 private:
  const char* whose_;
  files::ChildProcess process_;
};

// The list behind the key of an answer of a renderer or simulator, with an entry for each of what was requested: "positions".
// whose: "renderer", for messages. Throws files::ProcessFailed.
const nlohmann::ordered_json& list_in(const nlohmann::ordered_json& answer, const char* key, std::size_t size,
                                      const char* asked, const char* whose);

}  // namespace forceshade::conformance
