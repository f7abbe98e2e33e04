// SPDX-License-Identifier: BSD-3-Clause
// scripts/faults: tries every fault and prints docs/tables/faults.md. Exit code 1 if one is not answered as it should be.

#include <cstdio>

#include "files/csv.h"
#include "tests/device/faults/fault.h"

namespace {

// At most a digit behind the point: milliseconds are measured, ticks are whole.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 100 && value != static_cast<int>(value) ? "%.1f" : "%.0f", value);
  return text;
}

}  // namespace

int main() {
  using namespace forceshade::faults;
  int wrong = 0;
  std::printf(
      "| fault | kind | reaction | zero force after | at most | data lost | at most |\n|---|---|---|---|---|---|---|\n");
  for (const Fault& fault : catalogue()) {
    const Outcome outcome = tried(fault);
    const std::string zero = !outcome.to_zero    ? "the force goes on"
                             : fault.under_force ? number(*outcome.to_zero) + " " + fault.unit
                                                 : "no force";
    const std::string most = fault.to_zero && fault.under_force ? number(*fault.to_zero) + " " + fault.unit : "";
    std::printf("| %s | %s | %s | %s | %s | %s | %s |\n", fault.what.c_str(), name_of(fault.kind).c_str(),
                fault.reaction.c_str(), zero.c_str(), most.c_str(),
                (number(outcome.lost) + (outcome.lost > 0 ? " " + fault.lost_unit : "")).c_str(),
                (number(fault.lost) + (fault.lost > 0 ? " " + fault.lost_unit : "")).c_str());
    for (const std::string& complaint : complaints(fault, outcome)) {
      std::fprintf(stderr, "FAILED: %s: %s\n", fault.what.c_str(), complaint.c_str());
      wrong = 1;
    }
  }
  return wrong;
}
