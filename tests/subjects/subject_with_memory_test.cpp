// SPDX-License-Identifier: BSD-3-Clause
// A subject of a kind that no library of this project knows, with memory, goes the whole way that a law goes: properties,
// certificate, gate, servo loop, recording. So will a mesh.

#include <gtest/gtest.h>

#include "certificate/build.h"
#include "forceshade/certify.h"
#include "forceshade/device.h"
#include "forceshade/properties.h"
#include "forceshade/recording.h"
#include "forceshade/run.h"
#include "forceshade/servo_loop.h"
#include "run/words.h"
#include "tests/subjects/sticky_wall.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::tests {
namespace {

using properties::Certificate;
using properties::SubjectResult;

Certificate certificate_of(const std::shared_ptr<const properties::Subject>& subject) {
  static const std::atomic<bool> never{false};
  return properties::certify(
             {.subjects = {subject}, .points = properties::points_of_kind(subject->identity().kind), .seed = 7, .threads = 2},
             [](std::string_view, double) {}, never)
      .value();
}

const Certificate& certificate() {
  static const Certificate made = certificate_of(std::make_shared<StickyWall>(StickyWallParameters{}));
  return made;
}

TEST(subject_with_memory, holds_its_properties) {
  for (const properties::PropertyResult& property : properties::run_properties(StickyWall({}), 2000, 3))
    EXPECT_TRUE(property.held) << property.name << ": " << property.counterexample;
}

TEST(subject_with_memory, is_certified_along_paths) {
  EXPECT_TRUE(certificate().held());
  const SubjectResult& found = certificate().subjects.at(0);
  for (const auto& [aim, count] : found.points_by_aim) EXPECT_GT(count, 10000U) << aim;
  for (const auto& [status, count] : found.points_by_status) EXPECT_GT(count, 10000U) << status;
  EXPECT_EQ(properties::to_json(properties::from_json(to_json(certificate()), "here.json")), to_json(certificate()));
}

// Each of these is right in every position for some of the paths that lead there.
TEST(subject_with_memory, is_refused_where_it_remembers_wrongly) {
  struct Wrong final : fast::Session {
    Wrong(const StickyWallParameters& its, int what) : p(its), kind(what), right(StickyWall::open_fast(its)) {}
    fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
      if (kind == 0) right = StickyWall::open_fast(p);  // forgets
      const fast::Evaluation answer = right->step(position);
      if (kind == 1 && answer.status == Status::invalid) right->step({0, 0, -1});      // holds what it should let go
      if (kind == 2 && answer.status == Status::free) return right->step({0, 0, -1});  // a second step for one position
      if (kind == 3 && ++steps > 3000) right = StickyWall::open_fast(p);               // forgets late
      return answer;
    }
    StickyWallParameters p;
    int kind, steps = 0;
    std::unique_ptr<fast::Session> right;
  };
  for (const int kind : {0, 1, 2, 3}) {
    const auto wrong = std::make_shared<StickyWall>(
        StickyWallParameters{}, [kind](const StickyWallParameters& p) { return std::make_unique<Wrong>(p, kind); });
    const Certificate failed = certificate_of(wrong);
    EXPECT_FALSE(failed.held()) << kind;
    EXPECT_GT(failed.subjects.at(0).mismatches, 0U) << kind;
    EXPECT_EQ(refusal(failed, properties::current_build(), wrong->identity()),
              "the certificate says that a program's own renderer of sticky-wall failed");
  }
}

TEST(subject_with_memory, is_driven_only_where_a_certificate_covers_it) {
  const TemporaryDirectory directory;
  const std::string file = directory.file("certificate.json");
  std::ofstream(file) << to_json(certificate());
  EXPECT_TRUE(run::certified(file, StickyWall({}).identity()).digest);
  const run::Certified other = run::certified(file, StickyWall({0.5F, 2}).identity());
  EXPECT_FALSE(other.digest);
  EXPECT_EQ(other.why_not, file +
                               ": the certificate covers sticky-wall with other parameters: expected release 2 mm, stiffness "
                               "0.5 N/mm; got release 1 mm, stiffness 0.5 N/mm");
}

// The exact side computes the forces that a hand felt again from the recording, bit for bit.
TEST(subject_with_memory, is_driven_and_its_recording_can_be_computed_again) {
  const TemporaryDirectory directory;
  const std::string replayed = directory.file("hand.csv"), file = directory.file("run.fsr");
  {
    std::ofstream hand(replayed);
    hand << "t_s,x_mm,y_mm,z_mm\n";
    for (int i = 0; i < 2000; ++i) hand << i * 0.001 << ",0,0," << 1.5 * std::cos(i * 0.02) << '\n';
  }
  const StickyWall wall({});
  const auto session = wall.renderer().open();
  const auto device = device::open_device("replay:" + replayed);
  recorder::Recorder recorder(file, run::metadata_of(wall.identity()));
  device::run_servo_loop(*device, *session, {.max_seconds = 2, .paced = false, .sinks = {&recorder}}, std::atomic<bool>(false));
  EXPECT_EQ(recorder.close("time up").lost, 0U);

  recorder::Recording recording(file);
  EXPECT_EQ(recording.metadata().at("sticky_wall"), "sticky-wall");
  EXPECT_EQ(recording.metadata().at("release_mm"), "1");
  const auto exact = wall.open_reference();
  int pulled = 0, pushed = 0, free = 0;
  recording.for_each_chunk([&](std::span<const device::Sample> samples) {
    for (const device::Sample& sample : samples) {
      if (sample.status == device::Sample::kEnd) continue;
      const reference::Rounded again = exact->step({sample.position[0], sample.position[1], sample.position[2]});
      EXPECT_EQ(again.force.z(), sample.force[2]) << sample.tick;
      pulled += again.force.z() < 0;
      pushed += again.force.z() > 0;
      free += again.status == Status::free;
    }
  });
  EXPECT_GT(pulled, 100);
  EXPECT_GT(pushed, 500);
  EXPECT_GT(free, 300);
}

}  // namespace
}  // namespace forceshade::tests
