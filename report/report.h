// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The certificate as one self-contained HTML page: summary, what was proved and how, and pictures of the certified laws.

#include <string>

#include "forceshade/certificate.h"
#include "report/gnuplot.h"

namespace forceshade::properties {

enum class Pictures { all, none };

// Plots are gnuplot's SVG, drawn from the fast path itself. Needs no file or network once written. With pictures, throws
// Error when gnuplot does not draw, or a certificate has parameters outside their law's domain.
std::string to_html(const Certificate& certificate, Pictures shown = Pictures::all);

}  // namespace forceshade::properties
