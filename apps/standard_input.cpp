// SPDX-License-Identifier: BSD-3-Clause
#include "apps/standard_input.h"

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
    ssize_t size = 0;
    do {
      if (interrupted()) throw Interrupted();
      size = ::read(STDIN_FILENO, bytes_.data(), bytes_.size());
    } while (size < 0 && errno == EINTR);
    if (size < 0) throw std::ios_base::failure("standard input", std::error_code(errno, std::generic_category()));
    setg(bytes_.data(), bytes_.data(), bytes_.data() + size);
    return size == 0 ? traits_type::eof() : traits_type::to_int_type(bytes_[0]);
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
