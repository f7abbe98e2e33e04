// SPDX-License-Identifier: BSD-3-Clause
// A session with damping behind it, as the page shows it.

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "forceshade/damped.h"

namespace forceshade {
namespace {

std::string text_of(const char* file) {
  std::ifstream in(std::string(FORCESHADE_SOURCE_DIR) + file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(damped_session, does_what_the_page_says) {
  // The block of the page, line by line.
  const auto damping = std::get<fast::Damping>(fast::Damping::build({.rate = 1000, .damping = 0.002F}));
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  fast::DampedSession session(fast::session_of(law), damping);
  session.step({0, 0, 0});
  const Eigen::Vector3f pressed = session.step({0, 0, -0.1F}).force;    // at 100 mm/s: (0, 0, 0.1) N, twice the spring's
  const Eigen::Vector3f released = session.step({0, 0, -0.05F}).force;  // at 50 mm/s: 0
  session.step_after(3, {0, 0, -0.05F});                                // two positions were missed
  const damping::State state = session.damping().state();
  session.damping().reset();        // a new path
  session.damping().resume(state);  // and back
  // The end of the block.
  EXPECT_EQ(pressed, Eigen::Vector3f(0, 0, 0.1F));
  EXPECT_EQ(released, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(state, (damping::State{true, {0, 0, -0.05F}, {0, 0, 0}, 0}));
  EXPECT_EQ(session.damping().state(), state);

  const std::string page = text_of("/docs/damping.md"), here = text_of("/tests/damping/damped_session_test.cpp");
  const std::size_t begin = page.find("```cpp\n") + 7, end = page.find("```", begin);
  std::istringstream block(page.substr(begin, end - begin));
  int lines = 0;
  for (std::string line; std::getline(block, line); ++lines)
    EXPECT_NE(
        here.find(line.starts_with("#include") ? "\"" + line.substr(10, line.find('>') - 10) + "\"" : "\n  " + line + "\n"),
        std::string::npos)
        << line;
  EXPECT_GE(lines, 10);
}

// Tells how often it was called.
class Counting final : public fast::Session {
 public:
  explicit Counting(int& looks) : looks_(looks) {}
  fast::Evaluation step(const Eigen::Vector3f&) noexcept override { return {{0, 0, 1}, Status::unfinished}; }
  void look_ahead() noexcept override { ++looks_; }
  std::uint64_t shown() const noexcept override { return 17; }

 private:
  int& looks_;
};

TEST(damped_session, is_the_session_itself_where_damping_is_off) {
  int looks = 0;
  auto session = std::make_unique<Counting>(looks);
  const fast::Session* const itself = session.get();
  const auto off = std::get<fast::Damping>(fast::Damping::build({.rate = 1000}));
  EXPECT_EQ(fast::damped(std::move(session), off).get(), itself);
}

TEST(damped_session, hands_on_all_but_the_force) {
  int looks = 0;
  const auto damping = std::get<fast::Damping>(fast::Damping::build({.rate = 1000, .damping = 1}));
  const std::unique_ptr<fast::Session> session = fast::damped(std::make_unique<Counting>(looks), damping);
  session->look_ahead();
  EXPECT_EQ(looks, 1);
  EXPECT_EQ(session->shown(), 17U);
  session->step({0, 0, 0});
  const fast::Evaluation pressed = session->step({0, 0, -0x1p-11F});
  EXPECT_EQ(pressed.status, Status::unfinished) << "a tick that is not finished is damped, too";
  EXPECT_EQ(pressed.force, Eigen::Vector3f(0, 0, 1 + 1000 * 0x1p-11F)) << "one period after the tick before";
}

TEST(damped_session, begins_from_the_state_that_its_damping_has) {
  int looks = 0;
  auto damping = std::get<fast::Damping>(fast::Damping::build({.rate = 1000, .damping = 1}));
  damping.resume({true, {0, 0, 0}, {0, 0, 0}, 0});
  fast::DampedSession session(std::make_unique<Counting>(looks), damping);
  EXPECT_EQ(session.step({0, 0, -1}).force, Eigen::Vector3f(0, 0, 2));
}

}  // namespace
}  // namespace forceshade
