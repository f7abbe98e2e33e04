// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --subject FILE in a command line: the file stands for the options that it lists (docs/subjects.md), so it means what they
// mean and is refused as they are.

#include <map>
#include <string>
#include <vector>

namespace forceshade::apps {

// A command line whose --subject options were replaced by what their files say.
struct ExpandedLine {
  std::vector<std::string> words;
  std::map<std::string, std::string> places = {};  // "bump.toml: line 3: radius" by the option that stands there, "--radius"

  // The message, with the place in the file for an option of one that it begins with.
  std::string placed(const std::string& message) const;
};

// Throws Error as subjects::options_of_file() does, and where several files are named, or none.
ExpandedLine expand_subject_files(const std::vector<std::string>& words);

}  // namespace forceshade::apps
