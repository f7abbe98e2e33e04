// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A third-party program that answers lines with lines, in bounded time and memory whatever it does.

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "files/lines.h"

namespace forceshade::files {

// In a session of its own, with pipes to its standard streams. One thread at a time.
class ChildProcess final : public LineProgram {
 public:
  // command: a line for /bin/sh. whose: what messages call it; it has to outlive this. Throws std::system_error where no
  // process can be made.
  ChildProcess(const std::string& command, const ProcessLimits& limits, const char* whose);
  // After the grace ends it, and all that it has started, also what has left its session. So it goes, too, where this process
  // is killed.
  ~ChildProcess() override;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

 private:
  void move(std::int64_t until) override;

  pid_t keeper_ = -1;  // its parent (keeper.h)
  int to_ = -1, from_ = -1, errors_ = -1, control_ = -1, reports_ = -1;
};

}  // namespace forceshade::files
