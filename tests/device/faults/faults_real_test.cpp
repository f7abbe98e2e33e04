// SPDX-License-Identifier: BSD-3-Clause
// The faults whose answer is judged in ms of real time.

#include "tests/device/faults/fault_suite.h"

namespace forceshade::faults {
namespace {

INSTANTIATE_TEST_SUITE_P(faults, fault, testing::ValuesIn(faults_of({disk_faults(), command_faults(), phantom_faults()}, true)),
                         test_name);

}  // namespace
}  // namespace forceshade::faults
