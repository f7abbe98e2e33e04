// SPDX-License-Identifier: BSD-3-Clause
// Prints what ends a force: each fault at steps of each part of a session, and each pair in contact, over every arm. Its arms
// have no watchdog of their own, so that a force is ended by this program's own doing alone. docs/faults.md explains the
// columns.

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/world/phantom_arm.h"

namespace {

using namespace forceshade::world;

long tried = 0, broken = 0;

void count(const Found& found) {
  tried += found.tried;
  broken += found.broken;
  if (found.broken > 0) std::fprintf(stderr, "%s\n", found.first.c_str());
}

// The cell of one fault, in all parts.
std::string cell(const Found& found) {
  if (found.stay > 0) return "**stays**";
  if (found.without_watchdog > 0) return "**" + std::to_string(static_cast<long>(found.without_watchdog)) + " ms**";
  if (found.go_on == found.tried) return "goes on";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f ms", found.longest);
  return text;
}

void add(Found& all, const Found& found) {
  all.stay += found.stay;
  all.longest = std::max(all.longest, found.longest);
  all.without_watchdog = std::max(all.without_watchdog, found.without_watchdog);
}

Found everywhere(const Fault& fault, const ArmKind& arm) {
  Found all;
  for (const Part& part : parts()) {
    Plan plan = plan_for(part, arm);
    plan.own_watchdog.reset();
    const Found found = placed({fault}, {part.from, 40}, plan, arm.open);
    count(found);
    add(all, found);
    if (!part.events.empty()) continue;  // they end every session
    all.tried += found.tried;
    all.go_on += found.go_on;
  }
  return all;
}

// A row of cells for each arm, in the order of arms(); a cell that is not there is empty.
using Rows = std::vector<std::pair<std::string, std::map<std::string, std::string>>>;

void print(const Rows& rows, const std::vector<ArmKind>& kinds) {
  std::printf("| fault |");
  for (const ArmKind& kind : kinds) std::printf(" %s |", kind.name.c_str());
  std::printf("\n|---|");
  for (std::size_t i = 0; i < kinds.size(); ++i) std::printf("---|");
  std::printf("\n");
  for (const auto& [name, cells] : rows) {
    std::printf("| %s |", name.c_str());
    for (const ArmKind& kind : kinds) std::printf(" %s |", cells.contains(kind.name) ? cells.at(kind.name).c_str() : "");
    std::printf("\n");
  }
}

void add(Rows& rows, const std::string& name, const std::string& arm, const std::string& its) {
  auto row = std::ranges::find_if(rows, [&](const auto& it) { return it.first == name; });
  if (row == rows.end()) row = rows.insert(rows.end(), {name, {}});
  row->second[arm] = its;
}

}  // namespace

int main() {
  const std::vector<ArmKind> kinds{dhd_arm(), command_arm(), haply_arm(), phantom_arm()};
  const std::vector<Fault> seconds = faults_of_the_machine();
  Rows faults, pairs;
  std::map<std::string, std::set<std::string>> needs_the_arm;
  for (const ArmKind& kind : kinds) {
    std::vector<Fault> all = seconds;
    all.insert(all.end(), kind.faults.begin(), kind.faults.end());
    ArmKind strict = kind;  // for the machine's faults
    strict.longest_force = Plan{}.longest_force;
    for (std::size_t i = 0; i < all.size(); ++i) {
      Fault& fault = all[i];
      fault.words.clear();
      const Found found = everywhere(fault, i < seconds.size() ? strict : kind);
      if (found.stay > 0 || found.without_watchdog > 0) needs_the_arm[kind.name].insert(fault.name);
      add(faults, fault.name, kind.name, cell(found));
    }
  }
  print(faults, kinds);
  const Part& contact = parts()[1];
  const std::vector<ArmKind> framed(kinds.begin(), kinds.end() - 1);  // a PHANToM's pairs are in phantom_world_test
  for (const ArmKind& kind : framed) {
    std::vector<Fault> firsts = faults_of_the_machine();
    firsts.insert(firsts.end(), kind.faults.begin(), kind.faults.end());
    Plan plan = plan_for(contact, kind);
    plan.own_watchdog.reset();
    for (Fault& first : firsts) {
      first.words.clear();
      if (needs_the_arm[kind.name].contains(first.name)) continue;
      for (const Fault& second : seconds) {
        if (needs_the_arm[kind.name].contains(second.name)) continue;
        const Found found = placed_pairs({first}, {contact.from, 2, 17}, {second}, {1000, 3, 13}, plan, kind.open);
        count(found);
        if (found.stay > 0 || found.without_watchdog > 0)
          add(pairs, first.name + ", then " + second.name, kind.name, cell(found));
      }
    }
  }
  std::printf("\nPairs of faults neither of which needs the arm, but both do:\n\n");
  print(pairs, framed);
  std::printf("\n%ld sessions, %ld of them broke a rule.\n", tried, broken);
  return broken == 0 ? 0 : 1;
}
