// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --subject FILE: a TOML file whose keys are the options that name a law, height map or mesh and say how it is rendered,
// without their dashes (docs/subjects.md). The file stands for these options, so it means what they mean and is refused as they
// are.

#include <map>
#include <string>
#include <vector>

namespace forceshade::apps {

// A command line whose --subject options were replaced by what their files say.
struct ExpandedLine {
  std::vector<std::string> words;
  std::map<std::string, std::string> places = {};  // "bump.toml: line 3" by the option that stands there, such as "--radius"

  // The message, behind the place in the file where it begins with an option of one.
  std::string placed(const std::string& message) const;
};

// Files that a subject's file names lie beside it. Throws BadInput: a file that cannot be read or is no TOML, an unknown key, a
// value of a wrong type; with file, line and what was expected.
ExpandedLine expand_subject_files(const std::vector<std::string>& words);

// A subject file with these keys and values, in this order. A value is written as a text, but for "true".
std::string subject_file_text(const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace forceshade::apps
