// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recording as files that other programs read.

#include <string>

#include "recorder/recording.h"

namespace forceshade::recorder {

// One row a sample, times in seconds and µs. Numbers in the shortest form that reads back the same; an encoder that the device
// has not is empty. Both throw files::OutputError, or RecordingError for a damaged recording, and then leave no file.
void export_csv(Recording& recording, const std::string& path);

// NPY 1.0, a structured array: numpy.load(path)["x_mm"]. The very bytes of the recording.
void export_npy(Recording& recording, const std::string& path);

// Writes the format that the end of the path names: .npy or .NPY, else CSV.
void export_table(Recording& recording, const std::string& path);

}  // namespace forceshade::recorder
