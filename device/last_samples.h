// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The last moments of a run, kept while it runs, for when it ends badly.

#include <cstddef>
#include <vector>

#include "device/sample.h"

namespace forceshade::device {

class LastSamples final : public SampleSink {
 public:
  // The last sample, and those of so many seconds before it at this rate (Hz). Allocates here and nowhere else.
  LastSamples(double seconds, double rate);

  // The zero force that ends a run is not kept.
  void push(const Sample& sample) noexcept override;

  // The samples in order, oldest first. Not to be called during the run.
  std::vector<Sample> samples() const;

 private:
  std::vector<Sample> ring_;
  std::size_t pushed_ = 0;
};

}  // namespace forceshade::device
