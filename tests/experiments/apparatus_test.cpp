// SPDX-License-Identifier: BSD-3-Clause
// The parts of the apparatus: which shapes a protocol means, what their certificates are called, and what was recorded of a
// run.

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <set>
#include <string>

#include "forceshade/bad_input.h"
#include "forceshade/recording.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/certificates.h"
#include "study/apparatus/motion.h"
#include "study/experiments/protocol.h"
#include "study/experiments/session_folder.h"
#include "tests/experiments/protocol_folder.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;
using tests::ProtocolFolder;

// Its stiffness is 0.5 N/mm.
std::string protocol_of_a_subject(const ProtocolFolder& folder, const std::string& file) {
  std::string text = folder.read("classification.toml");
  const std::string law = "{ law = \"bump-1p\" }", radii = "radii_mil = [600]";
  text.replace(text.find(law), law.size(), "{ subject = \"" + file + "\" }");
  text.replace(text.find(radii), radii.size(), "");
  return folder.write("of_a_subject.toml", text);
}

TEST(apparatus, a_subject_of_another_stiffness_than_the_protocols_is_refused) {
  const ProtocolFolder folder;
  folder.write("flat.toml", "render = \"height-map\"\n[[part]]\nshape = \"plane\"\n");
  const std::atomic<bool> stop = false;
  for (const std::string stiffness : {"0.25", "0.5", "0.75"}) {
    folder.write("thing.toml", "height-map = \"flat.toml\"\nstiffness = " + stiffness + "\n");
    Bumps bumps(experiments::read_protocol(protocol_of_a_subject(folder, "thing.toml")), read_until(stop));
    const experiments::Bump bump = bumps.protocol().bumps().at(0);
    try {
      EXPECT_EQ(bumps.of(bump).renderer.open()->step({0, 0, -1}).force.z(), 0.5F);
      EXPECT_EQ(stiffness, "0.5");
    } catch (const files::BadInput& error) {
      EXPECT_NE(stiffness, "0.5");
      EXPECT_NE(std::string(error.what()).find("expected that of the protocol, 0.5 N/mm, got " + stiffness + " N/mm"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(apparatus, certificates_of_different_subjects_have_different_names) {
  const Identity one{.kind = "mesh", .name = "dome", .parameters = {{"stiffness_N_per_mm", 0.5F}}, .digest = "aa"};
  Identity kind = one, name = one, parameters = one, digest = one;
  kind.kind = "height map";
  name.name = "Dome";
  parameters.parameters = {{"stiffness_N_per_mm", 0.25F}};
  digest.digest = "bb";
  std::set<std::string> names;
  for (const Identity& identity : {one, kind, name, parameters, digest}) names.insert(certificate_name(identity));
  EXPECT_EQ(names.size(), 5U);
  EXPECT_EQ(certificate_name(one), certificate_name(Identity(one)));
}

// The time of a run that waited for its ticks is the wall clock's. So is that of older recordings, which say nothing of it.
TEST(apparatus, motion_has_the_time_by_which_its_run_went) {
  for (const std::string paced : {"", "yes", "no"}) {
    const ProtocolFolder folder;
    const fs::path ticks = experiments::ticks_of_run(folder.file("session"), 1);
    fs::create_directories(ticks);
    recorder::Metadata metadata;
    if (!paced.empty()) metadata["paced"] = paced;
    recorder::Recorder recorder((ticks / "00001-between.fsr").string(), metadata, recorder::Recorder::Options{});
    recorder.push({.tick = 0, .wall_ns = 3'000'000'000, .device_time = 0.25});
    recorder.close("stopped");
    const auto motion = motion_of(folder.file("session"), 1);
    ASSERT_TRUE(motion);
    const auto first = motion->next();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->time, paced == "no" ? 0.25 : 3.0) << paced;
    EXPECT_FALSE(motion->next());
  }
}

}  // namespace
}  // namespace forceshade::apparatus
