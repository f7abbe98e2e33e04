// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An experiment as a researcher writes it down: its conditions, stimuli, breaks and texts, from a TOML file.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/law.h"
#include "study/experiments/participant.h"

namespace forceshade::experiments {

enum class Experiment { matching, classification };

// "matching" or "classification", as files and folders call it.
constexpr std::string_view name_of(Experiment experiment) {
  return experiment == Experiment::matching ? "matching" : "classification";
}

enum class StimulusKind { law, height_map, mesh, subject };

// One shape of a stimulus that is no law, with the radius that stands for it in conditions and results.
struct Variant {
  Mil radius = 0;              // 0 where the stimulus has one shape only
  std::filesystem::path file;  // of the height map, mesh or subject; absolute, or relative to the working folder
  std::string unit;            // of a mesh's numbers: mm, cm, m or in
};

// Something to be felt. A law has any radius; a height map or a mesh has those of its variants, by rising radius.
struct Stimulus {
  std::string name;  // unique in its protocol: the law's, unless the file gives another
  StimulusKind kind = StimulusKind::law;
  LawId law = LawId::wall;
  std::vector<Variant> variants;  // empty for a law
};

// The continuation of a session that was interrupted in a block.
enum class Resume {
  trial,  // the interrupted trial begins again, after a screen of text
  block,  // the block begins again with its instructions; its earlier trials are left out of the results
};

enum class BlockOrder { as_listed, random };

// The effect of the key for a bigger bump. The thesis's figure 5-7 speaks of the bump's size, its chapter 7 calls a bump of a
// smaller radius bigger, because at the same width it is higher.
enum class Bigger { higher, larger_radius };

struct Protocol {
  std::filesystem::path file;  // it was read from
  Experiment experiment = Experiment::matching;
  std::string name;
  std::filesystem::path language;  // file of texts

  Mil width = 0;                // chord of each bump on the plane
  float stiffness = 0;          // N/mm
  int practice_trials = 0;      // before the first block; no part of the results
  int trials_before_break = 0;  // 0: no breaks within a block
  Resume resume = Resume::trial;
  BlockOrder block_order = BlockOrder::as_listed;

  std::vector<Stimulus> stimuli;  // that are matched or classified; each is a block in the matching experiment
  int repetitions = 0;            // of each condition

  // These are set in the matching experiment alone. Stimulus and vision make the blocks, the rest their conditions (thesis,
  // Table 5.1).
  Stimulus reference;
  std::vector<bool> vision;  // in the order of the blocks
  std::vector<Mil> reference_radii;
  Mil large_initial_radius = 0, small_initial_radius = 0;     // the third initial radius is the reference's own
  Mil radius_step = 0, least_radius = 0, largest_radius = 0;  // of the keys; the last step ends at the limit
  Bigger bigger = Bigger::higher;
  Mil spacing = 0;  // between the middles of the two bumps

  // The radii of the classification experiment alone (thesis, Table 5.2), for laws; other stimuli have their variants' radii.
  std::vector<Mil> radii;

  // The stimulus of this name, among the matched or classified ones and the reference. Precondition: there is one.
  const Stimulus& stimulus(std::string_view name) const;
  Parameters parameters(Mil radius) const;  // of a law: mm, N/mm

  // The radii at which a stimulus is presented in the classification experiment.
  std::vector<Mil> radii_of(const Stimulus& stimulus) const;
  // The radius after a press of a key: direction 1 is the next larger one, -1 the next smaller; the same at the limit.
  Mil stepped(const Stimulus& stimulus, Mil radius, int direction) const;

  // Trials of one participant without practice.
  int trials() const;

  // Every bump that a session can render, each once, at position 0: what has to be certified before it.
  std::vector<Bump> bumps() const;
};

// The rule for missing height maps and meshes of a protocol: they may be missing where a finished session is analysed.
enum class Files { must_exist, may_be_missing };

// Files within it are relative to `folder`; without one, to the protocol's. Throws Error with file, line and key, also
// where a condition cannot be rendered: a radius below half the width, a variant that a condition needs and that is missing.
// The contents of files of height maps, meshes and texts are for their own readers.
Protocol read_protocol(const std::filesystem::path& file, const std::filesystem::path& folder = {},
                       Files files = Files::must_exist);

}  // namespace forceshade::experiments
