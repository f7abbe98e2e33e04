// SPDX-License-Identifier: BSD-3-Clause
// Every fault of a PHANToM is answered as the catalogue says, but for those that time decides. Driven in this process, on the
// stand-in for its driver.

#include <gtest/gtest.h>

#include "tests/device/faults/fault_suite.h"

namespace forceshade::faults {
namespace {

INSTANTIATE_TEST_SUITE_P(faults, fault, testing::ValuesIn(faults_of({phantom_faults()})), test_name);

}  // namespace
}  // namespace forceshade::faults
