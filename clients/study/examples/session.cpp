// SPDX-License-Identifier: BSD-3-Clause
// A session of one's own protocol, with keys read as lines: session PROTOCOL CERTIFICATES DEVICE FOLDER.
#include <cstdio>
#include <exception>
#include <iostream>

#include "study/apparatus/apparatus.h"

using namespace forceshade;

// Each line is one press: j, k and l make the bump smaller, bigger and done, an empty line is enter, others are typed.
struct Lines final : apparatus::Front {
  bool show(const experiments::Screen& screen, const std::optional<device::Sample>&, const experiments::Scene&) override {
    std::printf("%s: %s\n", screen.title.c_str(), screen.entry.c_str());
    is_matching = screen.kind == experiments::ScreenKind::matching;
    return static_cast<bool>(std::cin);
  }
  std::vector<experiments::Press> presses() override {
    using enum experiments::Action;
    std::string line;
    if (!std::getline(std::cin, line)) return {};
    if (line.empty()) return {{enter}};
    if (!is_matching) return {{type, line}};
    return {{line == "j" ? smaller : line == "k" ? bigger : done}};
  }
  bool waits_at_the_end() const override { return false; }
  bool is_matching = false;
};

int main(int argc, char** argv) try {
  if (argc != 5) return std::puts("usage: session PROTOCOL CERTIFICATES DEVICE FOLDER"), 2;
  const auto device = device::open_device(argv[3]);
  Lines lines;
  const apparatus::SessionPlan plan{
      .session = argv[4], .protocol = argv[1], .participant = "P01", .certificates = argv[2], .device = argv[3]};
  const std::atomic<bool> stop = false;
  const apparatus::Outcome outcome = apparatus::run_session(plan, *device, lines, stop);
  return std::puts(outcome.is_over ? "every trial is done" : "the session can go on"), outcome.is_over ? 0 : 1;
} catch (const std::exception& error) {
  return std::printf("refused: %s\n", error.what()), 1;
}
