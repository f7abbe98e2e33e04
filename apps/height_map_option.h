// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --height-map SPEC, which stands for a law.

#include <string>

#include "apps/command.h"
#include "rendering/heights/spec.h"

namespace forceshade::apps {

// Throws BadInput with the file, the line of the number that is out of its domain, and the domain.
void expect_valid(const std::string& file, const heights::Spec& spec, float stiffness);

class HeightMapOption {
 public:
  // From then on the command takes either: --law, --radius and --width are refused beside it.
  HeightMapOption(CLI::App& command, LawOptions& law);

  bool is_given() const { return !file_.empty(); }

  // Display name; not part of the identity.
  std::string name() const;

  // With its folder.
  const std::string& file() const { return file_; }

  // What can be built, on both sides. Throws heights::Error or BadInput with file, line, value and what was expected.
  heights::Spec read(float stiffness) const;

 private:
  std::string file_;
};

}  // namespace forceshade::apps
