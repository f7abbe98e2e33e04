// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sessions as a data set of the Brain Imaging Data Structure (BIDS 1.9.0): behaviour, and motion where ticks were recorded.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/output_folder.h"

namespace forceshade::experiments {

// One tick: s since the first of its run; mm; N on the hand. Axes as in docs/laws.md: x right, y away from the user, z up.
struct MotionSample {
  double time = 0, x = 0, y = 0, z = 0, fx = 0, fy = 0, fz = 0;
};

// The ticks of one run, read one after another, because a session has millions of them.
struct Motion {
  double ticks_per_second = 0;      // nominal
  std::string manufacturer, model;  // of the device; empty where it has none
  std::function<std::optional<MotionSample>()> next;
};

// The motion of a session's run, from 1; nothing where none was recorded.
using MotionOf = std::function<std::optional<Motion>(const std::filesystem::path& session, int run)>;

// Writes the data set into `folder`, which must not exist or be empty, whole or not at all. In labels pseudonyms lose what BIDS
// does not allow there, dashes, and "sub-" before them, which every label has; the original is a column of participants.tsv.
// Throws Error where two pseudonyms become one, on file systems that fold case, too, or a participant did an experiment
// twice; files::OutputError where the disk is full. `authors`: of the data set, a name each, in their order; without any the
// data set names none.
void export_bids(std::span<const std::filesystem::path> sessions, const std::filesystem::path& folder,
                 const MotionOf& motion_of = {}, const std::vector<std::string>& authors = {});

// The same into a folder that the caller commits.
void export_bids(std::span<const std::filesystem::path> sessions, files::OutputFolder& folder, const MotionOf& motion_of,
                 const std::vector<std::string>& authors);

}  // namespace forceshade::experiments
