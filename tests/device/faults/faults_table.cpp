// SPDX-License-Identifier: BSD-3-Clause
// scripts/faults: tries every fault and prints docs/tables/faults.md. Exit code 1 if one is not answered as it should be.

#include <cstdio>

#include "tests/device/faults/fault.h"

int main() {
  using namespace forceshade::faults;
  int wrong = 0;
  std::printf("| fault | kind | reaction | zero force after | at most | lost | at most |\n|---|---|---|---|---|---|---|\n");
  for (const Fault& fault : catalogue()) {
    const Outcome outcome = tried(fault);
    const auto ticks = [](std::size_t count) { return std::to_string(count) + (count == 1 ? " tick" : " ticks"); };
    const std::string zero = !outcome.to_zero ? "the force goes on" : fault.under_force ? ticks(*outcome.to_zero) : "no force";
    const std::string most = fault.to_zero && fault.under_force ? ticks(*fault.to_zero) : "";
    std::printf("| %s | %s | %s | %s | %s | %zu | %zu |\n", fault.what.c_str(), name_of(fault.kind).c_str(),
                fault.reaction.c_str(), zero.c_str(), most.c_str(), outcome.lost, fault.lost);
    for (const std::string& complaint : complaints(fault, outcome)) {
      std::fprintf(stderr, "FAILED: %s: %s\n", fault.what.c_str(), complaint.c_str());
      wrong = 1;
    }
  }
  return wrong;
}
