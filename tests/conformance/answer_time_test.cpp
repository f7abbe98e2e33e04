// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "properties/conformance/timing.h"

namespace forceshade::conformance {
namespace {

TEST(timing, takes_the_nearest_rank_in_whatever_order_they_come) {
  std::vector<double> seconds;
  for (int i = 2000; i > 0; --i) seconds.push_back(i);
  const Timing found = timing_of(seconds);
  EXPECT_EQ(found.answers, 2000U);
  EXPECT_EQ(found.p50, 1000);
  EXPECT_EQ(found.p999, 1998);
  EXPECT_EQ(found.worst, 2000);
  const Timing one = timing_of({7});
  EXPECT_EQ(one.p50, 7);
  EXPECT_EQ(one.p999, 7);
  EXPECT_EQ(timing_of({}).answers, 0U);
}

// Records the requests, one after the other.
class Recorder final : public RendererUnderTest {
 public:
  explicit Recorder(std::vector<std::pair<float, bool>>& requested) : requested_(requested) {}

  const Hello& hello() const override { return hello_; }
  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                       std::span<const std::uint32_t>) override {
    EXPECT_EQ(positions.size(), 1U);
    requested_.push_back({positions.front().x(), is_reset});
    return {{0, 0, 0}};
  }
  void say_goodbye() override {}

 private:
  Hello hello_;
  std::vector<std::pair<float, bool>>& requested_;
};

TEST(timing, requests_single_positions_of_the_path_which_it_begins_again) {
  std::vector<std::pair<float, bool>> requested;
  SceneRenderer renderer(std::make_unique<Recorder>(requested), 0.5F);
  const std::vector<Eigen::Vector3f> path{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const Timing found = time_answers(renderer, path);
  EXPECT_EQ(found.answers, requested.size());
  EXPECT_EQ(found.answers, 4000U);
  const std::vector<std::pair<float, bool>> first(requested.begin(), requested.begin() + 5);
  EXPECT_EQ(first, (std::vector<std::pair<float, bool>>{{1, true}, {2, false}, {3, false}, {1, true}, {2, false}}));
  EXPECT_GT(found.worst, 0);
  EXPECT_LE(found.p50, found.p999);
}

TEST(timing, is_said_in_the_unit_that_suits) {
  EXPECT_EQ(words_of_time(2.34e-5), "23.4 µs");
  EXPECT_EQ(words_of_time(0.0085812), "8.58 ms");
  EXPECT_EQ(words_of_time(1.5), "1.5 s");
}

}  // namespace
}  // namespace forceshade::conformance
