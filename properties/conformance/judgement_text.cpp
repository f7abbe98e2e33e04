// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/judgement_text.h"

#include <array>
#include <cmath>

#include "files/printable.h"
#include "properties/binary32.h"
#include "properties/conformance/scene.h"
#include "rendering/identity/identity_json.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
using properties::show;

constexpr std::array<Unit, 3> kUnits{Unit::ulp, Unit::newton, Unit::percent};
constexpr std::array<const char*, 3> kWorstNames{"worst_in_ulp", "worst_in_newton", "worst_in_percent"};

std::string share(std::uint64_t part, std::uint64_t of) {
  std::string text = std::to_string(part) + " of " + std::to_string(of);
  if (of > 0) text += " (" + digits(100 * static_cast<double>(part) / static_cast<double>(of), 4) + " %)";
  return text;
}

// "0", "1", "2 to 3", "4 to 7", "no number".
std::string ulps_in(std::size_t bin) {
  if (bin == Judgement::kUlpBins - 1) return "no number";
  if (bin < 2) return std::to_string(bin);
  const std::uint64_t least = std::uint64_t{1} << (bin - 1);
  return std::to_string(least) + " to " + std::to_string(2 * least - 1);
}

std::string error_words(const Distance& distance) {
  if (distance.ulps == kNoNumber) return "no finite force";
  std::string words = std::to_string(distance.ulps) + " ulp, " + digits(distance.newtons.high, 3) + " N";
  if (distance.exact_newtons.high > 0)
    words += ", " + digits(100 * distance.newtons.high / distance.exact_newtons.high, 3) + " % of the force";
  return words;
}

std::string place_of(const Judged& judged) {
  std::string words = judged.its.place.empty() ? "" : judged.its.place + ": ";
  return words + "at " + show(judged.its.position) + " mm the answer is " + show(judged.its.force) + " N; the exact force is " +
         show(judged.exact.force) + " N";
}

Json json_of(const Eigen::Vector3f& v) {
  return hexfloats({v.data(), 3});
}

Json json_of(const Judged& judged) {
  Json found{{"place", judged.its.place},
             {"position_mm", json_of(judged.its.position)},
             {"force_N", json_of(judged.its.force)},
             {"rounded_exact_force_N", json_of(judged.exact.force)}};
  if (!judged.digits[0].empty()) found["exact_force_N"] = judged.digits;
  if (judged.distance.ulps == kNoNumber) return found;
  found["ulp"] = judged.distance.ulps;
  found["newton"] = judged.distance.newtons.high;
  return found;
}

Json json_of(const Count& count) {
  return {{"cases", count.cases}, {"wrong", count.wrong}, {"beyond_tolerance", count.beyond}};
}

std::string literal(float number) {
  if (std::isnan(number)) return "NAN";
  if (std::isinf(number)) return number > 0 ? "INFINITY" : "-INFINITY";
  return hexfloat(static_cast<double>(number)) + 'f';
}

}  // namespace

std::string words_of(const Judgement& found, const Identity& identity, const Tolerance& tolerance) {
  const std::uint64_t right = found.all.cases - found.all.wrong;
  std::string words = identity.name + ": correctly rounded " + share(right, found.all.cases) + '\n';
  if (found.undecided > 0)
    words += "  not judged, because the definition was not decided: " + std::to_string(found.undecided) + '\n';
  if (found.unfinished > 0)
    words +=
        "  not judged, because the definition's god-object did not come to rest: " + std::to_string(found.unfinished) + '\n';
  if (found.all.wrong > 0) {
    words += "  ulp from it:";
    for (std::size_t bin = 0; bin < Judgement::kUlpBins; ++bin)
      if (found.by_ulps[bin] > 0) words += ' ' + ulps_in(bin) + ": " + std::to_string(found.by_ulps[bin]) + ';';
    words.back() = '\n';
    for (const auto& [aim, count] : found.by_aim)
      if (count.wrong > 0 && !aim.empty()) words += "  wrong, aimed at " + aim + ": " + share(count.wrong, count.cases) + '\n';
    const Judged& worst = *found.worst[static_cast<std::size_t>(Unit::ulp)];
    words += "  the largest error in ulp: " + error_words(worst.distance) + "\n    " + place_of(worst) + '\n';
    const Judged& longest = *found.worst[static_cast<std::size_t>(Unit::newton)];
    if (longest.distance.ulps != worst.distance.ulps)
      words += "  the largest error in N: " + error_words(longest.distance) + "\n    " + place_of(longest) + '\n';
  }
  words += (found.held() ? "held: " : "FAILED: ") + share(found.all.cases - found.all.beyond, found.all.cases) +
           " within the tolerance, " + words_of(tolerance) + '\n';
  if (!found.simplest) return words;
  words += "  the simplest beyond it, to paste into a test:\n    position_mm " + literal(found.simplest->its.position) +
           "\n    force_N     " + literal(found.simplest->exact.force) + "  /* not " + literal(found.simplest->its.force) +
           " */\n";
  return words;
}

Json json_of(const Judgement& found, const Identity& identity, const Tolerance& tolerance) {
  Json json{{"schema", "forceshade judgement 1"},
            {"held", found.held()},
            {"tolerance", words_of(tolerance)},
            {"kind", identity.kind},
            {"name", identity.name},
            {"digest", identity.digest},
            {"parameters", parameters_json(identity)},
            {"all", json_of(found.all)},
            {"undecided", found.undecided},
            {"unfinished", found.unfinished}};
  for (const auto& [aim, count] : found.by_aim) json["by_aim"][aim.empty() ? "unknown" : aim] = json_of(count);
  Json& ulps = json["by_ulp"] = Json::array();
  for (std::size_t bin = 0; bin < Judgement::kUlpBins; ++bin)
    if (found.by_ulps[bin] > 0) ulps.push_back({{"ulp", ulps_in(bin)}, {"cases", found.by_ulps[bin]}});
  Json& newtons = json["by_newton"] = Json::array();
  for (std::size_t bin = 0; bin < found.by_newtons.size(); ++bin)
    if (found.by_newtons[bin] > 0) {
      const int power = Judgement::kLeastPower + static_cast<int>(bin);
      newtons.push_back({{"at_most", power > Judgement::kMostPower ? Json(nullptr) : Json("1e" + std::to_string(power))},
                         {"cases", found.by_newtons[bin]}});
    }
  for (const Unit unit : kUnits)
    if (const auto& worst = found.worst[static_cast<std::size_t>(unit)])
      json[kWorstNames[static_cast<std::size_t>(unit)]] = json_of(*worst);
  if (found.simplest) json["simplest_beyond_tolerance"] = json_of(*found.simplest);
  return json;
}

std::string words_of(const Invariant& invariant) {
  if (invariant.violation)
    return "FAILED: " + invariant.name + ", " + std::to_string(invariant.cases) + " cases\n  " + *invariant.violation + '\n';
  if (invariant.not_applicable) return "not applicable: " + invariant.name + ": " + *invariant.not_applicable + '\n';
  return "held: " + invariant.name + ", " + std::to_string(invariant.cases) + " cases\n" +
         (invariant.largest ? "  " + *invariant.largest + '\n' : "");
}

Json json_of(const Invariant& invariant) {
  Json one{{"name", invariant.name}, {"applicable", !invariant.not_applicable}};
  if (invariant.not_applicable) {
    one["reason"] = *invariant.not_applicable;
    return one;
  }
  one["held"] = !invariant.violation;
  one["cases"] = invariant.cases;
  if (invariant.violation) one["violation"] = *invariant.violation;
  if (invariant.largest) one["largest"] = *invariant.largest;
  if (invariant.share_of_allowed) one["share_of_allowed"] = *invariant.share_of_allowed;
  return one;
}

std::string words_of(const Conformance& found, const Tolerance& tolerance) {
  const std::string who = found.hello.name + (found.hello.version.empty() ? "" : ' ' + found.hello.version);
  if (found.hello.refusal)
    return "not applicable: " + who + " does not render " + found.identity.name + ": " + *found.hello.refusal + '\n';
  std::string words;
  if (found.judgement.all.cases > 0)
    words = (who.empty() ? "" : who + " renders ") + words_of(found.judgement, found.identity, tolerance);
  else if (!found.hello.claims_definition)
    words = who + " renders " + found.identity.name + " and does not claim the definition, with which it was not compared\n";
  if (found.counterexample)
    words += "  made simpler, as a test to paste:\n" +
             test_to_paste(found.identity, found.shortest_path, found.periods_of_shortest_path, *found.counterexample);
  for (const Invariant& invariant : found.invariants) words += words_of(invariant);
  if (found.timing)
    words += "time of an answer: half within " + words_of_time(found.timing->p50) + ", 99.9 % within " +
             words_of_time(found.timing->p999) + ", the slowest " + words_of_time(found.timing->worst) + ", " +
             std::to_string(found.timing->answers) + " answers to one position each\n";
  if (found.failure) words += "FAILED: " + *found.failure + '\n';
  return words;
}

Json json_of(const Conformance& found, const Circumstances& circumstances) {
  const ConformOptions& options = circumstances.options;
  Json json{{"schema", kConformanceSchema},
            {"forceshade", circumstances.version},
            {"command", circumstances.command},
            {"seed", options.seed},
            {"points", options.points},
            {"held", found.held()},
            {"applicable", found.is_applicable()},
            {"renderer", {{"name", found.hello.name}, {"version", found.hello.version}, {"declares", found.hello.declared}}}};
  if (found.hello.refusal) json["refusal"] = *found.hello.refusal;
  if (found.failure) json["failure"] = *found.failure;
  json["exact"] = json_of(found.judgement, found.identity, options.tolerance);
  for (const Eigen::Vector3f& position : found.shortest_path) json["shortest_path_mm"].push_back(json_of(position));
  if (!found.periods_of_shortest_path.empty()) json["shortest_path_periods"] = found.periods_of_shortest_path;
  if (found.counterexample) json["counterexample"] = json_of(*found.counterexample);
  json["invariants"] = Json::array();
  for (const Invariant& invariant : found.invariants) json["invariants"].push_back(json_of(invariant));
  if (const auto& timing = found.timing)
    json["timing"] = {
        {"answers", timing->answers}, {"p50_s", timing->p50}, {"p99_9_s", timing->p999}, {"worst_s", timing->worst}};
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

std::string literal(const Eigen::Vector3f& numbers) {
  return '{' + literal(numbers.x()) + ", " + literal(numbers.y()) + ", " + literal(numbers.z()) + '}';
}

std::string test_to_paste(const Identity& identity, std::span<const Eigen::Vector3f> path,
                          std::span<const std::uint32_t> periods, const Judged& at_its_end) {
  std::string text =
      "// " + files::printable(identity.name + ": " + parameters_in_words(identity)) + "\nconst float path_mm[][3] = {";
  for (std::size_t i = 0; i < path.size(); ++i) text += (i == 0 ? "" : ",\n                             ") + literal(path[i]);
  text += "};  // from no contact\n";
  for (std::size_t i = 0; i < periods.size(); ++i)
    text +=
        (i == 0 ? "const unsigned periods[] = {" : ", ") + std::to_string(periods[i]) + (i + 1 == periods.size() ? "};\n" : "");
  text += "const float force_N[3] = " + literal(at_its_end.exact.force) + ";  // at its end, not " +
          literal(at_its_end.its.force) + '\n';
  return text;
}

}  // namespace forceshade::conformance
