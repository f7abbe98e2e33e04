// SPDX-License-Identifier: BSD-3-Clause
// In place of motion.cpp in a build without libcsv.
#include "rendering/left_out.h"
#include "subjects/motion.h"

namespace forceshade::subjects {

scene::Motion read_motion(const std::string& file, double, bool) {
  throw LeftOut(file + ": a file of poses cannot be read", "csv-files");
}

}  // namespace forceshade::subjects
