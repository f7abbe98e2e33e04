// SPDX-License-Identifier: BSD-3-Clause
// Properties and certificates by the C interface of the exact side are those of the C++ calls.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "forceshade/certificate.h"
#include "forceshade/certify.h"
#include "forceshade/properties.h"
#include "forceshade/subjects.h"
#include "forceshade_reference.h"
#include "tests/bindings/references.h"
#include "tests/support/temporary_directory.h"

namespace forceshade {
namespace {

using tests::kBump;
using tests::law_file;
using tests::parsed;

struct Finished {
  std::vector<properties::PropertyResult> all;
  std::size_t most = 100;
};

std::int32_t keep(void* user, const char* name, std::int32_t held, std::uint64_t cases, const char* counterexample) {
  auto& finished = *static_cast<Finished*>(user);
  finished.all.push_back({name, cases, held != 0, counterexample});
  return finished.all.size() >= finished.most ? 1 : 0;
}

TEST(reference_checks, runs_the_properties_and_stops_where_it_is_told_to) {
  const forceshade_reference bump = parsed(kBump);
  const auto expected = properties::run_properties(*properties::subject_of(subjects::read_text(kBump, "bump.toml")), 50, 3);
  Finished finished;
  ASSERT_EQ(forceshade_reference_properties(bump, 50, 3, &keep, &finished), FORCESHADE_OK) << forceshade_reference_message();
  ASSERT_EQ(finished.all.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(finished.all[i].name, expected[i].name);
    EXPECT_EQ(finished.all[i].cases, expected[i].cases);
    EXPECT_EQ(finished.all[i].held, expected[i].held);
    EXPECT_EQ(finished.all[i].counterexample, expected[i].counterexample);
  }
  Finished two{.all = {}, .most = 2};
  ASSERT_EQ(forceshade_reference_properties(bump, 50, 3, &keep, &two), FORCESHADE_OK);
  EXPECT_EQ(two.all.size(), 2U);
  forceshade_reference_free(bump);
}

std::int32_t follow(void* user, double done) {
  auto& all = *static_cast<std::vector<double>*>(user);
  all.push_back(done);
  return 0;
}

TEST(reference_checks, writes_the_certificate_that_cpp_makes_and_that_covers_the_subject) {
  const tests::TemporaryDirectory folder;
  const std::string file = folder.file("certificate.json"), text = law_file("wall", {0, 0, 0.5F});
  const forceshade_reference wall = parsed(text);
  forceshade_subject subject{};
  ASSERT_EQ(forceshade_subject_parse(text.data(), text.size(), "wall.toml", &subject), FORCESHADE_OK);
  forceshade_reference_plan plan{.size = sizeof plan, .points = 3000, .cases = 20, .seed = 5, .threads = 2};
  std::int32_t standing = 99;
  std::vector<double> all;
  ASSERT_EQ(forceshade_reference_certify(wall, &plan, file.c_str(), &follow, &all, &standing), FORCESHADE_OK)
      << forceshade_reference_message();
  EXPECT_EQ(standing, FORCESHADE_REFERENCE_INSUFFICIENT);
  EXPECT_GT(all.size(), 1U);
  EXPECT_TRUE(std::ranges::is_sorted(all));
  EXPECT_EQ(all.back(), 1);
  const properties::Certificate written = properties::from_json(folder.read("certificate.json"), file);
  EXPECT_EQ(written.build.library_digest, forceshade_library_digest());
  properties::CertifyOptions options;
  options.subjects.push_back(std::shared_ptr(properties::subject_of(subjects::read_text(text, "wall.toml"))));
  options.points = 3000;
  options.cases = 20;
  options.seed = 5;
  const auto expected = properties::certify(
      options, [](auto, double) {}, false);
  ASSERT_TRUE(expected);
  const properties::SubjectResult &found = written.subjects.at(0), &right = expected->subjects.at(0);
  EXPECT_EQ(found.points, right.points);
  EXPECT_EQ(found.points_by_aim, right.points_by_aim);
  EXPECT_EQ(found.points_by_status, right.points_by_status);
  EXPECT_EQ(found.seeds, right.seeds);
  EXPECT_EQ(found.spread.points, right.spread.points);
  EXPECT_EQ(forceshade_certificate_covers(file.c_str(), subject), FORCESHADE_NOT_COVERED) << "there is too little evidence";

  const forceshade_reference_plan usual{.size = sizeof usual, .points = 0, .cases = 0, .seed = 1, .threads = 0};
  ASSERT_EQ(forceshade_reference_certify(wall, &usual, file.c_str(), nullptr, nullptr, &standing), FORCESHADE_OK)
      << forceshade_reference_message();
  EXPECT_EQ(standing, FORCESHADE_REFERENCE_SUFFICIENT);
  EXPECT_EQ(forceshade_certificate_covers(file.c_str(), subject), FORCESHADE_OK) << forceshade_message();
  forceshade_subject_free(subject);
  forceshade_reference_free(wall);
}

}  // namespace
}  // namespace forceshade
