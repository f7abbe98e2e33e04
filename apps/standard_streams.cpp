// SPDX-License-Identifier: BSD-3-Clause
#include "apps/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "apps/troubleshooting.h"
#include "files/output_file.h"

namespace forceshade::apps {

void open_standard_streams() {
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit of a file's size fails then, as on a full disk
  // Opened the wrong way round, so that using one fails. open() takes the lowest number that is free.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  // Larger than what a command prints between two flushes, so that a failed write is seen where its reason is known.
  static std::array<char, 1 << 16> buffer;
  if (::isatty(STDOUT_FILENO) == 0) std::setvbuf(stdout, buffer.data(), _IOFBF, buffer.size());
}

void flush_standard_output() {
  const bool was_good = std::cout.good() && std::ferror(stdout) == 0;
  errno = 0;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (was_good && flushed && std::cout.good()) return;
  const int reason = errno;
  throw files::OutputError("standard output: cannot write: " +
                           (reason != 0 ? std::generic_category().message(reason) : "an earlier write failed"));
}

void print_beside(std::initializer_list<std::string_view> outputs, const std::string& words) {
  if (std::ranges::find(outputs, "-") != outputs.end()) return;
  std::fputs(with_page(words).c_str(), stdout);
  flush_standard_output();
}

}  // namespace forceshade::apps
