// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/faults/fault.h"

#include <exception>
#include <string_view>

#include "files/csv.h"
#include "tests/world/world.h"

namespace forceshade::faults {
namespace {

bool says(std::string_view text, std::string_view words) {
  constexpr std::string_view kAny = " ... ";
  const std::size_t end = words.find(kAny), at = text.find(words.substr(0, end));
  if (at == std::string_view::npos || end == std::string_view::npos) return at != std::string_view::npos;
  return says(text.substr(at + end), words.substr(end + kAny.size()));
}

}  // namespace

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::device: return "device";
    case Kind::timing: return "timing";
    case Kind::disk: break;
  }
  return "disk";
}

Outcome tried(const Fault& fault, const Bench& bench) {
  Outcome outcome;
  world::World world;
  const auto end = world.run(
      [&] {
        try {
          outcome = fault.run(bench);
        } catch (const std::exception& error) {
          outcome.reaction = std::string("threw: ") + error.what();
        }
      },
      600 * system::kSecond);
  if (end != world::World::End::over) outcome.reaction = "it never ends";
  return outcome;
}

std::vector<std::string> complaints(const Fault& fault, const Outcome& outcome) {
  constexpr double kFelt = 0.1, kPeak = 8.5 * (1 + 0x1p-20);  // N; a Premium's sheet, and a force rounded to binary32
  std::vector<std::string> complaints;
  const auto expect = [&](bool held, const std::string& complaint) {
    if (!held) complaints.push_back(complaint);
  };
  expect(outcome.took_effect, "the fault never happened");
  expect(says(outcome.reaction, fault.reaction),
         "expected the reaction \"" + fault.reaction + "\", got \"" + outcome.reaction + "\"");
  expect(fault.under_force ? outcome.before >= kFelt : outcome.before == 0,
         "a force before the fault of " + shortest(outcome.before) + " N");
  expect(outcome.highest <= kPeak, "a force of " + shortest(outcome.highest) + " N");
  if (!fault.to_zero) {
    expect(!outcome.to_zero, "the force did not go on");
  } else if (!outcome.to_zero) {
    complaints.push_back("the force went on");
  } else {
    expect(*outcome.to_zero <= *fault.to_zero, "zero force only after " + std::to_string(*outcome.to_zero) +
                                                   " ticks, expected at most " + std::to_string(*fault.to_zero));
  }
  expect(outcome.lost <= fault.lost,
         std::to_string(outcome.lost) + " samples lost, expected at most " + std::to_string(fault.lost));
  return complaints;
}

std::vector<Fault> catalogue() {
  std::vector<Fault> all;
  for (const auto& part : {position_faults(), device_faults(), disk_faults()}) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace forceshade::faults
