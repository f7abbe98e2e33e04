// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The analysis as one self-contained HTML page: tables beside the thesis's numbers, figures, the method.

#include <string>
#include <vector>

#include "report/gnuplot.h"
#include "study/analysis/analysis.h"
#include "study/analysis/profiles.h"

namespace forceshade::analysis {

// The data that a session can add to its results.
struct Profiles {
  std::vector<RadiusProfile> radii;
  std::vector<PositionProfile> positions;
};

// Every figure, in the order of the page; a figure without data is left out.
std::vector<properties::Picture> pictures(const Analysis& analysis, const Profiles& profiles);

// Without drawings where `drawn` is empty; else it holds one <svg> element for each of the pictures.
std::string to_html(const Analysis& analysis, const std::vector<properties::Picture>& pictures,
                    const std::vector<std::string>& drawn);

}  // namespace forceshade::analysis
