// SPDX-License-Identifier: BSD-3-Clause
// Certificates as earlier versions wrote them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/certificate/made_certificate.h"
#include "tests/support/words.h"

namespace forceshade::properties {
namespace {

using Json = nlohmann::ordered_json;

std::string message(const std::string& text) {
  return tests::thrown_by<Error>([&] { from_json(text, "here.json"); });
}

// As an earlier version wrote it: it did not say whose renderer was compared.
Json in_schema_7(const Certificate& certificate) {
  Json json = Json::parse(to_json(certificate));
  json["schema"] = 7;
  for (Json& subject : json["subjects"]) subject.erase("renderer");
  return json;
}

// And as the one before wrote it: one seed for all, and no standing.
Json in_schema_6(const Certificate& certificate) {
  Json json = in_schema_7(certificate);
  json["schema"] = 6;
  json["seed"] = certificate.seeds().front();
  for (const char* key : {"standing", "lacks"}) {
    json.erase(key);
    for (Json& subject : json["subjects"]) subject.erase(key);
  }
  for (Json& subject : json["subjects"]) subject.erase("seeds");
  return json;
}

// Nothing was said, so nothing is known: such a certificate drives no device, and a merged one says so again.
TEST(earlier_schemas, are_read_without_knowing_whose_renderer_was_compared) {
  for (Certificate certificate :
       {tests::made_certificate(), tests::made_certificate_with_sweeps(), tests::made_failed_certificate()})
    for (const Json& earlier : {in_schema_6(certificate), in_schema_7(certificate)}) {
      const Certificate read = from_json(earlier.dump(), "here.json");
      for (SubjectResult& subject : certificate.subjects) subject.rendered_by = RenderedBy::unknown;
      EXPECT_EQ(to_json(read), to_json(certificate));
      EXPECT_EQ(to_json(from_json(to_json(read), "here.json")), to_json(certificate));
      if (!read.held()) continue;
      EXPECT_EQ(refusal(read, read.build, read.subjects[0].identity),
                "the certificate does not say whose renderer was compared for bump-2p; driving needs one of the library's, as "
                "'forceshade certify' makes it");
    }
}

TEST(earlier_schemas, have_no_key_of_another) {
  Json early = in_schema_6(tests::made_certificate());
  early["standing"] = "sufficient";
  EXPECT_NE(message(early.dump()).find("standing"), std::string::npos);
  early = in_schema_7(tests::made_certificate());
  early["subjects"][0]["renderer"] = "library";
  EXPECT_NE(message(early.dump()).find("renderer"), std::string::npos);
  Json late = Json::parse(to_json(tests::made_certificate()));
  late["seed"] = 7;
  EXPECT_NE(message(late.dump()).find("seed"), std::string::npos);
}

}  // namespace
}  // namespace forceshade::properties
