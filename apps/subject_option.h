// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a command works on: --law with its parameters, or --height-map SPEC. Commands that need no
// more than a subject do not distinguish the two.

#include <memory>
#include <vector>

#include "forceshade/apps/command.h"
#include "forceshade/apps/height_map_option.h"
#include "forceshade/properties/subject.h"

namespace forceshade::apps {

class SubjectOption {
 public:
  SubjectOption(CLI::App& command, LawOptions::Laws laws) : law_(command, laws), height_map_(command, law_) {}

  // One, or all laws. Throws BadInput or heights::Error, naming the option or file, the line, the value and what was expected.
  std::vector<std::shared_ptr<const properties::Subject>> subjects() const;
  std::shared_ptr<const properties::Subject> subject() const { return subjects().front(); }

  bool is_a_law() const { return !height_map_.is_given(); }
  const LawOptions& law() const { return law_; }
  const HeightMapOption& height_map() const { return height_map_; }

 private:
  LawOptions law_;
  HeightMapOption height_map_;
};

}  // namespace forceshade::apps
