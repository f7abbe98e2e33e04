// SPDX-License-Identifier: BSD-3-Clause
// Prints proofs/Recorded.v: the first stage of every law as its header has it, as a function of the numbers that the law holds.
// The headers' own templates run on numbers that write down what is done with them (tests/proofs/written_number.h).

#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "tests/proofs/written_number.h"

namespace forceshade::tests {
namespace {

// The text of a constant by its value. Each has another significand, and none is 0, in either of two bumps.
using Constants = std::vector<std::pair<std::string, double>>;
constexpr Parameters kBumps[] = {{530.3F, 0.71F, 0.7F}, {812.7F, 0.931F, 0.33F}};

Constants constants_of(const fast::Wall& law) {
  return {{"K", law.K}};
}
Constants constants_of(const fast::Cylinder& law) {
  return {{"K", law.K},       {"R", law.R},           {"anchor", law.anchor}, {"anchored", law.anchored},
          {"rest", law.rest}, {"d_head", law.d.head}, {"d_tail", law.d.tail}, {"axis", law.axis}};
}
Constants constants_of(const fast::Shading& law) {
  return {{"R", law.R}, {"K_over_R", law.K_over_R}};
}
Constants constants_of(const fast::LinearGap& law, const std::string& prefix = "") {
  Constants all{{prefix + "height", law.height}, {prefix + "height_tail", law.height_tail}};
  if (law.slope.head != 0) all.insert(all.end(), {{prefix + "slope", law.slope.head}, {prefix + "slope_tail", law.slope.tail}});
  return all;
}
Constants constants_of(const fast::ThreePolygonGap& law) {
  Constants all = constants_of(law.top, "top_");
  for (const auto& constant : constants_of(law.side, "side_")) all.push_back(constant);
  return all;
}

// Those that a law holds beside what it is made of.
Constants and_these(Constants all, const Constants& others) {
  all.insert(all.end(), others.begin(), others.end());
  return all;
}
Constants constants_of(const fast::Bump1pShaded& law) {
  return and_these(constants_of(law.shading), {{"half_width", law.half_width}});
}
Constants constants_of(const fast::Bump2p& law) {
  return and_these(constants_of(law.gap),
                   {{"K", law.K}, {"K_sine", law.K_sine}, {"K_cosine", law.K_cosine}, {"half_width", law.half_width}});
}
Constants constants_of(const fast::Bump2pShaded& law) {
  return and_these(and_these(constants_of(law.gap), constants_of(law.shading)), {{"half_width", law.half_width}});
}
Constants constants_of(const fast::Bump3p& law) {
  return and_these(constants_of(law.gap), {{"K", law.K},
                                           {"K_sine", law.K_sine},
                                           {"K_cosine", law.K_cosine},
                                           {"half_width", law.half_width},
                                           {"half_top", static_cast<double>(law.half_top)}});
}
Constants constants_of(const fast::Bump3pShaded& law) {
  return and_these(and_these(constants_of(law.gap), constants_of(law.shading)),
                   {{"half_width", law.half_width}, {"half_top", static_cast<double>(law.half_top)}});
}

template <class Definition>
std::string definition_of(const std::string& name, const Parameters& bump) {
  const Definition law = fast::Built<Definition>(bump).definition;
  Writing writing;
  std::string arguments;
  for (const auto& [text, value] : constants_of(law)) {
    writing.name(value, text);
    arguments += text + " ";
  }
  const auto first = law.first_stage(Written::variable("x"), Written::variable("z"));
  std::string result;
  for (const auto& [field, node] :
       {std::pair{"first_x := ", first.x.node()}, std::pair{"; first_z := ", first.z.node()},
        std::pair{"; first_contact := ", first.contact.node}, std::pair{"; first_doubt := ", first.doubt.node}})
    result += field + writing.write(node);
  return "Definition " + name + " (is_fused : bool)\n    (" + arguments + "x z : binary64) : FirstStage :=\n" +
         writing.lines() + "  {| " + result + " |}.\n";
}

template <class Definition>
void print(const std::string& name) {
  const std::string text = definition_of<Definition>(name, kBumps[0]);
  if (text != definition_of<Definition>(name, kBumps[1]))
    throw std::runtime_error(name + ": two bumps give two definitions:\n" + text + definition_of<Definition>(name, kBumps[1]));
  std::printf("\n(* fast/laws/%s.h *)\n%sDefinition %s_window : Z := %d.  (* doubt_window(kErrorBound) *)\n", name.c_str(),
              text.c_str(), name.c_str(), fast::doubt_window(Definition::kErrorBound));
}

}  // namespace
}  // namespace forceshade::tests

int main() {
  using namespace forceshade::tests;
  namespace fast = forceshade::fast;
  std::puts(
      "(* SPDX-License-Identifier: BSD-3-Clause *)\n"
      "(* The first stage of each law, as its header has it. Written by a program (tests/proofs/recorded_terms.cpp):\n"
      "   ninja -C build/release recorded_terms && build/release/tests/recorded_terms > proofs/Recorded.v *)\n"
      "From Coq Require Import ZArith Bool.\n"
      "From Flocq Require Import BinarySingleNaN Binary Bits.\n"
      "From Forceshade Require Import Formats Operations.");
  try {
    print<fast::Wall>("wall");
    print<fast::Cylinder>("cylinder");
    print<fast::BumpCylinder>("bump_cylinder");
    print<fast::Bump1p>("bump_1p");
    print<fast::Bump2p>("bump_2p");
    print<fast::Bump3p>("bump_3p");
    print<fast::Bump1pShaded>("bump_1p_shaded");
    print<fast::Bump2pShaded>("bump_2p_shaded");
    print<fast::Bump3pShaded>("bump_3p_shaded");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded_terms: %s\n", error.what());
    return 1;
  }
}
