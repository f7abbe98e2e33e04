// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --subject FILE in a command line: the file stands for the options that it lists (docs/subjects.md), so it means what they
// mean and is refused as they are.

#include <map>
#include <string>
#include <vector>

namespace forceshade::apps {

// Behind the name of a file, for a command that gives the forces of the spring.
inline constexpr const char* kDampingLeftOut = ": its damping is left out here: this command is about the force without it";

// A command line whose --subject options were replaced by what their files say.
struct ExpandedLine {
  std::vector<std::string> words;
  std::map<std::string, std::string> places = {};  // "bump.toml: line 3: radius" by the option that stands there, "--radius"

  // The message, with the place in the file for an option of one that it begins with.
  std::string placed(const std::string& message) const;
};

// Throws Error as subjects::options_of_file() does, and where several files are named, or none. damps: the command has the
// options of damping; else those of a file are left out, and standard error says so.
ExpandedLine expand_subject_files(const std::vector<std::string>& words, bool damps);

}  // namespace forceshade::apps
