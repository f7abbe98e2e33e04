// SPDX-License-Identifier: BSD-3-Clause
// The parts of the apparatus: which shapes a protocol means, what their certificates are called, and what was recorded of a
// run.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "device/latest_tick.h"
#include "forceshade/error.h"
#include "forceshade/recording.h"
#include "run/recorder/settings.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/certificates.h"
#include "study/apparatus/motion.h"
#include "study/experiments/protocol.h"
#include "study/experiments/session_folder.h"
#include "study/tests/experiments/protocol_folder.h"

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
    } catch (const Error& error) {
      EXPECT_NE(stiffness, "0.5");
      EXPECT_NE(std::string(error.what()).find("expected that of the protocol, 0.5 N/mm, got " + stiffness + " N/mm"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(apparatus, has_the_one_damping_of_all_its_bumps) {
  const ProtocolFolder folder;
  folder.write("flat.toml", "render = \"height-map\"\n[[part]]\nshape = \"plane\"\n");
  const auto write = [&](const std::string& name, const std::string& drag) {
    folder.write(name, "height-map = \"flat.toml\"\nstiffness = 0.5\n[damping]\ndrag = " + drag + "\ntime = \"2ms\"\n");
  };
  write("thing.toml", "0.001");
  const std::atomic<bool> stop = false;
  Bumps bumps(experiments::read_protocol(protocol_of_a_subject(folder, "thing.toml")), read_until(stop));
  EXPECT_EQ(bumps.damping(500), (damping::Parameters{.rate = 500, .share = 0.5F, .drag = 0.001F}));
  write("other.toml", "0.002");
  std::string text = folder.read("of_a_subject.toml");
  text.replace(text.find("{ subject ="), 0, "{ name = \"other\", subject = \"other.toml\" }, ");
  Bumps mixed(experiments::read_protocol(folder.write("mixed.toml", text)), read_until(stop));
  EXPECT_THROW(mixed.damping(500), Error);
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

// A surface at z = height_mm + slope_y y.
Bumps of_a_plane(const ProtocolFolder& folder, const std::string& plane, const std::atomic<bool>& stop) {
  folder.write("flat.toml", "render = \"height-map\"\n[[part]]\nshape = \"plane\"\n" + plane);
  std::string text = folder.read("classification.toml");
  const std::string law = "{ law = \"bump-1p\" }", radii = "radii_mil = [600]";
  text.replace(text.find(law), law.size(), "{ height-map = \"flat.toml\" }");
  text.replace(text.find(radii), radii.size(), "");
  return Bumps(experiments::read_protocol(folder.write("of_a_plane.toml", text)), read_until(stop));
}

TEST(apparatus, shows_a_surface_as_high_as_it_is) {
  const ProtocolFolder folder;
  const std::atomic<bool> stop = false;
  for (const auto& [plane, at, height] : {std::tuple("height_mm = 0", 0.0, 0.0),
                                          {"height_mm = -90", 1.0, -90.0},
                                          {"height_mm = 90", 1.0, 90.0},
                                          {"slope_x = 0.5", 3.0, 1.5},
                                          {"slope_y = 0.5", 3.0, 0.0}}) {
    Bumps bumps = of_a_plane(folder, plane, stop);
    const experiments::Bump bump = bumps.protocol().bumps().at(0);
    EXPECT_NEAR(bumps.height(bump, at), height, 0.01) << plane;
    EXPECT_EQ(bumps.height(bump, HUGE_VAL), 0);
  }
  const experiments::Bump aside{"flat", 0, 500};  // mil
  EXPECT_EQ(Bumps::place_of(aside, {1, 2, 3}), Eigen::Vector3f(13.7F, 2, 3));
}

TEST(apparatus, a_mesh_has_the_unit_of_its_protocol_and_a_scene_is_none_of_a_session) {
  const ProtocolFolder folder;
  const std::atomic<bool> stop = false;
  folder.write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  std::string text = folder.read("classification.toml");
  const std::string law = "{ law = \"bump-1p\" }", radii = "radii_mil = [600]";
  text.replace(text.find(law), law.size(), "{ mesh = \"one.off\", unit = \"m\" }");
  text.replace(text.find(radii), radii.size(), "");
  const Bumps bumps(experiments::read_protocol(folder.write("of_a_mesh.toml", text)), read_until(stop));
  const Description mesh = bumps.description(bumps.protocol().bumps().at(0));
  EXPECT_EQ(std::get<MeshRendering>(mesh.what).mesh().vertices.at(1), (mesh::Vertex{1000, 0, 0}));
  folder.write("scene.toml", "scene = \"" FORCESHADE_SOURCE_DIR "/examples/scenes/moving.toml\"\nstiffness = 0.5\n");
  Bumps moving(experiments::read_protocol(protocol_of_a_subject(folder, "scene.toml")), read_until(stop));
  try {
    moving.description(moving.protocol().bumps().at(0));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("expected no object with a motion"), std::string::npos) << error.what();
  }
}

// Ten are named, with the reason of the first.
TEST(apparatus, of_bumps_without_certificates_says_how_many_more_there_are) {
  const std::atomic<bool> stop = false;
  for (const auto& [count, rest] : {std::pair(1, ""), {10, ""}, {11, "; and 1 more"}, {13, "; and 3 more"}}) {
    const ProtocolFolder folder;
    std::string text = folder.read("classification.toml"), radii;
    for (int i = 0; i < count; ++i) radii += (i > 0 ? ", " : "") + std::to_string(600 + i);
    text.replace(text.find("[600]"), 5, '[' + radii + ']');
    Bumps bumps(experiments::read_protocol(folder.write("many.toml", text)), read_until(stop));
    std::string words;
    try {
      certificates_of(bumps, folder.file("none"));
    } catch (const Error& error) {
      words = error.what();
    }
    const std::string last = "bump-1p, " + std::to_string(600 + std::min(count, 10) - 1) + " mil";
    const std::string first = certificate_name(bumps.of(bumps.protocol().bumps().front()).identity);
    EXPECT_NE(words.find(last + rest + " (" + folder.file("none/" + first) + " is not there;"), std::string::npos) << words;
  }
}

// The parts are in the order of their numbers, and what ends a run is no tick.
TEST(apparatus, motion_is_that_of_all_parts_and_says_how_it_was_made) {
  for (const std::string device : {"simulated:premium-1.5", "phantom"}) {
    const ProtocolFolder folder;
    const fs::path ticks = experiments::ticks_of_run(folder.file("session"), 1);
    fs::create_directories(ticks);
    device::SafetySettings settings;
    settings.rate_hz = 250;
    recorder::Metadata metadata = recorder::metadata_of(settings);
    metadata.insert({{"paced", "no"}, {"device", device}, {"device_model", "Premium"}});
    for (const int part : {2, 10, 1}) {
      const std::string digits = part < 10 ? "0000" + std::to_string(part) : "00010";
      recorder::Recorder recorder((ticks / (digits + "-between.fsr")).string(), metadata, recorder::Recorder::Options{});
      for (std::uint64_t i = 0; i < 3; ++i) recorder.push({.tick = i, .device_time = part + 0.25 * static_cast<double>(i)});
      recorder.push({.tick = 3, .device_time = part + 0.75, .status = device::Sample::kEnd});
      recorder.close("stopped");
    }
    const auto motion = motion_of(folder.file("session"), 1);
    ASSERT_TRUE(motion);
    EXPECT_EQ(motion->ticks_per_second, 250);
    const bool is_simulated = device != "phantom";
    EXPECT_EQ(motion->manufacturer, is_simulated ? "none, simulated by forceshade" : "");
    EXPECT_EQ(motion->model, is_simulated ? "simulated Premium" : "Premium");
    std::vector<double> times;
    for (auto sample = motion->next(); sample; sample = motion->next()) times.push_back(sample->time);
    EXPECT_EQ(times, (std::vector<double>{1, 1.25, 1.5, 2, 2.25, 2.5, 10, 10.25, 10.5}));
  }
}

TEST(apparatus, a_loop_ends_at_the_tick_after_somebody_asked) {
  std::atomic<bool> asked = false, stop = false;
  device::LatestTick latest(asked, stop);
  EXPECT_FALSE(latest.latest());
  latest.push({.tick = 1});
  EXPECT_FALSE(stop);
  asked = true;
  latest.push({.tick = 2});
  EXPECT_TRUE(stop);
  EXPECT_EQ(latest.latest()->tick, 2U);
}

}  // namespace
}  // namespace forceshade::apparatus
