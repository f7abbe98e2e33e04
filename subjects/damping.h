// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The damping of a subject in words: the one place that makes parameters of them.

#include "forceshade/damping.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// The parameters that the options damping ("0.002", "2Ns/m"), drag and damping-filter ("0.5", a share; "2ms", a time constant)
// give; off without them. Behind a comma damping has what a file calls `most`, drag `full_at`. Throws Error for what cannot be
// read, is out of its range, or lacks another option.
damping::Described read_damping(const Options& options);

}  // namespace forceshade::subjects
