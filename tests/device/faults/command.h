// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The forceshade command as another process.

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace forceshade::faults {

using Words = std::vector<std::string>;

class Command {
 public:
  // In `directory`, with `environment` (NAME=VALUE) added to this process's.
  Command(const tests::TemporaryDirectory& directory, const Words& arguments, const Words& environment = {});
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  void send(int signal) const;

  bool is_running() const;

  // Waits for its end: "exit 0: " and all it printed, but for the warning of --uncertified. A process that is stopped instead
  // is left to the destructor.
  std::string end();

 private:
  const tests::TemporaryDirectory& directory_;
  pid_t process_ = -1;
};

}  // namespace forceshade::faults
