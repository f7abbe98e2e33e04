// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The process that holds a PHANToM: it loads the vendor's library, runs the frames, and lets the device go when the process of
// the servo loop ends, however that ends. docs/phantom.md, "A process of its own", says why.

#include <sys/types.h>

#include <string>

#include "device/phantom/phantom.h"
#include "device/phantom/phantom_shared.h"

namespace forceshade::device {

// All that the new process does, until the other end of the socket is closed or `parent` is gone. Its exit code
// (phantom_end.h).
int run_phantom_host(int socket, pid_t parent, PhantomShared& shared, const std::string& name, const PhantomOptions& options);

}  // namespace forceshade::device
