// SPDX-License-Identifier: BSD-3-Clause
// The statements of a certificate about driving a device: the same as drive's refusal, in the JSON and on the page.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "forceshade/certificate.h"
#include "report/report.h"
#include "tests/certificate/made_certificate.h"

namespace forceshade::properties {
namespace {

Certificate with_few_points() {
  Certificate certificate = tests::made_certificate();
  static_cast<Findings&>(certificate.subjects[0]) = tests::made_findings(2000);
  return certificate;
}

Certificate of_sweeps_alone() {
  Certificate certificate = tests::made_certificate_with_sweeps();
  certificate.subjects.clear();
  return certificate;
}

TEST(standing, is_sufficient_where_drive_accepts_the_certificate) {
  const Certificate certificate = tests::made_certificate();
  EXPECT_EQ(assessed(certificate).standing, Standing::sufficient);
  EXPECT_EQ(assessed(certificate).lacks, "");
  for (const SubjectResult& subject : certificate.subjects) {
    EXPECT_EQ(assessed(subject).standing, Standing::sufficient);
    EXPECT_EQ(refusal(certificate, certificate.build, subject.identity), std::nullopt);
  }
}

TEST(standing, is_insufficient_where_drive_refuses_for_want_of_evidence_and_names_what_gathers_it) {
  const Certificate certificate = with_few_points();
  const Assessment of_law = assessed(certificate.subjects[0]), of_all = assessed(certificate);
  EXPECT_EQ(of_law.standing, Standing::insufficient);
  EXPECT_EQ(of_law.lacks, refusal(certificate, certificate.build, certificate.subjects[0].identity));
  EXPECT_EQ(of_law.lacks, "the certificate has 2000 points for bump-2p; driving needs at least 1000000");
  EXPECT_EQ(
      of_law.remedy,
      "forceshade certify --law bump-2p --radius 15.24 --width 25.4 --stiffness 0.5 --points 1000000 --cases 2000 --out DIR");
  EXPECT_EQ(of_all.standing, Standing::insufficient);
  EXPECT_EQ(of_all.lacks, of_law.lacks);
  EXPECT_EQ(assessed(certificate.subjects[1]).standing, Standing::sufficient) << "each subject has its own";
}

TEST(standing, names_every_subject_that_lacks_evidence_and_one_command_for_laws_of_the_same_parameters) {
  Certificate certificate = with_few_points();
  for (const Identity& other : {identity_of(LawId::wall, {.stiffness = 0.5F}),
                                identity_of(LawId::bump_1p, {.radius = 15.24F, .width = 25.4F, .stiffness = 2})}) {
    SubjectResult few = certificate.subjects[0];
    few.identity = other;
    certificate.subjects.push_back(few);
  }
  const Assessment all = assessed(certificate);
  EXPECT_EQ(all.lacks,
            "the certificate has 2000 points for bump-2p; driving needs at least 1000000; and "
            "the certificate has 2000 points for wall; driving needs at least 1000000; and "
            "the certificate has 2000 points for bump-1p; driving needs at least 1000000");
  EXPECT_EQ(all.remedy,
            "forceshade certify --law bump-2p,wall --radius 15.24 --width 25.4 --stiffness 0.5 --points 1000000 --cases 2000 "
            "--out DIR && forceshade certify --law bump-1p --radius 15.24 --width 25.4 --stiffness 2 --points 1000000 "
            "--cases 2000 --out DIR2");
}

TEST(standing, of_a_subject_with_entries_of_several_renderers_names_the_command_for_it_once) {
  Certificate certificate = with_few_points();
  certificate.subjects[2].points_by_aim["axis"] = 0;
  const std::string remedy = assessed(certificate).remedy;
  for (const std::size_t i : {0U, 2U})
    for (const RenderedBy who : {RenderedBy::program, RenderedBy::unknown}) {
      SubjectResult another = certificate.subjects[i];
      another.rendered_by = who;
      certificate.subjects.push_back(another);
    }
  EXPECT_EQ(assessed(certificate).remedy, remedy);
  certificate = tests::made_certificate();
  certificate.subjects.push_back(certificate.subjects[0]);
  certificate.subjects.back().rendered_by = RenderedBy::program;
  EXPECT_EQ(assessed(certificate).standing, Standing::sufficient) << "drive accepts the other entry";
  certificate.subjects.back().identity.parameters.back().second = 0.75F;
  EXPECT_EQ(assessed(certificate).standing, Standing::insufficient) << "no other entry is of this subject";
}

TEST(standing, of_a_map_names_the_options_that_are_to_be_the_same) {
  Certificate certificate = tests::made_certificate();
  certificate.subjects[2].points_by_aim["axis"] = 0;
  EXPECT_EQ(assessed(certificate.subjects[2]).remedy,
            "forceshade certify with the same height map and --points 200000 --cases 2000 --out DIR");
  certificate.subjects[2].options = "--height-map 'my maps/hill.toml'";
  EXPECT_EQ(assessed(certificate.subjects[2]).remedy,
            "forceshade certify --height-map 'my maps/hill.toml' --points 200000 --cases 2000 --out DIR");
}

TEST(standing, of_sweeps_alone_or_of_some_of_their_units_is_insufficient) {
  Certificate sweeps = of_sweeps_alone();
  EXPECT_EQ(assessed(sweeps).standing, Standing::insufficient);
  EXPECT_EQ(assessed(sweeps).lacks, "the certificate has sweeps only; driving needs points and properties too");
  sweeps.sweeps.next = 5;
  EXPECT_EQ(assessed(sweeps).standing, Standing::insufficient);
  EXPECT_EQ(assessed(sweeps).lacks, "the sweeps are not complete: units 0 to 5 of 1024 are done");
  sweeps.sweeps.results[0].mismatches = 1;
  EXPECT_EQ(assessed(sweeps).standing, Standing::failed);
  // A part that is done is not the whole.
  for (const bool is_first_missing : {true, false}) {
    Certificate part = tests::made_certificate_with_sweeps();
    if (is_first_missing)
      part.sweeps.first = 1;
    else
      part.sweeps.next = --part.sweeps.end;
    EXPECT_TRUE(part.sweeps.is_finished());
    EXPECT_EQ(assessed(part).standing, Standing::insufficient);
    for (const std::uint64_t points : {part.subjects[0].points, std::uint64_t{1}}) {  // whatever else is missing
      part.subjects[0].points = points;
      EXPECT_TRUE(assessed(part).lacks.starts_with("the sweeps are not complete: units ")) << assessed(part).lacks;
    }
  }
}

TEST(standing, is_failed_where_anything_failed) {
  EXPECT_EQ(assessed(Certificate{}).standing, Standing::failed) << "nothing was checked";
  Certificate point = tests::made_certificate(), spread = point, property = point;
  point.subjects[2].mismatches = 1;
  spread.subjects[1].spread.mismatches = 1;
  property.subjects[0].properties[1].held = false;
  for (const Certificate& certificate : {point, spread, property, tests::made_failed_certificate()})
    EXPECT_EQ(assessed(certificate).standing, Standing::failed);
  Certificate both = with_few_points();
  both.subjects[1].mismatches = 1;
  EXPECT_EQ(assessed(both).standing, Standing::failed) << "the worst";
}

TEST(standing, is_in_the_json_of_the_certificate_and_of_each_subject) {
  const auto json = nlohmann::json::parse(to_json(with_few_points()));
  EXPECT_EQ(json["standing"], "insufficient");
  EXPECT_EQ(json["lacks"], "the certificate has 2000 points for bump-2p; driving needs at least 1000000");
  EXPECT_EQ(json["subjects"][0]["standing"], "insufficient");
  EXPECT_EQ(json["subjects"][1]["standing"], "sufficient");
  EXPECT_EQ(json["subjects"][1]["lacks"], "");
  EXPECT_EQ(json["held"], true);
}

TEST(standing, is_on_the_page_with_what_is_missing_and_how_to_gather_it) {
  const auto page = [](const Certificate& certificate) { return to_html(certificate, Pictures::none); };
  const auto has = [](const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; };
  const std::string few = page(with_few_points()), enough = page(tests::made_certificate()),
                    failed = page(tests::made_failed_certificate()), swept = page(of_sweeps_alone());
  EXPECT_TRUE(has(enough, "<p class=\"verdict\">Held</p>"));
  EXPECT_TRUE(has(enough, "This is enough evidence to drive a device with this build."));
  EXPECT_TRUE(has(few, "<header class=\"insufficient\">"));
  EXPECT_TRUE(has(few, "<p class=\"verdict\">Held, too little to drive</p>"));
  EXPECT_TRUE(has(few, "It opens no device: the certificate has 2000 points for bump-2p"));
  EXPECT_TRUE(has(few, "<code>forceshade certify --law bump-2p"));
  EXPECT_TRUE(has(few, "<span class=\"lacking\">too little to drive</span>"));
  EXPECT_TRUE(has(few, "<span class=\"yes\">held</span>")) << "the other subjects";
  EXPECT_TRUE(has(failed, "<header class=\"failed\">"));
  EXPECT_TRUE(has(failed, "It opens no device.</p>"));
  EXPECT_TRUE(has(swept, "It opens no device: the certificate has sweeps only"));
  for (const std::string& html : {few, failed, swept}) EXPECT_FALSE(has(html, ">Held</p>"));
  EXPECT_FALSE(has(few, "renderer)") || has(few, "renderer unknown"));
  for (const auto& [who, words] : {std::pair{RenderedBy::program, "bump-2p (a program&#39;s own renderer)</th>"},
                                   {RenderedBy::unknown, "bump-2p (renderer unknown)</th>"}}) {
    Certificate certificate = tests::made_certificate();
    certificate.subjects[0].rendered_by = who;
    const std::string other = page(certificate);
    EXPECT_TRUE(has(other, words)) << words;
    EXPECT_TRUE(has(other, "<p class=\"verdict\">Held, opens no device</p>"));
    EXPECT_TRUE(has(other, "<span class=\"lacking\">opens no device</span>"));
    EXPECT_FALSE(has(other, "too little to drive"));
  }
}

}  // namespace
}  // namespace forceshade::properties
