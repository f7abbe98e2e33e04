// SPDX-License-Identifier: BSD-3-Clause
// The answers of the exact side's C interface about a wrong renderer. The library checks no renderer but its own, which is
// right; so this program is made of the library's sources and of a function here that opens a wrong one. CMakeLists.txt gives
// subject_of() another name in all of them, so that it does not collide with the checking library's.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "forceshade/properties.h"
#include "properties/law_subject.h"
#include "tests/bindings/references.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::properties {

// A law whose stiffness is rendered as the next binary32 number.
std::unique_ptr<Subject> subject_of(const Description& description) {
  const auto& law = std::get<DescribedLaw>(description.what);
  return std::make_unique<LawSubject>(law.law, law.parameters, [](LawId id, const Parameters& its) {
    return fast_law(id, {its.radius, its.width, std::nextafter(its.stiffness, 2 * its.stiffness)});
  });
}

}  // namespace forceshade::properties

namespace forceshade {
namespace {

std::int32_t keep_first_failure(void* user, const char* name, std::int32_t held, std::uint64_t, const char* counterexample) {
  auto& found = *static_cast<std::string*>(user);
  if (held == 0 && found.empty()) found = std::string(name) + ": " + counterexample;
  return 0;
}

TEST(reference_refuted, a_wrong_renderer_is_refuted_in_words_and_its_certificate_covers_nothing) {
  const tests::TemporaryDirectory folder;
  const std::string file = folder.file("certificate.json");
  const forceshade_reference bump = tests::parsed(tests::kBump);
  const forceshade_reference_plan plan{.size = sizeof plan, .points = 2000, .cases = 20, .seed = 5, .threads = 1};
  std::int32_t standing = 99;
  EXPECT_EQ(forceshade_reference_certify(bump, &plan, file.c_str(), nullptr, nullptr, &standing), FORCESHADE_FAILED);
  EXPECT_EQ(standing, FORCESHADE_REFERENCE_REFUTED);
  const std::string message = forceshade_reference_message();
  EXPECT_NE(message.find("points differ: "), std::string::npos) << message;

  forceshade_subject subject{};
  ASSERT_EQ(forceshade_subject_parse(tests::kBump.data(), tests::kBump.size(), "bump.toml", &subject), FORCESHADE_OK);
  EXPECT_EQ(forceshade_certificate_covers(file.c_str(), subject), FORCESHADE_NOT_COVERED);
  EXPECT_NE(std::string(forceshade_message()).find("bump-2p failed"), std::string::npos) << forceshade_message();

  std::string found;
  ASSERT_EQ(forceshade_reference_properties(bump, 50, 3, &keep_first_failure, &found), FORCESHADE_OK);
  EXPECT_EQ(found.rfind("equivalence: ", 0), 0U) << found;
  forceshade_subject_free(subject);
  forceshade_reference_free(bump);
}

}  // namespace
}  // namespace forceshade
