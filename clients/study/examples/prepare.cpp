// SPDX-License-Identifier: BSD-3-Clause
// Certifies every bump that a session of a protocol can render: prepare PROTOCOL CERTIFICATES.
#include <cstdio>
#include <exception>

#include "study/preparation/preparation.h"

using namespace forceshade;

int main(int argc, char** argv) try {
  if (argc != 3) return std::puts("usage: prepare PROTOCOL CERTIFICATES"), 2;
  std::filesystem::create_directories(argv[2]);
  const auto say = [](const apparatus::Prepared& one) {
    std::printf("%zu of %zu  %s %s\n", one.number, one.of, one.bump.c_str(), one.why_not.c_str());
  };
  const std::atomic<bool> stop = false;
  return apparatus::prepare(argv[1], argv[2], {.threads = 2, .done = say}, stop) ? 0 : 1;
} catch (const std::exception& error) {
  return std::printf("refused: %s\n", error.what()), 1;
}
