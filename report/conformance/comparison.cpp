// SPDX-License-Identifier: BSD-3-Clause
#include "report/conformance/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "certificate/json_fields.h"
#include "files/printable.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/simulators/conform_simulator.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

using properties::Fields;

// The parts of a report that are compared.
struct Report {
  std::string who;
  std::vector<std::pair<std::string, std::string>> run;  // by what the two must agree in
  std::string outcome;                                   // "judged", or why not
  std::uint64_t answers = 0;                             // that were judged
  std::map<std::string, double> errors;                  // the larger, the worse
  struct Invariant {
    std::string result, violation;
    std::optional<double> share;  // the largest deviation over the allowed one
  };
  std::map<std::string, Invariant> invariants;
  std::string declared, forceshade, timing, allocations;
};

constexpr const char kHeld[] = "held", kFailed[] = "FAILED", kNotTried[] = "not tried";

// The factor by which a deviation must differ to be reported: of a violation, and of what is held. A share of what is allowed
// that is smaller than kLeastShare is often rounding alone.
constexpr double kOtherViolation = 1.01, kOtherDeviation = 2, kLeastShare = 0.01;

std::string shown(double value) {
  if (std::isinf(value)) return "no finite force";
  return value == std::floor(value) && value < 0x1p53 ? std::to_string(static_cast<std::uint64_t>(value)) : digits(value, 6);
}

// The size of the error of a worst case; 0 where there is no such case.
double error_in(Fields& exact, const char* worst, const char* unit) {
  if (!exact.has(worst)) return 0;
  Fields its = exact.object(worst);
  return its.has(unit) ? its.number(unit) : HUGE_VAL;
}

void read_counts(Report& report, Fields counts, const std::string& of) {
  const std::uint64_t cases = counts.count("cases");
  for (const auto& [key, what] : {std::pair("wrong", "answers that are not correctly rounded"),
                                  std::pair("beyond_tolerance", "answers beyond the tolerance")}) {
    const std::uint64_t count = counts.count(key);
    counts.expect(key, count <= cases, "no more than there are cases");
    report.errors[what + of] = static_cast<double>(count);
  }
  if (of.empty()) report.answers = cases;
}

void read_exact(Report& report, Fields exact) {
  report.run.emplace_back("kind", exact.text("kind"));
  report.run.emplace_back("name", exact.text("name"));
  report.run.emplace_back("digest", exact.text("digest"));
  report.run.emplace_back("parameters", exact.any("parameters").dump(-1, ' ', true));
  report.run.emplace_back("tolerance", exact.text("tolerance"));
  read_counts(report, exact.object("all"), "");
  if (exact.has("by_aim")) {
    Fields aims = exact.object("by_aim");
    for (const std::string& aim : aims.keys())
      read_counts(report, aims.object(aim.c_str()), ", aimed at " + files::printable(aim));
  }
  report.errors["the largest error in ulp"] = error_in(exact, "worst_in_ulp", "ulp");
  report.errors["the largest error in N"] = error_in(exact, "worst_in_newton", "newton");
}

void read_invariants(Report& report, Fields& fields) {
  for (Fields& one : fields.objects("invariants")) {
    const std::string name = one.text("name");
    Report::Invariant its{kNotTried, "", {}};
    if (one.flag("applicable")) its.result = one.flag("held") ? kHeld : kFailed;
    if (one.has("share_of_allowed"))
      its.share = one.any("share_of_allowed").is_null() ? HUGE_VAL : one.number("share_of_allowed");
    if (one.has("violation")) its.violation = one.text("violation", true);
    if (!report.invariants.emplace(name, its).second) throw Error("the invariant \"" + name + "\" stands twice in it");
  }
}

// Reads what only the report of a renderer has.
void read_renderer(Report& report, Fields& fields) {
  report.run.emplace_back("seed", std::to_string(fields.count("seed")));
  report.run.emplace_back("points", std::to_string(fields.count("points")));
  read_exact(report, fields.object("exact"));
  if (!fields.flag("applicable")) report.outcome = "not applicable";
  if (!fields.has("timing")) return;
  Fields timing = fields.object("timing");
  for (const auto& [key, words] :
       {std::pair("p50_s", "half within "), {"p99_9_s", ", 99.9 % within "}, {"worst_s", ", the slowest "}})
    report.timing += words + words_of_time(timing.number(key));
  if (timing.has("allocations_per_answer"))
    report.allocations = words_of(Allocations{timing.number("allocations_per_answer"), timing.number("bytes_per_answer")});
}

Report report_from(std::string_view text, const std::string& file) {
  try {
    const nlohmann::json json = properties::json_from(text);
    Fields fields(json, "");
    const std::string schema = fields.text("schema");
    const bool is_simulator = schema == simulators::kSimulatorSchema;
    fields.expect("schema", is_simulator || schema == kConformanceSchema,
                  std::string("\"") + kConformanceSchema + "\" or \"" + simulators::kSimulatorSchema + '"');
    Report report;
    Fields who = fields.object(is_simulator ? "simulator" : "renderer");
    report.who = files::printable(who.text("name", true) + ' ' + who.text("version", true) + " (" + file + ')');
    report.declared = (is_simulator ? fields.any("capabilities") : fields.any("renderer")).dump(-1, ' ', true);
    report.forceshade = fields.text("forceshade");
    report.run = {{"schema", schema}};
    report.outcome = fields.has("failure") ? "ended early: " + fields.text("failure", true) : "judged";
    if (!is_simulator) read_renderer(report, fields);
    read_invariants(report, fields);
    const bool has_failed = report.outcome != "judged" || std::ranges::any_of(report.invariants, [](const auto& each) {
                              return each.second.result == kFailed;
                            });
    fields.expect("held", !(fields.flag("held") && has_failed), "false where the run ended early or an invariant failed");
    return report;
  } catch (const Error& error) {
    throw Error(file + ": expected what 'forceshade conform --json' writes: " + error.what());
  }
}

void expect_same_run(const Report& a, const std::string& before, const Report& b, const std::string& after) {
  using Entry = std::pair<std::string, std::string>;
  const auto [of_a, of_b] = std::ranges::mismatch(a.run, b.run, {}, &Entry::second, &Entry::second);
  if (of_a == a.run.end()) return;
  throw Error(after + ": expected a run as that of " + before + ", whose " + of_a->first + " is " + of_a->second + ", got " +
              of_b->second);
}

class Comparer {
 public:
  Comparer(const Report& before, const Report& after) : a_(before), b_(after) {}

  std::vector<Change> changes() {
    compare_outcomes();
    if (a_.answers == b_.answers) compare_errors();
    compare_invariants();
    note("its declaration", a_.declared, b_.declared);
    note("the version of forceshade", a_.forceshade, b_.forceshade);
    note("the time of an answer", a_.timing, b_.timing);
    note("the allocations of an answer", a_.allocations, b_.allocations);
    std::ranges::stable_sort(changes_, {}, &Change::direction);
    return std::move(changes_);
  }

 private:
  void add(bool is_worse, const std::string& what, const std::string& before, const std::string& after,
           const std::string& details = "") {
    changes_.push_back({is_worse ? Direction::worse : Direction::better, what, before, after, details});
  }

  void note(const std::string& what, const std::string& before, const std::string& after) {
    if (before != after)
      changes_.push_back({Direction::changed, what, before.empty() ? "none" : before, after.empty() ? "none" : after});
  }

  // Errors among fewer answers say less: they are compared only where as many were judged.
  void compare_outcomes() {
    const auto is_judged = [](const Report& report) { return report.outcome == "judged"; };
    if (is_judged(a_) != is_judged(b_))
      add(is_judged(a_), "the run", a_.outcome, b_.outcome);
    else
      note("the run", a_.outcome, b_.outcome);
    if (a_.answers != b_.answers)
      add(b_.answers < a_.answers, "answers that were judged", std::to_string(a_.answers), std::to_string(b_.answers));
  }

  void compare_errors() {
    for (const auto& [what, before] : a_.errors) {
      const auto after = b_.errors.find(what);
      if (after != b_.errors.end() && after->second != before)
        add(after->second > before, what, shown(before), shown(after->second));
    }
  }

  // An invariant that was not tried counts like one that is absent.
  void compare_invariants() {
    const Report::Invariant none{kNotTried, "", {}};
    const auto of = [&](const Report& report, const std::string& name) {
      const auto found = report.invariants.find(name);
      return found == report.invariants.end() ? none : found->second;
    };
    std::map<std::string, Report::Invariant> all = a_.invariants;
    all.insert(b_.invariants.begin(), b_.invariants.end());
    for (const auto& [name, unused] : all) {
      const Report::Invariant before = of(a_, name), after = of(b_, name);
      if (before.result == after.result) {
        compare_deviations(name, before, after);
        continue;
      }
      const bool is_worse = after.result == kFailed || before.result == kHeld;
      add(is_worse, name, before.result, after.result, is_worse ? after.violation : before.violation);
    }
  }

  // For an invariant with the same result in both. What is held is allowed, however much of it is used.
  void compare_deviations(const std::string& name, const Report::Invariant& before, const Report::Invariant& after) {
    if (!before.share || !after.share) return;
    const auto [least, most] = std::minmax(*before.share, *after.share);
    const bool is_held = after.result == kHeld;
    if (most < kLeastShare || most <= least * (is_held ? kOtherDeviation : kOtherViolation)) return;
    const std::string what = "the largest deviation over the allowed one, " + name;
    if (is_held)
      note(what, shown_share(*before.share), shown_share(*after.share));
    else
      add(*after.share > *before.share, what, shown_share(*before.share), shown_share(*after.share), after.violation);
  }

  static std::string shown_share(double share) { return std::isinf(share) ? "no finite number" : digits(share, 3); }

  const Report &a_, &b_;
  std::vector<Change> changes_;
};

constexpr std::array kDirections{"worse", "better", "changed"};

const char* name_of(Direction direction) {
  return kDirections[static_cast<std::size_t>(direction)];
}

std::size_t count(const Comparison& found, Direction direction) {
  return static_cast<std::size_t>(std::ranges::count(found.changes, direction, &Change::direction));
}

}  // namespace

bool Comparison::is_worse() const {
  return count(*this, Direction::worse) > 0;
}

Comparison compare(std::string_view before_text, const std::string& before, std::string_view after_text,
                   const std::string& after) {
  const Report a = report_from(before_text, before), b = report_from(after_text, after);
  expect_same_run(a, before, b, after);
  std::string run;
  for (const auto& [what, value] : a.run)
    if (!value.empty()) run.append(run.empty() ? "" : ", ").append(what).append(" ").append(value);
  return {a.who, b.who, run, Comparer(a, b).changes()};
}

Comparison compare_files(const std::string& before, const std::string& after) {
  const auto text = [](const std::string& file) {
    try {
      return properties::text_of_json_file(file, "what 'forceshade conform --json' writes");
    } catch (const Error& error) {
      throw Error(file + ": " + error.what());
    }
  };
  const std::string first = text(before);  // it is named first where both are missing
  return compare(first, before, text(after), after);
}

std::string words_of(const Comparison& found) {
  std::string words = "before: " + found.before + "\nafter:  " + found.after + "\nboth:   " + found.run + '\n';
  for (const Change& change : found.changes) {
    words += std::string(name_of(change.direction)) + ": " + change.what + ": " + files::printable(change.before) + " became " +
             files::printable(change.after) + '\n';
    if (!change.details.empty()) words += "  " + files::printable(change.details) + '\n';
  }
  return words + (found.is_worse() ? "WORSE" : "not worse") + ": " + std::to_string(count(found, Direction::worse)) +
         " got worse, " + std::to_string(count(found, Direction::better)) + " got better\n";
}

nlohmann::ordered_json json_of(const Comparison& found) {
  nlohmann::ordered_json json{{"schema", "forceshade conformance comparison 1"},
                              {"worse", found.is_worse()},
                              {"before", found.before},
                              {"after", found.after},
                              {"run", found.run},
                              {"changes", nlohmann::ordered_json::array()}};
  for (const Change& change : found.changes) {
    nlohmann::ordered_json one{
        {"direction", name_of(change.direction)}, {"what", change.what}, {"before", change.before}, {"after", change.after}};
    if (!change.details.empty()) one["details"] = change.details;
    json["changes"].push_back(std::move(one));
  }
  return json;
}

}  // namespace forceshade::conformance
