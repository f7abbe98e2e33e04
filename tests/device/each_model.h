// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A check of every PHANToM we simulate.

#include <gtest/gtest.h>

#include "device/simulated/model.h"

namespace forceshade::device {

template <class Check>
void for_each_model(const Check& check) {
  for (const auto& make : kModels) {
    const Model model = make();
    SCOPED_TRACE(model.name);
    check(model);
  }
}

}  // namespace forceshade::device
