// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The figures of chapter 6 of the thesis, for gnuplot: report/gnuplot.h makes SVG and PNG files of them.

#include <string>
#include <vector>

#include "report/gnuplot.h"
#include "study/analysis/profiles.h"
#include "study/analysis/psychometric.h"
#include "study/analysis/tables.h"

namespace forceshade::analysis {

// "bump-cylinder-no-vision", for names of files and ids: what is no ASCII letter, digit or - in the stimulus becomes _.
std::string condition_name(const std::string& stimulus, bool vision);

// A figure has a panel for each participant, and the last one for all; `frame.id` is the name for its file: matching-, then
// condition_name().

// Figures 6-2, 6-3 and so on: the final radius against the reference radius, with the line of least squares. o, x and + are
// trials that began at the small, the same and the large radius.
properties::Picture scatter(const experiments::Results& results, const MatchingTable& table);

// Figures 6-4, 6-5 and so on: the answers and their mean against the reference radius.
properties::Picture satisfaction(const experiments::Results& results, const MatchingTable& table);

// Answer 4 against the angle, with the fitted function, theta-critical and its interval.
properties::Picture psychometric_figure(const std::vector<PsychometricEstimate>& estimates, const PsychometricModel& model);

// Figure 6-6: the radius against the number of the step, up to three panels a row.
properties::Picture radius_profiles(const std::vector<RadiusProfile>& profiles);

// Figures 6-1, 6-7, 6-12 and 6-17: the stylus over the nominal geometry, as long up as across.
properties::Picture position_profile(const PositionProfile& profile);

}  // namespace forceshade::analysis
