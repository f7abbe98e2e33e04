// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The signals of a crash, which no thread and no process of ours holds back.

#include <array>
#include <csignal>

namespace forceshade::system {

inline constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};

}  // namespace forceshade::system
