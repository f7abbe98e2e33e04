// SPDX-License-Identifier: BSD-3-Clause
// code_rows: reads laws and positions (positions.py) from standard input and prints what the code answers, stage by
// stage, in bits: the rows that model_rows.ml prints of the definitions that Coq's theorems speak of.
//
//   law NAME R w K [= numbers that the law holds]      (the hexadecimal bits of binary32 and binary64)
//   x y z [= status Fx Fz | first Fx Fz contact doubt | second | third]
//
// A line is not read from = on. In the place of a later stage, = is the answer again, and - is a stage that does not exist, or
// of a position that is invalid.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "fast/stage.h"
#include "tests/proofs/members.h"

namespace forceshade::tests {
namespace {

struct Place {
  float x, y, z;
};

std::string bits(float value) {
  char text[16];
  std::snprintf(text, sizeof text, "%x", std::bit_cast<std::uint32_t>(value));
  return text;
}

// A NaN of a first stage that is in doubt has no sign here: that of the processor is negative, and that of Flocq is not.
std::string bits(double value) {
  if (std::isnan(value)) return "nan";
  char text[24];
  std::snprintf(text, sizeof text, "%llx", static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
  return text;
}

std::string words(const std::optional<fast::Evaluation>& answer) {
  if (!answer) return "undecided";
  const char* status = answer->status == Status::free ? "free" : answer->status == Status::contact ? "contact" : "invalid";
  return std::string(status) + ' ' + bits(answer->force.x()) + ' ' + bits(answer->force.z());
}

template <class Definition>
std::string row(const fast::Built<Definition>& law, const Parameters& p, const Place& at) {
  const float x = fast::quantised(at.x), z = fast::quantised(at.z);
  const auto first = law.definition.first_stage(static_cast<double>(x), static_cast<double>(z));
  const std::string answer = words(fast::evaluate(law, p, {at.x, at.y, at.z}));
  const std::string begin = answer + " | " + bits(first.x) + ' ' + bits(first.z) + (first.contact ? " 1" : " 0") +
                            (first.doubt ? " 1" : " 0") + " | ";
  if constexpr (!std::is_base_of_v<fast::Wall, Definition>)
    if (fast::in_domain(at.x) && fast::in_domain(at.y) && fast::in_domain(at.z)) {
      const auto shown = [&](const std::string& later) { return later == answer ? "=" : later; };
      return begin +
             shown(words(
                 fast::decide<fast::DoubleDouble>(law.definition, p, law.kept_geometry(), x, z, fast::Stage::double_double))) +
             " | " + shown(words(fast::evaluate_wide(law.definition, p, x, z)));
    }
  return begin + "- | -";
}

float number(std::istream& in) {
  std::uint32_t value = 0;
  if (!(in >> std::hex >> value)) throw std::runtime_error("expected the hexadecimal bits of a binary32");
  return std::bit_cast<float>(value);
}

// Prints the rows of the law until the next one begins; returns the line of that one.
template <class Definition>
std::string print_rows(const Parameters& p) {
  const fast::Built<Definition> law(p);
  for (const auto& [name, value] : constants_of(law.definition)) std::cout << ' ' << bits(value);
  std::cout << '\n';
  for (std::string line; std::getline(std::cin, line);) {
    if (line.starts_with("law ")) return line;
    if (line.starts_with('#')) continue;
    std::istringstream in(line);
    const float x = number(in), y = number(in), z = number(in);
    std::cout << line.substr(0, line.find(" =")) << " = " << row(law, p, {x, y, z}) << '\n';
  }
  return "";
}

template <class... Definition>
std::string print_rows_of(std::size_t index, const Parameters& p, fast::LawList<Definition...>) {
  std::size_t at = 0;
  std::string next;
  (void)((index == at++ && (next = print_rows<Definition>(p), true)) || ...);
  return next;
}

void run() {
  std::string line;
  while (std::getline(std::cin, line) && !line.starts_with("law ")) continue;
  while (!line.empty()) {
    std::cout << line.substr(0, line.find(" =")) << " =";
    std::istringstream in(line.substr(4));
    std::string name;
    in >> name;
    const auto found = std::ranges::find(kLaws, name, &LawName::name);
    if (found == kLaws.end()) throw std::runtime_error("expected the name of a law, got " + name);
    Parameters p;
    p.radius = number(in), p.width = number(in), p.stiffness = number(in);
    line = print_rows_of(static_cast<std::size_t>(found - kLaws.begin()), p, fast::Laws{});
  }
}

}  // namespace
}  // namespace forceshade::tests

int main() {
  try {
    forceshade::tests::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "code_rows: %s\n", error.what());
    return 2;
  }
}
