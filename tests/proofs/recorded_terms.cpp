// SPDX-License-Identifier: BSD-3-Clause
// Prints proofs/recorded/Recorded.v: the values of double-double's operations, and the first stage of every law as its header has it, as
// a function of the numbers that the law holds. The headers' own templates run on numbers that write down what is done with
// them (tests/proofs/written_number.h).

#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "tests/proofs/members.h"
#include "tests/proofs/written_number.h"

namespace forceshade::tests {
namespace {

// Each constant has another significand, and none is 0, in either of two bumps.
constexpr Parameters kBumps[] = {{530.3F, 0.71F, 0.7F}, {812.7F, 0.931F, 0.33F}};

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
         wrapped(writing.lines()) + "  {| " + result + " |}.\n";
}

template <class Definition>
void print(const std::string& name) {
  const std::string text = definition_of<Definition>(name, kBumps[0]);
  if (text != definition_of<Definition>(name, kBumps[1]))
    throw std::runtime_error(name + ": two bumps give two definitions:\n" + text + definition_of<Definition>(name, kBumps[1]));
  std::printf("\n(* fast/laws/%s.h *)\n%sDefinition %s_window : Z := %d.  (* doubt_window(kErrorBound) *)\n", name.c_str(),
              text.c_str(), name.c_str(), fast::doubt_window(Definition::kErrorBound));
}

// Two terms as a function of numbers with these names.
template <class Function>
void print_terms(const std::string& name, const std::vector<std::string>& arguments, const Function& function) {
  Writing writing;
  std::vector<Written> variables;
  std::string names;
  for (const std::string& argument : arguments) {
    variables.push_back(Written::variable(argument));
    names += argument + " ";
  }
  const fast::Terms<Written> terms = function(variables);
  std::string result = writing.write(terms.hi.node());
  result += ", " + writing.write(terms.lo.node());
  std::printf("Definition %s (%s: binary64) : binary64 * binary64 :=\n%s  (%s).\n", name.c_str(), names.c_str(),
              wrapped(writing.lines()).c_str(), result.c_str());
}

void print_numbers() {
  using Numbers = std::vector<Written>;
  using Terms = fast::Terms<Written>;
  const std::vector<std::string> two{"a", "b"}, four{"a_hi", "a_lo", "b_hi", "b_lo"};
  std::puts("\n(* fast/numbers/double_double.h: hi and lo *)");
  print_terms("two_sum", two, [](const Numbers& n) { return fast::two_sum(n[0], n[1]); });
  print_terms("fast_two_sum", two, [](const Numbers& n) { return fast::fast_two_sum(n[0], n[1]); });
  print_terms("two_product", two, [](const Numbers& n) { return fast::two_product(n[0], n[1]); });
  print_terms("sum_of", four, [](const Numbers& n) { return fast::sum_of(Terms{n[0], n[1]}, Terms{n[2], n[3]}); });
  print_terms("product_of", four, [](const Numbers& n) { return fast::product_of(Terms{n[0], n[1]}, Terms{n[2], n[3]}); });
  print_terms("quotient_of", four, [](const Numbers& n) { return fast::quotient_of(Terms{n[0], n[1]}, Terms{n[2], n[3]}); });
  print_terms("square_root_of", {"a_hi", "a_lo"}, [](const Numbers& n) { return fast::square_root_of(Terms{n[0], n[1]}); });
}

template <class... Definition>
void print_all(fast::LawList<Definition...>) {
  std::size_t next = 0;
  (print<Definition>(std::string(kLaws[next++].file)), ...);
}

}  // namespace
}  // namespace forceshade::tests

int main() {
  using namespace forceshade::tests;
  std::puts(
      "(* SPDX-License-Identifier: BSD-3-Clause *)\n"
      "(* Double-double's values and the first stage of each law, as the headers have them. Written by a program,\n"
      "   tests/proofs/recorded_terms.cpp:\n"
      "   ninja -C build/release recorded_terms && build/release/tests/recorded_terms > proofs/recorded/Recorded.v *)\n"
      "From Coq Require Import ZArith Bool.\n"
      "From Flocq Require Import BinarySingleNaN Binary Bits.\n"
      "From Forceshade Require Import Formats Operations.");
  try {
    print_numbers();
    print_all(forceshade::fast::Laws{});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded_terms: %s\n", error.what());
    return 1;
  }
}
