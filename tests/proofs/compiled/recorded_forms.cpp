// SPDX-License-Identifier: BSD-3-Clause
// Prints, for tests/proofs/compiled: where each law's definition lies in a Law, and each of its numbers in the definition; and
// the operations of the form in which a batch evaluates the law, which its templates write down
// (tests/proofs/compiled/written_pack.h). With the argument coq, prints these operations as proofs/recorded/RecordedForms.v instead.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "forceshade/fast.h"
#include "tests/proofs/compiled/written_pack.h"
#include "tests/proofs/members.h"

namespace forceshade::tests {
namespace {

// Each constant has another significand, and none is 0, in either of two bumps.
constexpr Parameters kBump{530.3F, 0.71F, 0.7F}, kOtherBump{812.7F, 0.931F, 0.33F};

// The one place of some bytes in others, a multiple of four.
std::size_t place_of(const void* some, std::size_t size, const void* others, std::size_t whole, const std::string& name) {
  std::size_t found = whole;
  for (std::size_t at = 0; at + size <= whole; at += 4) {
    if (std::memcmp(some, static_cast<const char*>(others) + at, size) != 0) continue;
    if (found != whole) throw std::runtime_error(name + " is in two places");
    found = at;
  }
  if (found == whole) throw std::runtime_error(name + " is in no place");
  return found;
}

using Names = std::vector<std::pair<std::string, double>>;

// The numbers that a form computes of those that its law holds, as the constructors in fast/simd/ do.
template <class Definition>
Names names_of(const Definition& law) {
  Names names;
  if constexpr (requires { law.axis; }) names.emplace_back("(times R R)", law.R * law.R);  // before the anchor, 8R²
  for (const auto& [name, value] : constants_of(law)) names.emplace_back(name, value);
  names.emplace_back("bits64:0x3fc47ae147ae147b", 0.16);
  if constexpr (requires { law.shading; }) {
    names.emplace_back("(times K_over_R R)", law.shading.K_over_R * law.shading.R);
    names.emplace_back("(times R R)", law.shading.R * law.shading.R);
  }
  if constexpr (requires { law.half_top; }) {
    const double from_edge = law.half_width - static_cast<double>(law.half_top);
    const double missing = std::fma(-law.gap.side.slope.head, from_edge, law.gap.top.height) + law.gap.top.height_tail;
    names.emplace_back(
        "(over (plus (fused (opp side_slope) (minus half_width half_top) top_height) top_height_tail)"
        " (minus half_width half_top))",
        missing / from_edge);
  }
  if constexpr (requires { law.axis; }) {
    const double square = law.R * law.R;
    names.emplace_back("(minus (times R R) (widened (rounded (times R R))))",
                       square - static_cast<double>(static_cast<float>(square)));
    names.emplace_back("(times (times bits64:0x3fc47ae147ae147b R) R)", 0.16 * law.R * law.R);
    names.emplace_back("(over (times (two_to (-1)) K) (times R R))", 0.5 * law.K / square);
    names.emplace_back("(square_root (plus (minus anchored anchor) rest))", std::sqrt((law.anchored - law.anchor) + law.rest));
  }
  return names;
}

// The text whose number is this one; zero if it is 0.
template <class Number>
std::string text_of(Number value, const std::vector<std::pair<std::string, Number>>& texts) {
  for (const auto& [text, known] : texts)
    if (value == known) return text;
  if (value == 0) return "zero64";
  throw std::runtime_error("a form's least number is none that is known");
}

template <class Definition>
std::string least_coordinate(const Definition& law, float value) {
  const std::string quantum = "bits32:0x30800000";
  std::vector<std::pair<std::string, float>> texts{{quantum, fast::kPositionQuantum}};
  const auto larger = [&](double scale, const std::string& scale_text, double number, const std::string& text) {
    const auto other = static_cast<float>(scale * number);
    texts.emplace_back("(greatest32 " + quantum + " (rounded (times " + scale_text + " " + text + ")))",
                       std::max(fast::kPositionQuantum, other));
  };
  if constexpr (requires { law.half_width; }) larger(0x1p-28, "(two_to (-28))", law.half_width, "half_width");
  if constexpr (requires { law.axis; }) {
    const double half = std::sqrt((law.anchored - law.anchor) + law.rest);
    larger(0x1p-27, "(two_to (-27))", std::max(half, law.d.head),
           "(greatest (square_root (plus (minus anchored anchor) rest)) d_head)");
  }
  return text_of(value, texts);
}

template <class Definition>
std::string least_distance(const Definition& law, double value) {
  std::vector<std::pair<std::string, double>> texts;
  for (const auto& [name, height] : constants_of(law))
    if (name == "height" || name == "side_height") texts.emplace_back("(times (two_to (-20)) " + name + ")", 0x1p-20 * height);
  if constexpr (requires { law.axis; }) texts.emplace_back("(times (times (two_to (-24)) R) R)", 0x1p-24 * law.R * law.R);
  return text_of(value, texts);
}

// A form as it is written down.
struct WrittenForm {
  int window;
  std::string lines;                                         // its operations, each a name
  std::vector<std::pair<std::string, std::string>> results;  // forces and what is watched, by name
  std::string least_coordinate, least_distance;

  bool operator==(const WrittenForm&) const = default;
};

// The form's operations, the same at all six positions.
template <class Definition>
WrittenForm form_of(const Definition& law) {
  constexpr std::size_t kPositions = 3 * fast::Floats::kLanes;
  static_assert(std::bit_cast<std::uint32_t>(fast::kPositionQuantum) == 0x30800000);
  Writing writing;
  WrittenRun run;
  for (const auto& [text, value] : names_of(law)) writing.name(value, text);
  float x[kPositions], z[kPositions], fx[kPositions], fz[kPositions];
  for (std::size_t i = 0; i < kPositions; ++i) {
    run.stored[&x[i]] = writing.node("x");
    run.stored[&z[i]] = writing.node("z");
  }
  answer(typename fast::FormOf<Definition>::Type(law), kPositions, x, z, fx, fz);
  for (std::size_t i = 0; i < kPositions; ++i)
    if (run.stored.at(&fx[i]) != run.stored.at(&fx[0]) || run.stored.at(&fz[i]) != run.stored.at(&fz[0]))
      throw std::runtime_error("two positions have two forms");
  WrittenForm form{run.window, "", {}, least_coordinate(law, run.least_coordinate), least_distance(law, run.least_distance)};
  for (const auto& [name, node] : {std::pair{"force_x", run.stored.at(&fx[0])}, std::pair{"force_z", run.stored.at(&fz[0])}})
    form.results.emplace_back(name, writing.write(node));
  for (const auto& [hazard, node] : run.watched) form.results.emplace_back(hazard, writing.write(node));
  form.lines = writing.lines();
  return form;
}

void print(const WrittenForm& form) {
  std::printf("form %d\n%s", form.window, form.lines.c_str());
  for (const auto& [name, term] : form.results) std::printf("%s %s\n", name.c_str(), term.c_str());
  std::printf("least_coordinate %s\nleast_distance %s\n", form.least_coordinate.c_str(), form.least_distance.c_str());
}

// A text of a form in the language of Coq, which has names for the two constants that are written as bits.
std::string in_coq(std::string text) {
  for (const auto& [bits, name] : {std::pair<std::string, std::string>{"bits64:0x3fc47ae147ae147b", "sixteen_hundredths"},
                                   std::pair<std::string, std::string>{"bits32:0x30800000", "quantum"}})
    for (std::size_t at; (at = text.find(bits)) != std::string::npos;) text.replace(at, bits.size(), name);
  return text;
}

template <class Definition>
void print_in_coq(const LawName& law) {
  const Definition definition = fast::Built<Definition>(kBump).definition;
  const WrittenForm form = form_of(definition);
  if (form != form_of(fast::Built<Definition>(kOtherBump).definition)) throw std::runtime_error("two bumps have two forms");
  std::string text = "\nDefinition " + std::string(law.file) + "_form\n    (";
  for (const auto& [name, value] : constants_of(definition)) text += name + " ";
  text += ": binary64)\n    (x z : binary32) : Lane :=\n" + form.lines + "  {| ";
  for (const auto& [name, term] : form.results)
    if (name.starts_with("force_")) text += name + " := " + term + "; ";
  for (const auto& [hazard, field] :
       {std::pair{"domain", "sizes"}, std::pair{"tiny", "not_tiny"}, std::pair{"distance", "distances"},
        std::pair{"doubt", "doubts"}, std::pair{"rounding", "roundings"}}) {
    std::string terms;
    for (const auto& [name, term] : form.results)
      if (name == hazard) terms += (terms.empty() ? "" : "; ") + term;
    text += std::string(field) + " := [" + terms + "]; ";
  }
  text += "lane_window := " + std::to_string(form.window) + ";\n     least_coordinate := " + form.least_coordinate +
          ";\n     least_distance := " + form.least_distance + " |}.\n";
  std::printf("%s", tests::wrapped(in_coq(std::move(text))).c_str());
}

template <class Definition>
void print(const LawName& law) {
  const fast::Built<Definition> built(kBump);
  const auto whole = fast::Law::build(law.id, kBump);
  const std::string law_file(law.file);
  std::size_t end = 0;
  std::string places;
  for (const auto& [name, value] : constants_of(built.definition)) {
    const auto narrow = static_cast<float>(value);
    const bool is_narrow = name == "half_top";  // the only binary32 that a law holds
    const std::size_t size = is_narrow ? sizeof narrow : sizeof value;
    const std::size_t at = place_of(is_narrow ? static_cast<const void*>(&narrow) : &value, size, &built.definition,
                                    sizeof built.definition, law_file + " " + name);
    end = std::max(end, at + size);
    places += "place " + name + " " + std::to_string(size) + " " + std::to_string(at) + "\n";
  }
  const std::size_t in_law = place_of(&built.definition, end, &std::get<fast::Law>(whole), sizeof(fast::Law), law_file);
  std::printf("law %s %zu\n%s", law_file.c_str(), in_law, places.c_str());
  print(form_of(built.definition));
}

// The one byte of a Law, behind its id, that is the law's number in each of them.
std::size_t place_of_number() {
  std::size_t found = 0;
  for (std::size_t at = sizeof(LawId); at < sizeof(fast::Law); ++at) {
    const auto holds_number = [at](const LawName& name) {
      const auto law = fast::Law::build(name.id, kBump);
      return reinterpret_cast<const unsigned char*>(&std::get<fast::Law>(law))[at] == static_cast<unsigned char>(name.id);
    };
    if (!std::all_of(kLaws.begin(), kLaws.end(), holds_number)) continue;
    if (found != 0) throw std::runtime_error("a law's number is in two places");
    found = at;
  }
  if (found == 0) throw std::runtime_error("a law's number is in no place");
  return found;
}

template <class... Definition>
void print_all_in_coq(fast::LawList<Definition...>) {
  std::puts(
      "(* SPDX-License-Identifier: BSD-3-Clause *)\n"
      "(* The form in which a batch evaluates each law, at one position, with what its watch looks at: fast/simd/, run on "
      "packs that\n"
      "   write down what is done with them. Written by a program, tests/proofs/compiled/recorded_forms.cpp:\n"
      "   ninja -C build/release recorded_forms && build/release/tests/recorded_forms coq > proofs/recorded/RecordedForms.v *)\n"
      "From Coq Require Import ZArith List Bool.\n"
      "From Flocq Require Import BinarySingleNaN Binary Bits.\n"
      "From Forceshade Require Import Formats Comparisons Operations SecondAlong Lanes.\n"
      "Import ListNotations.");
  std::size_t next = 0;
  (print_in_coq<Definition>(kLaws[next++]), ...);
}

template <class... Definition>
void print_all(fast::LawList<Definition...>) {
  std::printf("number %zu\n", place_of_number());
  std::size_t next = 0;
  (print<Definition>(kLaws[next++]), ...);
}

}  // namespace
}  // namespace forceshade::tests

int main(int count, char** words) {
  try {
    if (count > 1 && std::string(words[1]) == "coq") {
      forceshade::tests::print_all_in_coq(forceshade::fast::Laws{});
    } else {
      forceshade::tests::print_all(forceshade::fast::Laws{});
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded_forms: %s\n", error.what());
    return 1;
  }
}
