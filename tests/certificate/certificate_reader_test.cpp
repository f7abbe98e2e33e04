// SPDX-License-Identifier: BSD-3-Clause
// Refuses a text that is no certificate or contradicts itself, in words that name the key. Faults are made at every place of
// certificates that are right.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "files/printable.h"
#include "tests/certificate/made_certificate.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;
using Place = Json::json_pointer;

std::string message(const std::string& text) {
  return tests::thrown_by<Error>([&] { from_json(text, "here.json"); });
}

const std::vector<std::string>& texts() {
  static const std::vector<std::string> all{to_json(tests::made_certificate()), to_json(tests::made_certificate_with_sweeps()),
                                            to_json(tests::made_failed_certificate())};
  return all;
}

// visit(place, value) for all that is in json, json itself included.
void walk(const Json& json, const Place& place, const std::function<void(const Place&, const Json&)>& visit) {
  visit(place, json);
  if (json.is_object())
    for (const auto& member : json.items()) walk(member.value(), place / member.key(), visit);
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i) walk(json[i], place / i, visit);
}

// make(json, place) changes one thing of a certificate: the result must be refused, and the words must hold what make gives. If
// it gives nothing, nothing was changed. Returns how many faults were made.
int refused_everywhere(const std::function<std::string(Json&, const Place&)>& make) {
  int faults = 0;
  for (std::size_t i = 1; i < texts().size(); ++i) {  // the first has nothing that the second lacks
    const Json right = Json::parse(texts()[i]);
    walk(right, Place(), [&](const Place& place, const Json&) {
      Json wrong = right;
      const std::string words = make(wrong, place);
      if (words.empty()) return;
      ++faults;
      const std::string said = message(wrong.dump());
      EXPECT_NE(said.find(words), std::string::npos) << place << ": " << said;
      EXPECT_TRUE(said.starts_with("here.json: expected a forceshade certificate (schema 6 to 8): ")) << said;
    });
  }
  std::printf("  %d faults\n", faults);
  return faults;
}

// The domain is compared as a whole.
bool is_in_domain(const Place& place) {
  return place.to_string().starts_with("/domain/");
}

TEST(certificate_reader, reads_back_what_was_written) {
  for (const std::string& text : texts()) EXPECT_EQ(to_json(from_json(text, "here.json")), text);
}

TEST(certificate_reader, refuses_a_certificate_that_lacks_a_key) {
  EXPECT_GT(refused_everywhere([](Json& json, const Place& place) -> std::string {
              if (place.empty() || !json[place.parent_pointer()].is_object() || place == Place("/exhaustive")) return "";
              const std::string key = place.back();
              json[place.parent_pointer()].erase(key);
              if (is_in_domain(place)) return "domain is ";
              return place.to_string().find("points_by_") != std::string::npos ? "points_by_" : key;
            }),
            500);
}

TEST(certificate_reader, refuses_a_key_that_it_does_not_know) {
  EXPECT_GT(refused_everywhere([](Json& json, const Place& place) -> std::string {
              if (!json[place].is_object()) return "";
              json[place]["colour"] = 1;
              if (place == Place("/domain")) return "domain is ";
              return place.to_string().find("points_by_") != std::string::npos ? "points_by_" : "colour";
            }),
            60);
}

TEST(certificate_reader, refuses_a_key_that_stands_twice) {
  int faults = 0;
  for (const std::string& text : texts()) {
    // A second member of every name, right after its object begins: the parser would take the last.
    const std::string begin = "{\n";
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
      const std::size_t quote = text.find('"', at), end = text.find('"', quote + 1);
      const std::string key = text.substr(quote, end + 1 - quote);
      std::string wrong = text;
      wrong.insert(at + 1, key + ": 1, ");
      ++faults;
      const std::string said = message(wrong);
      EXPECT_NE(said.find("the key " + key + " stands twice"), std::string::npos) << said;
    }
  }
  EXPECT_GT(faults, 60);
}

TEST(certificate_reader, refuses_what_stands_behind_a_zero_byte) {
  for (const std::string& text : texts())
    for (const std::string behind : {"", "}", "{\"held\": false}"})
      EXPECT_NE(message(text + '\0' + behind).find("expected JSON, got a binary file"), std::string::npos) << behind;
}

TEST(certificate_reader, refuses_a_value_of_another_type) {
  const std::vector<Json> others{
      nullptr, true, 1U, -1, 0.5, "text", Json::array(), Json::object(), Json::array({Json::array()})};
  for (const Json& other : others)
    EXPECT_GT(refused_everywhere([&](Json& json, const Place& place) -> std::string {
                Json& value = json[place];
                const bool same_type = value.type() == other.type() || (value.is_number() && other.is_number());
                if (same_type || place.empty()) return "";
                value = other;
                const std::string key = place.back();
                return is_in_domain(place) ? "domain" : key.find_first_not_of("0123456789") == std::string::npos ? "is " : key;
              }),
              100);
}

// Any seed is one.
bool is_seed(const Place& place) {
  return !place.parent_pointer().empty() && place.parent_pointer().back() == "seeds";
}

TEST(certificate_reader, refuses_a_count_that_is_no_whole_number) {
  const std::vector<Json> wrong{-1, 0.5, 1e30, -0.0, 18446744073709551616.0, 1.0};
  for (const Json& other : wrong)
    EXPECT_GT(refused_everywhere([&](Json& json, const Place& place) -> std::string {
                if (!json[place].is_number_unsigned() || is_seed(place)) return "";
                json[place] = other;
                return std::string(place.back()) + " is ";
              }),
              100)
        << other;
}

TEST(certificate_reader, refuses_counts_that_do_not_fit_together) {
  const std::set<std::string> free{"cases", "parameter_sets"};
  for (const std::int64_t step : {+1, -1})
    EXPECT_GT(refused_everywhere([&](Json& json, const Place& place) -> std::string {
                Json& value = json[place];
                if (!value.is_number_unsigned() || free.contains(place.back()) || is_seed(place) || (value == 0U && step < 0))
                  return "";
                // One that failed may be a part.
                if (place == Place("/exhaustive/units/first") && !json["held"].get<bool>()) return "";
                value = value.get<std::uint64_t>() + static_cast<std::uint64_t>(step);
                return "expected";
              }),
              100);
}

TEST(certificate_reader, refuses_points_that_no_scalar_code_was_compared_at) {
  EXPECT_GT(refused_everywhere([](Json& json, const Place& place) -> std::string {
              if (place.empty() || place.back() != "points_by_instruction_set") return "";
              EXPECT_GT(json[place].size(), 1U) << "another set is left";
              json[place].erase("scalar");
              return "for each set that was compared, scalar and ";
            }),
            3);
}

TEST(certificate_reader, refuses_a_verdict_that_the_rest_does_not_bear_out) {
  EXPECT_GT(refused_everywhere([](Json& json, const Place& place) -> std::string {
              if (!json[place].is_boolean()) return "";
              const std::string key = place.back();
              // A law that is not conservative contradicts nothing else of a certificate.
              if (key == "conservative") return "";
              json[place] = !json[place].get<bool>();
              return "is ";
            }),
            30);
}

TEST(certificate_reader, names_the_key_the_value_and_what_was_expected) {
  struct Fault {
    const char* place;
    Json value;
    const char* words;
  };
  const std::vector<Fault> faults{
      {"/schema", 4.9, "schema is 4.9; expected a whole number"},
      {"/schema", 4, "schema is 4; expected 6 to 8: certify again"},
      {"/subjects/0/mismatches", 0.5, "subjects[0].mismatches is 0.5; expected a whole number"},
      {"/subjects/0/mismatches", 1000000000000,
       "subjects[0].mismatches is 1000000000000; expected no more than there are points"},
      {"/subjects/0/properties", Json::array(), "subjects[0].properties is an array; expected all of "},
      {"/subjects/0/mismatches", 1, "subjects[0].counterexamples is an array; expected the first of 1 mismatches"},
      {"/subjects/0/points", -1, "subjects[0].points is -1; expected a whole number"},
      {"/subjects/0/points", 0, "subjects[0].points is 0; expected 1 or more"},
      {"/subjects/0/points", 999999, "subjects[0].points_by_instruction_set is an object; expected 999999 for each set"},
      {"/subjects/0/counterexamples",
       {"at 1"},
       "subjects[0].counterexamples is an array; expected none, as there is no mismatch"},
      {"/subjects/0/held", false, "subjects[0].held is false; expected true, as the rest of the certificate says"},
      {"/held", false, "held is false; expected true"},
      {"/subjects/0/points_by_instruction_set/avx512", 5, "subjects[0].points_by_instruction_set is an object"},
      {"/subjects/0/points_by_instruction_set/mmx", 1000000, "subjects[0].points_by_instruction_set is an object"},
      {"/subjects/0/points_by_aim/any bits", 1, "subjects[0].points_by_aim is an object; expected counts of any bits, volume"},
      {"/subjects/0/points_by_aim/any bits", 18446744073709551615U, "subjects[0].points_by_aim is an object; expected counts"},
      {"/subjects/0/spread/parameter_sets", 0, "subjects[0].spread.parameter_sets is 0; expected 1 or more"},
      {"/subjects/0/spread/parameter_sets", 250001,
       "subjects[0].spread.parameter_sets is 250001; expected 1 or more, and no more"},
      {"/subjects/0/properties/1/name", "equivalence",
       "subjects[0].properties[1].name is \"equivalence\"; expected each property once"},
      {"/subjects/0/properties/1/cases", 0, "subjects[0].properties[1].cases is 0; expected 1 or more"},
      {"/subjects/0/properties/2/held", false, "subjects[0].properties[2].counterexample is \"\"; expected one"},
      {"/subjects/0/properties/2/counterexample", "at 1", "expected none, as the property held"},
      {"/subjects/0/energy_per_loop/0/bound_mJ/1", nullptr,
       "subjects[0].energy_per_loop[0].bound_mJ[1] is null; expected a finite number"},
      {"/subjects/0/energy_per_loop/0/bound_mJ/0", 9.5, "subjects[0].energy_per_loop[0].bound_mJ is [9.5,0.250001]; expected"},
      {"/subjects/0/energy_per_loop/0/bound_mJ", {-2.5, -1.5}, "expected no bound below 0"},
      {"/subjects/0/conservative", true, "subjects[0].energy_per_loop[0].bound_mJ is an array; expected [0, 0]"},
      {"/subjects/0/energy_per_loop/0/depth_mm", -0.5, "subjects[0].energy_per_loop[0].depth_mm is -0.5; expected more than 0"},
      {"/subjects/0/closest_call/x_mm", 0.7, "subjects[0].closest_call.x_mm is 0.7; expected a binary32 number"},
      {"/subjects/0/closest_call/ulps_from_tie", 0.0, "subjects[0].closest_call.ulps_from_tie is 0.0; expected more than 0"},
      {"/subjects/0/closest_call/ulps_from_tie", 1.5, "expected more than 0 and at most 1"},
      {"/subjects/0/parameters/stiffness_N_per_mm", 0.1,
       "subjects[0].parameters.stiffness_N_per_mm is 0.1; expected a binary32 number"},
      {"/subjects/0/parameters/stiffness_N_per_mm", -0.5, "stiffness is -0.5 N/mm; expected 0.001 to 1000 N/mm"},
      {"/subjects/0/parameters/radius_mm", 0.0, "radius is 0 mm; expected 0.1 to 10000 mm"},
      {"/subjects/0/name", "bump-9p", "unknown law \"bump-9p\""},
      {"/subjects/2/digest", "c0ffee", "subjects[2].digest is \"c0ffee\"; expected a SHA-256 of 64 hex digits"},
      {"/subjects/2/parameters/rendering", "height-mop", "unknown rendering \"height-mop\""},
      {"/subjects/2/parameters/stiffness_N_per_mm", 2048.0, "stiffness is 2048 N/mm; expected 0.001 to 1000 N/mm"},
      {"/subjects/2/parts", Json::array(), "subjects[2].parts is an array; expected at least one part"},
      {"/subjects/2/name", "a\u009bb", "subjects[2].name is \"a\\u009bb\"; expected text without control"},
      {"/build/compiler", "\x1b[31m", "build.compiler is \"\\u001b[31m\"; expected text without control characters"},
      {"/build/instruction_set", "mmx", "build.instruction_set is \"mmx\"; expected scalar, avx2 or avx512"},
      {"/build/instruction_set", "avx512", "subjects[0].points_by_instruction_set is an object; expected 1000000 for each set"},
      {"/build/library_digest", std::string(64, 'A'), "build.library_digest is"},
      {"/statement", "All is well.", "statement is \"All is well.\"; expected the words of schema 8"},
      {"/method", "", "method is \"\"; expected the words of schema 8"},
      {"/domain/radius_mm/1", 2e4, "domain is an object; expected {"},
      {"/date", "2026-01-31 23:59:59", "date is \"2026-01-31 23:59:59\"; expected one like 2026-01-31T23:59:59Z"},
      {"/seconds", -1.5, "seconds is -1.5; expected 0 or more"},
      {"/subjects/0/seeds", {3, -1}, "subjects[0].seeds is an array; expected an array of whole numbers"},
      {"/subjects/0/seeds", {3, 3}, "subjects[0].seeds is an array; expected one seed or more, each above the one before"},
      {"/subjects/0/seeds", Json::array(), "subjects[0].seeds is an array; expected one seed or more"},
      {"/standing", "green", "standing is \"green\"; expected one of sufficient, insufficient, failed"},
      {"/standing", "failed", "standing is \"failed\"; expected another, as nothing in the certificate failed"},
      {"/subjects/0/standing", "failed", "subjects[0].standing is \"failed\"; expected another, as nothing"},
      {"/subjects/0/renderer", "mine", "subjects[0].renderer is \"mine\"; expected one of unknown, program, library"},
      {"/subjects/0/lacks", "a point", "subjects[0].lacks is \"a point\"; expected nothing, as the standing is sufficient"},
      {"/subjects/0/standing", "insufficient", "subjects[0].lacks is \"\"; expected what is missing, in words"},
      {"/exhaustive/units/next", 2000, "units: expected first <= next <= end <= of = 1024, got {"},
      {"/exhaustive/units/first", 1025, "units: expected first <= next <= end <= of = 1024, got {"},
      {"/exhaustive/units/end", 1023, "units: expected first <= next <= end <= of = 1024, got {"},
      {"/exhaustive/units/end", 1025, "units: expected first <= next <= end <= of = 1024, got {"},
      {"/exhaustive/units/of", 1025, "units: expected first <= next <= end <= of = 1024, got {"},
      {"/exhaustive/units/first", 1, "held is true; expected false"},
      {"/exhaustive/sweeps", Json::array(), "exhaustive.sweeps is an array; expected at least one sweep"},
      {"/exhaustive/sweeps/0/kind", "wave", "unknown kind of sweep \"wave\""},
      {"/exhaustive/sweeps/0/inputs", 1001, "exhaustive.calls_by_stage is an object; expected counts that add up"},
      {"/exhaustive/sweeps/0/inputs", 4294967297U, "exhaustive.sweeps[0].inputs is 4294967297; expected at most 2^32"},
      {"/exhaustive/sweeps/0/mismatches", 6001,
       "exhaustive.sweeps[0].mismatches is 6001; expected no more than there are calls"},
      {"/exhaustive/sweeps/0/mismatches", 6000, "exhaustive.mismatches is 0; expected 6000, the sum of the sweeps'"},
      {"/exhaustive/sweeps/0/mismatches", 1, "exhaustive.mismatches is 0; expected 1, the sum of the sweeps'"},
      {"/exhaustive/inputs", 1, "exhaustive.inputs is 1; expected 3000, the sum of the sweeps'"},
      {"/exhaustive/finished", false, "exhaustive.finished is false; expected true"},
      {"/exhaustive/seconds", -0.5, "exhaustive.seconds is -0.5; expected 0 or more"},
  };
  for (const auto& [place, value, words] : faults) {
    Json json = Json::parse(texts()[1]);
    json[Place(place)] = value;
    const std::string said = message(json.dump());
    EXPECT_NE(said.find(words), std::string::npos) << place << ": " << said;
  }
}

TEST(certificate_reader, ends_with_clear_words_on_hostile_text) {
  std::vector<std::string> hostile{"",
                                   " ",
                                   "null",
                                   "[]",
                                   "3",
                                   "{",
                                   "\xff\xfe",
                                   std::string(1000, '\0'),
                                   "{\"schema\": 1e999}",
                                   "{\"schema\": " + std::string(1000000, '9') + "}",
                                   "{\"\x1b[2J\": 1}",
                                   std::string(100000, '['),
                                   std::string(17U << 20, ' ')};
  hostile.push_back("{\"schema\": " + std::string(100000, '{'));
  std::string open;
  for (int i = 0; i < 100000; ++i) open += "{\"a\":";
  hostile.push_back(open);
  std::string keys = "{\"schema\": 6";
  for (int i = 0; i < 100000; ++i) keys += ", \"k" + std::to_string(i) + "\": " + std::to_string(i);
  hostile.push_back(keys + '}');
  for (const std::string& text : hostile) {
    const std::string said = message(text);
    EXPECT_TRUE(said.starts_with("here.json: expected a forceshade certificate (schema 6 to 8): ")) << said;
    EXPECT_LT(said.size(), 400U) << said;
    EXPECT_TRUE(files::is_printable(said)) << said;
  }
  EXPECT_NE(message(hostile[12]).find("17825792 bytes; expected at most 16777216"), std::string::npos) << message(hostile[12]);
  EXPECT_NE(message(hostile[11]).find("more than 16 levels"), std::string::npos) << message(hostile[11]);
  for (const std::size_t levels : {16U, 17U})
    EXPECT_EQ(
        message(std::string(levels, '[') + '1' + std::string(levels, ']')).find("more than 16 levels") == std::string::npos,
        levels == 16);
}

// Every byte of a certificate changed to each of a few others: it is refused, or reads as one that says the same of the laws.
TEST(certificate_reader, ends_with_words_whatever_byte_is_changed) {
  const std::string text = texts()[1];
  for (std::size_t at = 0; at < text.size(); at += 29)
    for (const char other : {'0', '"', '}', ',', '-', '\xff'}) {
      std::string wrong = text;
      wrong[at] = other;
      EXPECT_LT(message(wrong).size(), 1000U);
    }
}

TEST(certificate_reader, refuses_energy_of_a_subject_that_is_said_to_be_conservative) {
  for (const std::array<double, 2> bound : {std::array{0.0, 0.5}, {0.25, 0.5}}) {
    Certificate certificate = tests::made_certificate();
    certificate.subjects[0].conservative = true;
    certificate.subjects[0].energy[0].bound_mJ = bound;
    tests::expect_words(tests::thrown_by<Error>([&] { from_json(to_json(certificate), "here.json"); }),
                        {"expected [0, 0], as no loop of a conservative law gives energy"});
  }
}

TEST(certificate_writer, refuses_numbers_that_are_not_finite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bound : {infinity, -infinity, std::nan("")}) {
    Certificate certificate = tests::made_certificate();
    certificate.subjects[1].energy[0].bound_mJ[1] = bound;
    tests::expect_words(tests::thrown_by<Error>([&] { to_json(certificate); }),
                        {"subjects[1].energy_per_loop[0].bound_mJ[1] is "});
  }
}

TEST(certificate_writer, writes_a_file_name_that_is_not_utf_8) {
  Certificate certificate = tests::made_certificate();
  certificate.subjects[2].identity.name = "hill\xff.toml";
  EXPECT_EQ(from_json(to_json(certificate), "here.json").subjects[2].name(), "hill\uFFFD.toml");
}

TEST(certificate_reader, says_why_a_file_cannot_be_read) {
  const tests::TemporaryDirectory directory;
  const auto why = [](const std::string& file) { return tests::thrown_by<Error>([&] { read_certificate(file); }); };
  EXPECT_EQ(why(directory.file("no.json")), directory.file("no.json") + ": cannot be read: No such file or directory");
  EXPECT_EQ(why(directory.path()), directory.path() + ": cannot be read: Is a directory");
  EXPECT_EQ(why("/dev/zero"), "/dev/zero: cannot be read: it is larger than 16777216 bytes");
  directory.write("empty.json", "");
  EXPECT_EQ(why(directory.file("empty.json")),
            directory.file("empty.json") + ": cannot be read: it is empty; expected a certificate");
  directory.write("some.json", "{}");
  EXPECT_EQ(read_certificate(directory.file("some.json")), "{}");
}

}  // namespace
}  // namespace forceshade::properties
