// SPDX-License-Identifier: BSD-3-Clause
// chosen.h: Tells a file that scripts/generated_mutants has changed which of its mutants a process runs.
//
// FORCESHADE_MUTANTS names a file of one byte for each mutant: 1 where it is active. FORCESHADE_REACHED names a file of the same
// length, which every process of a test shares: a mutant's byte becomes 1 when its place is evaluated. Without them nothing is
// changed, nor is it before the constructor below has run, nor in a constant expression.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

namespace forceshade_mutants {

struct Choice {
  const unsigned char* active = nullptr;
  unsigned char* reached = nullptr;
  Choice()
      : active(static_cast<const unsigned char*>(bytes("FORCESHADE_MUTANTS", O_RDONLY, PROT_READ))),
        reached(static_cast<unsigned char*>(bytes("FORCESHADE_REACHED", O_RDWR, PROT_READ | PROT_WRITE))) {}
  static void* bytes(const char* variable, int access, int protection) {
    const char* name = std::getenv(variable);
    const int file = name == nullptr ? -1 : ::open(name, access | O_CLOEXEC);
    if (file < 0) return nullptr;
    void* const begin = ::mmap(nullptr, static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), protection, MAP_SHARED, file, 0);
    ::close(file);
    return begin == MAP_FAILED ? nullptr : begin;
  }
};
inline const Choice kChoice;

constexpr bool chosen(int mutant) {
  if (std::is_constant_evaluated()) return false;
  if (kChoice.reached != nullptr) kChoice.reached[mutant] = 1;
  return kChoice.active != nullptr && kChoice.active[mutant] != 0;
}

}  // namespace forceshade_mutants
