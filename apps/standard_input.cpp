// SPDX-License-Identifier: BSD-3-Clause
#include "apps/standard_input.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ios>
#include <streambuf>
#include <system_error>

#include "apps/signals.h"
#include "forceshade/checks.h"

namespace forceshade::apps {
namespace {

class StandardInput final : public std::streambuf {
 private:
  int_type underflow() override {
    for (;;) {
      if (interrupted()) throw Interrupted();
      const ssize_t size = ::read(STDIN_FILENO, bytes_.data(), bytes_.size());
      if (size >= 0) {
        setg(bytes_.data(), bytes_.data(), bytes_.data() + size);
        return size == 0 ? traits_type::eof() : traits_type::to_int_type(bytes_[0]);
      }
      if (errno == EAGAIN)
        wait_for_bytes();
      else if (errno != EINTR)
        throw std::ios_base::failure("standard input", std::error_code(errno, std::generic_category()));
    }
  }

  // An empty pipe that another program made non-blocking.
  static void wait_for_bytes() {
    pollfd bytes{STDIN_FILENO, POLLIN, 0};
    ::poll(&bytes, 1, 100);
  }

  std::array<char, 1 << 16> bytes_;
};

}  // namespace

std::istream& standard_input() {
  static StandardInput input;
  static std::istream stream(&input);
  return stream;
}

}  // namespace forceshade::apps
