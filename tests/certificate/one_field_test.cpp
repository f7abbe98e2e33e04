// SPDX-License-Identifier: BSD-3-Clause
// Every field of a certificate, in one list: where one alone is another, what is written differs there and nowhere else, is
// read back, survives merging, and drive refuses it where it matters. A new field belongs into the list.

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "forceshade/certify.h"
#include "rendering/breakdown.h"
#include "tests/certificate/made_certificate.h"

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

constexpr Parameters kParametersOfLaw{15.24F, 25.4F, 0.5F};

// The places at which two certificates differ, as JSON pointers; of lists of another length the list itself.
std::set<std::string> places(const Json& one, const Json& other, const std::string& here = "") {
  if (one == other) return {};
  const bool same_shape = one.type() == other.type() && one.is_structured() && one.size() == other.size();
  if (!same_shape) return {here};
  std::set<std::string> all;
  for (const auto& member : one.items()) {
    const std::string there = here + '/' + member.key();
    const bool is_there = one.is_array() || other.contains(member.key());
    if (!is_there) return {here};
    all.merge(places(member.value(), one.is_array() ? other[std::stoul(member.key())] : other[member.key()], there));
  }
  return all;
}

// The standing and what is lacking follow from the other fields; standing_test checks them.
std::set<std::string> places(const Certificate& one, const Certificate& other) {
  std::set<std::string> all = places(Json::parse(to_json(one)), Json::parse(to_json(other)));
  std::erase_if(all, [](const std::string& place) { return place.ends_with("/standing") || place.ends_with("/lacks"); });
  return all;
}

// One field that is another, and what had to be changed with it so that the certificate does not contradict itself.
struct OneField {
  std::function<void(Certificate&)> change;
  std::set<std::string> differs;  // where, in what is written
  std::string refused = "";       // drive's refusal of subjects[0], or its beginning; empty where it is driven all the same
};

template <class Change>
std::function<void(Certificate&)> of_first(Change change) {
  return [change](Certificate& certificate) { change(certificate.subjects[0]); };
}

// One point more of the second name, one less of the first.
void move_one(Comparison::Counts& counts) {
  --counts.begin()->second;
  ++std::next(counts.begin())->second;
}

std::vector<OneField> fields_of_comparison(const std::function<Comparison&(Certificate&)>& of, const std::string& where,
                                           const std::string& with) {
  const auto row = [&](const std::function<void(Comparison&)>& change, const std::vector<std::string>& keys,
                       const std::string& refused = "") {
    OneField field{[of, change](Certificate& certificate) { change(of(certificate)); }, {}, refused};
    for (const std::string& key : keys) field.differs.insert(where + key);
    return field;
  };
  const auto breakdown = [&](Comparison::Counts Comparison::*counts, const std::string& key) {
    const Comparison made = tests::made_comparison(100);
    const auto first = (made.*counts).begin();
    return row([counts](Comparison& found) { move_one(found.*counts); },
               {key + '/' + first->first, key + '/' + std::next(first)->first});
  };
  return {
      row(
          [](Comparison& found) {
            ++found.points;
            for (auto& [set, points] : found.points_by_instruction_set) ++points;
            for (auto* counts :
                 {&found.points_by_aim, &found.points_by_stage, &found.points_by_method, &found.points_by_status})
              ++counts->begin()->second;
          },
          {"points", "points_by_instruction_set/scalar", "points_by_instruction_set/avx2", "points_by_aim/any bits",
           "points_by_stage/binary64", "points_by_method/enclosure", "points_by_status/contact"}),
      row([](Comparison& found) { found = tests::made_comparison(9); }, {}, "the certificate has 9 points for bump-2p" + with),
      row(
          [](Comparison& found) {
            found.mismatches = 1;
            found.counterexamples = {"at 1"};
          },
          {"mismatches", "counterexamples"}, "the certificate says that bump-2p failed"),
      row([](Comparison& found) { found.points_by_instruction_set["avx512"] = found.points; }, {"points_by_instruction_set"}),
      breakdown(&Comparison::points_by_aim, "points_by_aim"),
      breakdown(&Comparison::points_by_stage, "points_by_stage"),
      breakdown(&Comparison::points_by_method, "points_by_method"),
      breakdown(&Comparison::points_by_status, "points_by_status"),
  };
}

const std::string kFailed = "the certificate says that bump-2p failed";

// Each field of what a certificate of points holds.
std::vector<OneField> fields_of_points() {
  const std::string other = "the certificate covers bump-2p with other parameters";
  std::vector<OneField> all{
      {[](Certificate& c) { c.build.version = "0.2.0"; }, {"/build/version"}},
      {[](Certificate& c) { c.build.revision = "decade"; }, {"/build/revision"}},
      {[](Certificate& c) { c.build.compiler = "Clang"; },
       {"/build/compiler"},
       "the certificate is for another compiler: expected GNU 12.2.0, got Clang"},
      {[](Certificate& c) { c.build.flags = "-O1"; },
       {"/build/flags"},
       "the certificate is for other compiler flags: expected -O3 -ffp-contract=off, got -O1"},
      {[](Certificate& c) { c.build.instruction_set = "scalar"; }, {"/build/instruction_set"}},
      {[](Certificate& c) { c.build.library_digest = std::string(64, 'b'); },
       {"/build/library_digest"},
       "the certificate is for another build of the renderer: expected digest aaaa"},
      {of_first([](SubjectResult& s) { s.seeds = {8}; }), {"/subjects/0/seeds/0"}},
      {of_first([](SubjectResult& s) {
         s.seeds = {7, 8};
       }),
       {"/subjects/0/seeds"}},
      {[](Certificate& c) { c.seconds = 9.5; }, {"/seconds"}},
      {[](Certificate& c) { c.date = "2027-01-31T23:59:59Z"; }, {"/date"}},
      {[](Certificate& c) { c.processor = "another"; }, {"/processor"}},
      {of_first([](SubjectResult& s) { s.identity = identity_of(LawId::bump_3p, kParametersOfLaw); }),
       {"/subjects/0/name"},
       "the certificate does not cover the law bump-2p"},
      {[](Certificate& c) { c.subjects[2].identity.name = "mound.toml"; }, {"/subjects/2/name"}},
      {[](Certificate& c) { c.subjects[2].identity.kind = "other map"; }, {"/subjects/2/kind"}},
      {[](Certificate& c) { c.subjects[2].identity.digest = std::string(64, 'd'); }, {"/subjects/2/digest"}},
      {[](Certificate& c) { c.subjects[2].parts = {"cone"}; }, {"/subjects/2/parts/0"}},
      {[](Certificate& c) {
         c.subjects[2].identity.kind = "other map";
         c.subjects[2].unit_directions = false;
       },
       {"/subjects/2/kind", "/subjects/2/unit"}},
      {of_first([](SubjectResult& s) {
         s.identity = identity_of(LawId::bump_2p, {15.25F, 25.4F, 0.5F});
       }),
       {"/subjects/0/parameters/radius_mm"},
       other},
      {of_first([](SubjectResult& s) {
         s.identity = identity_of(LawId::bump_2p, {15.24F, 25.5F, 0.5F});
       }),
       {"/subjects/0/parameters/width_mm"},
       other},
      {of_first([](SubjectResult& s) {
         s.identity = identity_of(LawId::bump_2p, {15.24F, 25.4F, 0.75F});
       }),
       {"/subjects/0/parameters/stiffness_N_per_mm"},
       other},
      {of_first([](SubjectResult& s) { s.rendered_by = RenderedBy::program; }),
       {"/subjects/0/renderer"},
       "the certificate is of a program's own renderer for bump-2p"},
      {of_first([](SubjectResult& s) { s.jumps = {"x = 0"}; }), {"/subjects/0/jumps/0"}},
      {of_first([](SubjectResult& s) { s.jumps = {}; }), {"/subjects/0/jumps", "/subjects/0/continuous"}},
      {of_first([](SubjectResult& s) {
         s.conservative = true;
         s.energy[0].bound_mJ = {0, 0};
       }),
       {"/subjects/0/conservative", "/subjects/0/energy_per_loop/0/bound_mJ/0", "/subjects/0/energy_per_loop/0/bound_mJ/1"}},
      {of_first([](SubjectResult& s) { s.closest_call.x = 2; }), {"/subjects/0/closest_call/x_mm"}},
      {of_first([](SubjectResult& s) { s.closest_call.y = 2; }), {"/subjects/0/closest_call/y_mm"}},
      {of_first([](SubjectResult& s) { s.closest_call.z = 2; }), {"/subjects/0/closest_call/z_mm"}},
      {of_first([](SubjectResult& s) { s.closest_call.ulps_from_tie = 1; }), {"/subjects/0/closest_call/ulps_from_tie"}},
      {of_first([](SubjectResult& s) { s.energy[0].depth_mm = 1; }), {"/subjects/0/energy_per_loop/0/depth_mm"}},
      {of_first([](SubjectResult& s) { s.energy[0].bound_mJ[0] = 0; }), {"/subjects/0/energy_per_loop/0/bound_mJ/0"}},
      {of_first([](SubjectResult& s) { s.energy[0].bound_mJ[1] = 1; }), {"/subjects/0/energy_per_loop/0/bound_mJ/1"}},
      {of_first([](SubjectResult& s) { s.energy[0].witness_mJ = 0; }), {"/subjects/0/energy_per_loop/0/witness_mJ"}},
      {of_first([](SubjectResult& s) { s.energy[0].measured_mJ = 0; }), {"/subjects/0/energy_per_loop/0/measured_mJ"}},
      {of_first([](SubjectResult& s) { s.energy.push_back(s.energy[0]); }), {"/subjects/0/energy_per_loop"}},
      {of_first([](SubjectResult& s) { s.spread.parameter_sets = 8; }), {"/subjects/0/spread/parameter_sets"}},
  };
  for (std::size_t i = 0; i < kPropertyNames.size(); ++i) {
    const std::string place = "/subjects/0/properties/" + std::to_string(i);
    const bool is_unit = kPropertyNames[i] == "unit normals";
    all.push_back({of_first([i](SubjectResult& s) { s.properties[i].cases += 1; }), {place + "/cases"}});
    all.push_back({of_first([i](SubjectResult& s) { s.properties[i].cases = 9; }),
                   {place + "/cases"},
                   "the certificate has 9 cases of " + std::string(kPropertyNames[i])});
    all.push_back({of_first([i, is_unit](SubjectResult& s) {
                     s.properties[i].held = false;
                     s.properties[i].counterexample = "at 1";
                     s.unit_directions = !is_unit;
                   }),
                   {place + "/held", place + "/counterexample", "/subjects/0/held", "/held"},
                   kFailed});
    if (is_unit) all.back().differs.insert("/subjects/0/unit");
  }
  const auto given = [](Certificate& c) -> Comparison& { return c.subjects[0]; };
  const auto spread = [](Certificate& c) -> Comparison& { return c.subjects[0].spread; };
  for (const auto& [of, where, with] :
       {std::tuple{std::function<Comparison&(Certificate&)>(given), "/subjects/0/", ""},
        std::tuple{std::function<Comparison&(Certificate&)>(spread), "/subjects/0/spread/", " with other parameters"}})
    for (OneField field : fields_of_comparison(of, where, with)) {
      if (field.refused == kFailed) field.differs.merge(std::set<std::string>{"/subjects/0/held", "/held"});
      all.push_back(std::move(field));
    }
  return all;
}

// Each field of what a certificate of sweeps holds.
std::vector<OneField> fields_of_sweeps() {
  std::vector<OneField> all{
      {[](Certificate& c) { c.sweeps.seconds += 1; }, {"/exhaustive/seconds"}},
      {[](Certificate& c) {
         --c.sweeps.stages[0];
         ++c.sweeps.stages[1];
       },
       {"/exhaustive/calls_by_stage/binary64", "/exhaustive/calls_by_stage/double-double"}},
      {[](Certificate& c) {
         --c.sweeps.stages[0];
         ++c.sweeps.stages[2];
       },
       {"/exhaustive/calls_by_stage/binary64", "/exhaustive/calls_by_stage/wide"}},
  };
  for (const std::size_t i : {0U, 1U}) {
    const std::string place = "/exhaustive/sweeps/" + std::to_string(i);
    all.push_back({[i](Certificate& c) {
                     c.sweeps.results[i].inputs += 1;
                     c.sweeps.stages[0] += i == 0 ? 2 : 1;  // the first is of heights
                   },
                   {place + "/inputs", "/exhaustive/inputs", "/exhaustive/calls_by_stage/binary64"}});
    all.push_back({[i](Certificate& c) {
                     c.sweeps.results[i].mismatches = 1;
                     c.sweeps.counterexamples.push_back("at 3");
                   },
                   {place + "/mismatches", "/exhaustive/mismatches", "/exhaustive/counterexamples", "/held"},
                   i == 0 ? kFailed : ""});  // the second is of another law
  }
  return all;
}

std::string refusal_of(const Certificate& certificate) {
  return refusal(certificate, tests::made_build(), identity_of(LawId::bump_2p, kParametersOfLaw)).value_or("");
}

Certificate again(const Certificate& certificate) {
  return from_json(to_json(certificate), "here.json");
}

void expect_row(const Certificate& changed, const Certificate& base, const OneField& field, const std::string& what) {
  const auto found = places(base, changed);
  std::string listed;
  for (const std::string& place : found) listed += place + ' ';
  EXPECT_FALSE(found.empty()) << what;
  if (!field.differs.empty()) {
    EXPECT_EQ(found, field.differs) << what << ": " << listed;
  }
  const Certificate read = again(changed);
  EXPECT_EQ(to_json(read), to_json(changed)) << what << ": " << listed;
  const std::string said = refusal_of(read);
  EXPECT_TRUE(field.refused.empty() ? said.empty() : said.starts_with(field.refused)) << what << ": " << listed << said;
  EXPECT_EQ(changed.held(), !found.contains("/held")) << what << ": " << listed;
}

TEST(one_field, of_points_is_written_read_and_judged_alone) {
  const Certificate base = tests::made_certificate();
  ASSERT_EQ(refusal_of(base), "");
  for (const OneField& field : fields_of_points()) {
    Certificate changed = base;
    field.change(changed);
    expect_row(changed, base, field, "points");
  }
}

TEST(one_field, of_sweeps_beside_points_is_written_read_and_judged_alone) {
  Certificate base = tests::made_certificate();
  base.sweeps = tests::made_certificate_with_sweeps().sweeps;
  EXPECT_TRUE(base.held());
  EXPECT_EQ(refusal_of(base), "");
  for (const OneField& field : fields_of_sweeps()) {
    Certificate changed = base;
    field.change(changed);
    expect_row(changed, base, field, "sweeps");
  }
}

// A certificate that is not whole does not hold, and says how far it is.
TEST(one_field, of_the_units_of_a_sweep_is_written_read_and_judged) {
  const Certificate base = tests::made_certificate_with_sweeps();
  const std::vector<OneField> fields{
      {[](Certificate& c) { ++c.sweeps.first; }, {"/exhaustive/units/first", "/held"}},
      {[](Certificate& c) { --c.sweeps.next; }, {"/exhaustive/units/next", "/exhaustive/finished", "/held"}},
      {[](Certificate& c) { c.sweeps.next = --c.sweeps.end; }, {"/exhaustive/units/next", "/exhaustive/units/end", "/held"}},
      {[](Certificate& c) {
         c.sweeps.results[0].sweep.kind = SweepKind::line;
         c.sweeps.stages[0] -= 1000;
       },  // a line has one call for each input
       {"/exhaustive/sweeps/0/kind", "/exhaustive/calls_by_stage/binary64"}},
      {[](Certificate& c) { c.sweeps.results[1].sweep.at = 0.5F; }, {"/exhaustive/sweeps/1/at_mm"}},
      {[](Certificate& c) { c.sweeps.results[0].sweep.law = LawId::bump_3p; }, {"/exhaustive/sweeps/0/law"}},
      {[](Certificate& c) { c.sweeps.results[1].sweep.parameters.stiffness = 1; },
       {"/exhaustive/sweeps/1/parameters/stiffness_N_per_mm"}},
  };
  for (const OneField& field : fields) {
    Certificate changed = base;
    field.change(changed);
    expect_row(changed, base, field, "units");
  }
}

}  // namespace
}  // namespace forceshade::properties
