// SPDX-License-Identifier: BSD-3-Clause
// Prints proofs/recorded/RecordedStages.v: what the headers of fast/ do behind a first stage, and what the constructors of laws compute.
// They run with numbers that write down what is done with them (tests/proofs/written_headers.h). So a definition is what its
// header does, in its types, by every way through it.

#include <array>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "tests/proofs/written_headers.h"

namespace forceshade::tests {
namespace {

using Second = Ball<0>;

Written64 number64(const std::string& name) {
  return Written64::of(written(name));
}
Written32 number32(const std::string& name) {
  return Written32::of(written(name));
}
WrittenParameters bump() {
  return {number32("R"), number32("w"), number32("K")};
}

// A definition, of what the code gives.
void define(const std::string& name, const std::string& arguments, const std::string& type, const std::function<Node()>& code) {
  Writing writing;
  const std::string result = writing.write(Way::tree(code));
  std::printf("Definition %s %s : %s :=\n%s  %s.\n", name.c_str(), arguments.c_str(), type.c_str(),
              wrapped(writing.lines()).c_str(), result.c_str());
}

Node sign_node(fast::Sign sign) {
  const char* const names[] = {"is_negative", "is_zero", "is_positive", "is_unknown"};
  return written(names[static_cast<int>(sign)]);
}
Node rounded_node(const std::optional<Written32>& rounded) {
  return rounded ? written("Some %", {rounded->node()}) : written("None");
}
template <class N>
Node outcome_node(const fast::Outcome<N>& outcome) {
  return written("(%, %, %)", {sign_node(outcome.contact), outcome.x.node(), outcome.z.node()});
}

// ---- Double-double ----

using Whole = fast::WholeDoubleDouble;
Whole whole(const std::string& name) {
  return {number64("(hi " + name + ")"), number64("(lo " + name + ")"), number64("(error " + name + ")")};
}
Node node_of(const Whole& a) {
  return written("{| hi := %; lo := %; error := % |}", {a.hi.node(), a.lo.node(), a.error.node()});
}
void print_double_double() {
  std::puts("\n(* fast/numbers/double_double.h *)");
  const std::string one = "(a : double_double)", two = "(a b : double_double)", result = "double_double";
  define("exactly_dd", "(v : binary64)", result, [] { return node_of(Whole::exactly(number64("v"))); });
  define("minus_dd", one, result, [] { return node_of(-whole("a")); });
  define("sum_dd", two, result, [] { return node_of(whole("a") + whole("b")); });
  define("difference_dd", two, result, [] { return node_of(whole("a") - whole("b")); });
  define("product_dd", two, result, [] { return node_of(whole("a") * whole("b")); });
  define("quotient_dd", two, result, [] { return node_of(whole("a") / whole("b")); });
  define("root_dd", one, result, [] { return node_of(square_root(whole("a"))); });
  define("midpoint_dd", one, result, [] { return node_of(midpoint(whole("a"))); });
  define("truncated_dd", one, result, [] { return node_of(truncated(whole("a"), 100)); });
  define("widened_dd", one, result, [] { return node_of(widened(whole("a"), -40)); });
  define("approximation_dd", one, "binary64", [] { return approximately(whole("a")).node(); });
  define("sign_dd", one, "Sign", [] { return sign_node(sign(whole("a"))); });
}

// ---- What laws share ----

template <std::size_t kLimbs>
void print_newton() {
  static const int steps = Ball<kLimbs>::kNewtonSteps;
  const std::string by = "_by_" + std::to_string(steps);
  define("newton_root" + by, "(value slope : number -> number) (start : binary64)", "number", [] {
    using N = Ball<3>;
    const auto f = [](const N& y) { return N::of(written("value %", {y.node()})); };
    const auto derivative = [](const N& y) { return N::of(written("slope %", {y.node()})); };
    return fast::newton_root<N>(number64("start"), steps, f, derivative).node();
  });
  define("sine_of_third" + by, "(R w : binary32)", "number",
         [] { return fast::sine_of_third<Ball<kLimbs>>(number32("R"), number32("w")).node(); });
}

void print_shared() {
  std::puts("\n(* fast/domain.h *)");
  define("in_domain_recorded", "(x : binary32)", "bool", [] { return fast::whole_in_domain(number32("x")).node(); });
  define("quantised_recorded", "(x : binary32)", "binary32", [] { return fast::whole_quantised(number32("x")).node(); });
  std::puts(
      "\n(* fast/numbers/first_stage.h: operations that first stages use, and the rounding test for each window of a law *)");
  const std::string two = "(a b : binary64)", three = "(a b c : binary64)", result = "binary64";
  const auto a = [] { return number64("a"); };
  const auto b = [] { return number64("b"); };
  const auto c = [] { return number64("c"); };
  define("larger_recorded", two, result, [&] { return fast::larger(a(), b()).node(); });
  define("select_recorded", "(yes : bool) (a b : binary64)", result,
         [&] { return fast::select(WrittenBool::of(written("yes")), a(), b()).node(); });
  define("absolute_recorded", "(a : binary64)", result, [&] { return fast::absolute(a()).node(); });
  define("square_root_recorded", "(a : binary64)", result, [&] { return fast::square_root(a()).node(); });
  define("multiply_add_recorded", three, result, [&] { return fast::multiply_add(a(), b(), c()).node(); });
  define("multiply_subtract_recorded", three, result, [&] { return fast::multiply_subtract(a(), b(), c()).node(); });
  define("in_doubt_0", "(v : binary64)", "bool", [] { return fast::whole_rounding_is_in_doubt<0>(number64("v")).node(); });
  define("in_doubt_9", "(v : binary64)", "bool", [] { return fast::whole_rounding_is_in_doubt<9>(number64("v")).node(); });
  define("in_doubt_13", "(v : binary64)", "bool", [] { return fast::whole_rounding_is_in_doubt<13>(number64("v")).node(); });
  define("in_doubt_19", "(v : binary64)", "bool", [] { return fast::whole_rounding_is_in_doubt<19>(number64("v")).node(); });
  std::puts("\n(* fast/laws/top_edge.h *)");
  define("exact_sign_recorded", "(a b c d e f g h : binary64)", "Z", [] {
    std::array<Written64, 8> terms;
    for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = number64(std::string(1, static_cast<char>('a' + i)));
    return written("(" + std::to_string(fast::exact_sign<8>(terms)) + ")%Z");
  });
  define("is_on_top_recorded", "(c R w : binary32)", "bool",
         [] { return fast::is_on_top(number32("c"), number32("R"), number32("w")).node(); });
  define("largest_on_top_recorded", "(R w : binary32) (half_top : double_double)", "binary32",
         [] { return fast::whole_largest_on_top(number32("R"), number32("w"), Second::of(written("half_top"))).node(); });
  std::puts("\nSection Ball.\nContext {number : Type} (N : ball number).");
  std::puts("\n(* fast/numbers/ball.h *)");
  define("nearest_recorded", "(value : number)", "option binary32",
         [] { return rounded_node(fast::round_to_binary32<Second>(Second::of(written("value")))); });
  std::puts("\n(* fast/laws/bump_geometry.h: Newton's method with one step, and with seven *)");
  print_newton<1>();
  print_newton<2>();
}

// ---- A law ----

template <class Definition>
void print_exact(const std::string& name) {
  define(name + "_exact", "(t : number) (half_top R w K x z : binary32)", "Sign * number * number", [] {
    const WrittenParameters p = bump();
    Definition law = fast::Built<Definition>(p).definition;
    if constexpr (requires { law.half_top; }) law.half_top = number32("half_top");
    const auto geometry = [&p] { return Definition::template geometry<Second>(p); };
    return outcome_node(law.template exact<Second>(p, geometry, number32("x"), number32("z")));
  });
}
template <class Definition>
void print_members(const std::string& name) {
  define(name + "_members", "(R w K : binary32) (t : double_double)", "list binary64", [] {
    std::string text;
    std::vector<Node> nodes;
    for (const auto& member : constants_of(fast::Built<Definition>(bump()).definition)) {
      text += text.empty() ? "[%" : "; %";
      nodes.push_back(member.second.node());
    }
    return written(text + "]", nodes);
  });
  std::printf("Definition %s_limbs : nat := %zu.\n", name.c_str(), Definition::kWideLimbs);
}

template <class... Definition>
void print_laws(fast::LawList<Definition...>) {
  std::puts("\n(* exact() of each law; t is sine_of_third. *)");
  std::size_t next = 0;
  (print_exact<Definition>(std::string(kLaws[next++].file)), ...);
  std::puts(
      "End Ball.\n\n(* The members of each law for its first stage, and the limbs of its third. *)\nLocal Notation N := "
      "two_terms.");
  next = 0;
  (print_members<Definition>(std::string(kLaws[next++].file)), ...);
}

// ---- evaluate() of any law ----

struct AnyLaw {
  static constexpr Written64 kErrorBound = 0x1p-50;
  static constexpr std::size_t kWideLimbs = 2;
  template <class N>
  using Geometry = N;
  template <class N>
  static N geometry(const WrittenParameters&) {
    return N::of(written(std::is_same_v<N, Second> ? "kept" : "made"));
  }
  AnyLaw(const WrittenParameters&, const Second&) {}

  fast::FirstStage<Written64> first_stage(const Written64& x, const Written64& z) const {
    const Node first = written("first % %", {x.node(), z.node()});
    return {Written64::of(written("first_x %", {first})), Written64::of(written("first_z %", {first})),
            WrittenBool::of(written("first_contact %", {first})), WrittenBool::of(written("first_doubt %", {first}))};
  }
  template <class N, class GeometryOf>
  fast::Outcome<N> exact(const WrittenParameters&, const GeometryOf& geometry, const Written32& x, const Written32& z) const {
    const Node found =
        written(std::is_same_v<N, Second> ? "second % % %" : "third % % %", {geometry().node(), x.node(), z.node()});
    return {sign_by(written("fst (fst %)", {found})), N::of(written("snd (fst %)", {found})), N::of(written("snd %", {found}))};
  }
};

void print_evaluate() {
  std::puts("\n(* fast/evaluate.h, for any law, with the arithmetic that decides: 0 binary64, 1 double-double, 2 limbs *)");
  Ball<2>::in = "M";
  define("evaluate_recorded",
         "{number wide geometry : Type} (N : ball number) (M : ball wide) (window : Z)\n"
         "    (first : binary64 -> binary64 -> FirstStage) (kept made : geometry)\n"
         "    (second : geometry -> binary32 -> binary32 -> Sign * number * number)\n"
         "    (third : geometry -> binary32 -> binary32 -> Sign * wide * wide) (x y z : binary32)",
         "Z * evaluation", [] {
           const WrittenParameters p = bump();
           const auto answer = fast::evaluate(fast::Built<AnyLaw>(p), p, {{number32("x"), number32("y"), number32("z")}});
           const char* const statuses[] = {"free", "contact", "invalid"};
           return written("(%, (%, (%, %, %)))", {written(std::to_string(static_cast<int>(answer.stage)) + "%Z"),
                                                  written(statuses[static_cast<int>(answer.status)]), answer.force.x().node(),
                                                  answer.force.y().node(), answer.force.z().node()});
         });
}

}  // namespace
}  // namespace forceshade::tests

int main() {
  using namespace forceshade::tests;
  std::puts(
      "(* SPDX-License-Identifier: BSD-3-Clause *)\n"
      "(* The work of the headers of fast/ behind a first stage, and the members of laws, branch by branch. Written by a "
      "program,\n"
      "   tests/proofs/recorded_stages.cpp:\n"
      "   ninja -C build/release recorded_stages && build/release/tests/recorded_stages > proofs/recorded/RecordedStages.v *)\n"
      "From Coq Require Import ZArith List Bool.\n"
      "From Flocq Require Import BinarySingleNaN Binary Bits.\n"
      "From Forceshade Require Import Formats Comparisons Operations Recorded RoundingTest Depth Split NewtonRounded ExactSign "
      "TopEdge\n"
      "  Evaluate BesideTie SecondAlong Balls.\n"
      "Import ListNotations.");
  try {
    print_double_double();
    print_shared();
    print_laws(forceshade::fast::Laws{});
    print_evaluate();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded_stages: %s\n", error.what());
    return 1;
  }
}
