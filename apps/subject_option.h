// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a command works on: --law with its parameters, --height-map SPEC or --mesh FILE, or --subject with a file that has these
// options. Commands that need no more than a subject do not distinguish them.

#include <memory>
#include <vector>

#include "apps/command.h"
#include "apps/height_map_option.h"
#include "apps/mesh_option.h"
#include "properties/subject.h"

namespace forceshade::apps {

class SubjectOption {
 public:
  SubjectOption(CLI::App& command, LawOptions::Laws laws);

  // One, or all laws. Throws BadInput or heights::Error, naming the option or file, the line, the value and what was expected.
  std::vector<std::shared_ptr<const properties::Subject>> subjects() const;
  std::shared_ptr<const properties::Subject> subject() const { return subjects().front(); }

  // The one that is named, without its exact side: what a device is driven with. Throws as subjects() does.
  Rendering rendering() const;

  // The text of a subject file for each of them, with every option that holds, given or not; a file is named without its
  // folder.
  std::vector<std::string> subject_files() const;

  // The options of a mesh or height map as a shell reads them, every one that holds, files with their folders; empty for laws.
  std::string options_for_shell() const;

  bool is_a_law() const { return !height_map_.is_given() && !mesh_.is_given(); }
  const LawOptions& law() const { return law_; }
  const HeightMapOption& height_map() const { return height_map_; }
  const MeshOption& mesh() const { return mesh_; }

 private:
  LawOptions law_;
  HeightMapOption height_map_;
  MeshOption mesh_;
};

// The one subject of a file that --subject may name. Throws as subjects() does.
std::shared_ptr<const properties::Subject> read_subject(const std::string& file);

}  // namespace forceshade::apps
