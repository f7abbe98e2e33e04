// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A conformance run as one self-contained HTML page, in the manner of a certificate's.

#include <string>

#include "forceshade/description.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/recordings/judged_recording.h"
#include "properties/conformance/simulators/conform_simulator.h"
#include "report/report.h"

namespace forceshade::conformance {

// A renderer's words about itself are text and stay so. Needs no file or network once written. With pictures, throws Error
// when gnuplot does not draw.
std::string to_html(const Conformance& found, const Description& subject, const Circumstances& circumstances,
                    properties::Pictures shown = properties::Pictures::all);

// The same of a simulator. version: of this program; command: repeats the run, empty where it is not known.
std::string to_html(const simulators::SimulatorConformance& found, const std::string& version, const std::string& command,
                    properties::Pictures shown = properties::Pictures::all);

// The same of a recording, beside the subject where there was one.
std::string to_html(const JudgedRecording& found, const Tolerance& tolerance, const std::string& version,
                    const std::string& command, properties::Pictures shown = properties::Pictures::all);

}  // namespace forceshade::conformance
