// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a command works on: --law with its parameters, --height-map SPEC or --mesh FILE. Commands that need no more than a
// subject do not distinguish them.

#include <memory>
#include <vector>

#include "forceshade/apps/command.h"
#include "forceshade/apps/height_map_option.h"
#include "forceshade/apps/mesh_option.h"
#include "forceshade/properties/subject.h"

namespace forceshade::apps {

class SubjectOption {
 public:
  SubjectOption(CLI::App& command, LawOptions::Laws laws)
      : law_(command, laws), height_map_(command, law_), mesh_(command, law_) {}

  // One, or all laws. Throws BadInput or heights::Error, naming the option or file, the line, the value and what was expected.
  std::vector<std::shared_ptr<const properties::Subject>> subjects() const;
  std::shared_ptr<const properties::Subject> subject() const { return subjects().front(); }

  bool is_a_law() const { return !height_map_.is_given() && !mesh_.is_given(); }
  const LawOptions& law() const { return law_; }

 private:
  LawOptions law_;
  HeightMapOption height_map_;
  MeshOption mesh_;
};

}  // namespace forceshade::apps
