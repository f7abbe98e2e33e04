// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The process that holds a PHANToM: it loads the vendor's library, runs the frames, and lets the device go when the process of
// the servo loop ends, however that ends. docs/phantom.md, "A process of its own", says why.

#include <string>

#include "device/phantom/phantom.h"
#include "device/phantom/phantom_shared.h"
#include "system/process.h"

namespace forceshade::device {

// All that the new process does, until the other end of the packets is closed or the other process is gone. Its exit code
// (phantom_end.h).
int run_phantom_host(system::Packets& packets, PhantomShared& shared, const std::string& name, const PhantomOptions& options,
                     HdapiLibrary library);

}  // namespace forceshade::device
