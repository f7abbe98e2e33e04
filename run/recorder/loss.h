// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Words for samples that a recorder could not keep.

#include <string>

#include "forceshade/recording.h"

namespace forceshade::recorder {

// The words are empty where every sample is in the recording of this path and the disk took all of it.
inline std::string words_of_loss(const std::string& path, const Recorder::Result& result) {
  if (result.lost == 0 && result.error.empty()) return "";
  return (result.error.empty() ? path + ": the disk was too slow" : result.error) + "; recorded " +
         std::to_string(result.written) + " samples, lost " + std::to_string(result.lost);
}

}  // namespace forceshade::recorder
