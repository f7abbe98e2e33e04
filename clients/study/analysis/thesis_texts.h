// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The files of study/analysis/thesis/ as texts of the program, so that an installed one needs no file: tables 6.1 to 6.9,
// then 7.1.

namespace forceshade::analysis {

extern const char* const kThesisTexts[10];

}  // namespace forceshade::analysis
