// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A page that a command writes.

#include <string>

#include "apps/tell.h"
#include "report/gnuplot.h"
#include "report/report.h"

namespace forceshade::apps {

// The page by to_html(Pictures): without pictures, and with a warning that names the file, where gnuplot does not draw them.
template <class ToHtml>
std::string page_of(const std::string& file, const ToHtml& to_html) {
  try {
    return to_html(properties::Pictures::all);
  } catch (const properties::PlotError& error) {
    tell(file + " has no pictures: " + error.what());
    return to_html(properties::Pictures::none);
  }
}

}  // namespace forceshade::apps
