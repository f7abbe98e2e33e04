// SPDX-License-Identifier: BSD-3-Clause
// The session of a virtual participant: what it says of itself, which forces it says were certified, and how it ends where it
// cannot go on.

#include "study/apparatus/virtual_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/error.h"
#include "forceshade/recording.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/certificates.h"
#include "study/apparatus/motion.h"
#include "study/apparatus/session_run.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/session_results.h"
#include "study/experiments/stimulus_list.h"
#include "study/tests/experiments/protocol_folder.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;
using experiments::AnsweredBy;

class VirtualSession : public testing::Test {
 protected:
  // The classification with other texts in it.
  std::string with(const std::vector<std::pair<std::string, std::string>>& changes) const {
    std::string all = folder.read("classification.toml");
    for (const auto& [text, other] : changes) all.replace(all.find(text), text.size(), other);
    return folder.write("other.toml", all);
  }
  std::string words_of(const VirtualPlan& plan) const {
    try {
      run_virtual_session(plan, 1, stop);
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  bool is_over() const {
    const auto events = experiments::read_session(folder.file("out/V1")).events;
    return std::ranges::find(events, experiments::EventKind::session_ended, &experiments::Event::kind) != events.end();
  }

  tests::ProtocolFolder folder;
  VirtualPlan plan{.protocol = folder.file("classification.toml"), .out = folder.file("out"), .certificates = {}};
  std::atomic<bool> stop = false;
};

TEST_F(VirtualSession, says_that_a_model_answered_and_which_forces_were_certified) {
  Bumps bumps(experiments::read_protocol(plan.protocol), read_until(stop));
  const std::string certificate = certificate_name(bumps.of(bumps.protocol().bumps().at(0)).identity);
  for (const bool is_certified : {false, true}) {
    plan.out = folder.file(is_certified ? "certified" : "uncertified");
    if (is_certified) plan.certificates = {{certificate, "0123"}};
    const std::size_t ticks = run_virtual_session(plan, 1, stop);
    const fs::path session = plan.out / "V1";
    const auto trials = experiments::results_of(experiments::read_session(session)).classification;
    ASSERT_EQ(trials.size(), 2U);
    for (const auto& trial : trials)
      EXPECT_EQ(trial.origin, (experiments::Origin{AnsweredBy::model, "simulated:premium-1.5:mouse", is_certified}));
    for (const auto& listed : experiments::read_stimuli(session / "ticks/run-1/stimuli.jsonl"))
      if (listed.left) {
        EXPECT_EQ(listed.left->certificate_digest, is_certified ? "0123" : "none");
        EXPECT_EQ(listed.left->certificate, certificate);
      }
    std::size_t recorded = 0, strokes = 0;
    for (const fs::path& part : parts_of(session / "ticks/run-1")) {
      recorder::Recording recording(part);
      EXPECT_EQ(recording.metadata().at("virtual"), "yes");
      EXPECT_EQ(recording.metadata().at("certified"), is_certified ? "yes" : "no");
      std::size_t own = 0;
      recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
        for (const device::Sample& sample : chunk) {
          if (sample.status == device::Sample::kEnd) continue;
          ++recorded;
          // It goes down beside the bump, a tenth of a second after it began.
          if (recording.metadata().contains("trial") && ++own == 90) {
            ++strokes;
            EXPECT_GT(sample.position[2], 4);
          }
        }
      });
    }
    EXPECT_EQ(recorded, ticks);
    EXPECT_EQ(strokes, 2U);
  }
  plan.out = folder.file("lacking");
  plan.certificates = {{"another.json", "0123"}};
  EXPECT_NE(words_of(plan).find("bump-1p, 600 mil: no certificate was checked for it before the session"), std::string::npos);
}

TEST_F(VirtualSession, ends_with_what_the_participant_throws) {
  folder.write("flat.toml", "render = \"height-map\"\n[[part]]\nshape = \"plane\"\n");
  plan.protocol = with({{"{ law = \"bump-1p\" }", "{ height-map = \"flat.toml\" }"}, {"radii_mil = [600]", ""}});
  EXPECT_EQ(words_of(plan), "flat is no law");
  EXPECT_FALSE(is_over());
}

TEST_F(VirtualSession, that_was_stopped_is_interrupted) {
  stop = true;
  EXPECT_THROW(run_virtual_session(plan, 1, stop), Interrupted);
  EXPECT_FALSE(is_over());
}

TEST(origin, names_a_simulated_device_once) {
  for (const auto& [device, said] : {std::pair("simulated:premium-1.5", "simulated:premium-1.5"),
                                     {"mouse", "mouse (simulated)"},
                                     {"phantom", "phantom"},
                                     {"replay:strokes.csv", "replay:strokes.csv"}})
    EXPECT_EQ(origin_of(AnsweredBy::person, device, true), (experiments::Origin{AnsweredBy::person, said, true}));
}

}  // namespace
}  // namespace forceshade::apparatus
