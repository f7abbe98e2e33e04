// SPDX-License-Identifier: BSD-3-Clause
// The certificates of an experiment: made where they lack, kept where they cover, and demanded by a session.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/recording.h"
#include "study/apparatus/apparatus.h"
#include "study/apparatus/motion.h"
#include "study/preparation/preparation.h"
#include "study/tests/experiments/protocol_folder.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;

// The only bump of classification.toml.
TEST(prepare, certifies_what_lacks_keeps_the_rest_and_a_session_then_drives_certified) {
  const tests::ProtocolFolder folder;
  const std::string certificates = folder.file("certificates");
  fs::create_directory(certificates);
  std::vector<Prepared> said;
  std::atomic<bool> stop = false;
  const auto made = [&] {
    said.clear();
    return prepare(folder.file("classification.toml"), certificates,
                   {.threads = 2, .done = [&](const Prepared& one) { said.push_back(one); }}, stop);
  };
  EXPECT_TRUE(made());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].number, 1U);
  EXPECT_EQ(said[0].of, 1U);
  EXPECT_EQ(said[0].bump, "bump-1p, 600 mil");
  EXPECT_EQ(said[0].why_not, "");
  EXPECT_FALSE(said[0].was_there);

  EXPECT_TRUE(made());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(said[0].was_there);

  // The front closes at once; what was recorded says by what right it was driven.
  struct Closed final : Front {
    bool show(const experiments::Screen&, const std::optional<device::Sample>&, const experiments::Scene&) override {
      return false;
    }
    std::vector<experiments::Press> presses() override { return {}; }
  } front;
  const auto device = device::open_device("simulated:premium-1.5");
  run_session({.session = folder.file("session"),
               .protocol = folder.file("classification.toml"),
               .participant = "P-1",
               .certificates = certificates,
               .device = "simulated:premium-1.5",
               .servo = {.paced = false}},
              *device, front, stop);
  const std::vector<fs::path> parts = parts_of(fs::path(folder.file("session")) / "ticks/run-1");
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(recorder::Recording(parts.front()).metadata().at("certified"), "yes");

  stop = true;
  fs::remove(fs::directory_iterator(certificates)->path());
  EXPECT_THROW(made(), Interrupted);
  EXPECT_TRUE(fs::is_empty(certificates));
}

}  // namespace
}  // namespace forceshade::apparatus
