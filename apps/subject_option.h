// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The subject of a command: --law with its parameters, --height-map SPEC, --mesh FILE or --scene FILE, or --subject with a file
// that has these options. Commands that need no more than a subject do not distinguish them. What the options mean is for
// subjects/read.h to say.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"
#include "forceshade/properties.h"
#include "forceshade/renderer.h"
#include "subjects/read.h"

namespace forceshade::apps {

class SubjectOption {
 public:
  // --law is needed where one is expected, and is "all" by default where several are. damps: the command has the options of
  // damping; else that of a file is left out, and said so.
  SubjectOption(CLI::App& command, subjects::Laws laws, bool damps = false);

  // Returns true if a subject option was given.
  bool is_given() const;

  // Those that were given. Throws CLI::RequiredError where none is.
  subjects::Options options() const;

  // One, or all laws. The check of a mesh or scene draws its progress. Throws Error, naming the option or file, the line,
  // the value and what was expected; and Interrupted.
  std::vector<Description> descriptions() const;
  Description description() const { return std::move(descriptions().front()); }

  std::vector<std::shared_ptr<const properties::Subject>> subjects() const;
  std::shared_ptr<const properties::Subject> subject() const { return subjects().front(); }

  // The one that is named, without its exact side: what a device is driven with. Throws as descriptions() does.
  Rendering rendering() const;

 private:
  subjects::Laws laws_;
  bool damps_;
  std::map<std::string, std::string> values_;
  std::map<std::string, CLI::Option*> options_;  // by their keys
};

// subjects::read_one() that draws the progress of the check of a mesh or scene on standard error.
Description read_with_progress(const subjects::Options& options);

// --radius and --width of a bump; default: those of the thesis.
class BumpOptions {
 public:
  explicit BumpOptions(CLI::App& command);

  bool is_given() const { return !radius_option_->empty() || !width_option_->empty(); }

  // With a stiffness of 1 N/mm, which the geometry does not need. Throws Error.
  Parameters bump() const;

 private:
  std::string radius_ = subjects::kUsualRadius, width_ = subjects::kUsualWidth;
  CLI::Option *radius_option_, *width_option_;
};

}  // namespace forceshade::apps
