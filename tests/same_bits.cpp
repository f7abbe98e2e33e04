// SPDX-License-Identifier: BSD-3-Clause
// Prints the lines of tests/golden/hashes.txt as this build makes them. Exit codes: 1 refused, or instruction sets differ.

#include "same_bits.h"

#include <exception>

int main() {
  using namespace forceshade;
  bool all_same = true;
  for (const LawName& law : kLaws) try {
      const tests::Bits bits = tests::bits_of(law.id);
      std::printf("%s %s\n", std::string(law.name).c_str(), bits.hash.c_str());
      for (const fast::InstructionSet set : fast::kInstructionSets)
        all_same &= bits.different[static_cast<std::size_t>(set)] == 0;
    } catch (const std::runtime_error& error) {
      return std::fprintf(stderr, "refused: %s\n", error.what()), 1;
    }
  return all_same ? 0 : 1;
}
