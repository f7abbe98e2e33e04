// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Results of checks for continuous integration: the XML that JUnit's Ant task began and that Jenkins and GitLab read.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace forceshade::apps {

struct JunitCase {
  std::string subject;  // law or height map: the suite
  std::string name;     // of the check
  double seconds = 0;
  std::optional<std::string> failure = {};  // the failure in words; nothing if it held
  std::string output = {};                  // further text to show
};

// Cases of one subject stand beside each other. `about` stands in every suite as its properties. Any text is allowed: what
// XML 1.0 cannot hold (control characters, what is no UTF-8, U+FFFE and U+FFFF) is written as \xNN.
std::string to_junit(const std::string& name, const std::vector<std::pair<std::string, std::string>>& about,
                     const std::vector<JunitCase>& cases);

}  // namespace forceshade::apps
