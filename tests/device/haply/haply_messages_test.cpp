// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply_messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "device/haply/conversation.h"
#include "device/haply/haply.h"
#include "device/haply/haply_link.h"
#include "forceshade/device.h"
#include "tests/support/words.h"

namespace forceshade::device::haply {
namespace {

void expect_refused(const std::string& words, const std::string& expected) {
  tests::expect_words(words, {expected});
}

std::string state(const std::string& position, const std::string& status = R"({"calibrated":true})") {
  return R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":)" + position + R"(},"status":)" + status + "}]}";
}

TEST(haply_messages, the_version_chooses_the_key_of_a_force) {
  const Eigen::Vector3d force(0.5, -1.25, 1e-5);
  for (const auto& [text, key] :
       {std::pair{"3.1.0", "values"}, {"3.4.9", "values"}, {"3.5.0", "vector"}, {"3.12.1", "vector"}}) {
    const Version version = version_of(std::string(R"({"ok":true,"data":{"version":")") + text + "\"}}");
    EXPECT_EQ(version.text, text);
    const auto json = nlohmann::json::parse(Frames(version, "049D").with_force(force));
    const auto& command = json["inverse3"][0]["commands"]["set_cursor_force"];
    EXPECT_EQ(command.size(), 1U);
    EXPECT_EQ(command[key]["x"], 0.5);
    EXPECT_EQ(command[key]["y"], -1.25);
    EXPECT_EQ(command[key]["z"], 1e-5);
    EXPECT_EQ(nlohmann::json::parse(configuration(version))["session"]["configure"].contains("basis"),
              key == std::string("vector"));
  }
}

TEST(haply_messages, other_versions_are_refused_in_words) {
  EXPECT_EQ(version_of("3.5.1").minor, 5);
  EXPECT_EQ(version_of("\"3.5\"").minor, 5);
  for (const char* text : {"2.2.0", "3.0.1", "4.0.0"})
    expect_refused(tests::thrown_by<Error>([&] { version_of(text); }),
                   std::string("expected 3.1 or later, below 4, got ") + text);
  for (const char* text : {"", "{}", "<html>", R"({"ok":false,"error":"no"})", "99999999999999999999.1"})
    expect_refused(tests::thrown_by<Error>([&] { version_of(text); }), "version: expected");
}

TEST(haply_messages, lengths_are_in_millimetres) {
  const Message message = message_of(state(R"({"x":0.01,"y":-0.15,"z":0.2})"));
  ASSERT_EQ(message.arms.size(), 1U);
  EXPECT_LT((*message.arms[0].position - Eigen::Vector3d(10, -150, 200)).norm(), 1e-12);
  EXPECT_TRUE(message.arms[0].calibrated);
}

TEST(haply_messages, what_is_no_position_is_refused) {
  for (const char* position : {R"({"x":0.01,"y":-0.15})", R"({"x":0.01,"y":-0.15,"z":null})", R"({"x":0.01,"y":"0","z":0.2})",
                               "[0,0,0]", R"({"x":10.0,"y":-150.0,"z":200.0})", R"({"x":1e999,"y":0,"z":0})"})
    EXPECT_FALSE(tests::thrown_by<Error>([&] { message_of(state(position)); }).empty()) << position;
  for (const char* text : {"", "{", "[]", "7", R"({"inverse3":[{"state":{}}]})",
                           R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":NaN,"y":0,"z":0}}}]})"})
    EXPECT_FALSE(tests::thrown_by<Error>([&] { message_of(text); }).empty()) << text;
}

// Parts that are left out are the identity's.
TEST(haply_messages, a_mount_or_transform_that_is_not_the_identity_is_found) {
  const auto altered = [](const std::string& config, const std::string& transform) {
    return message_of(R"({"inverse3":[{"device_id":"1","config":{)" + config + R"(},"state":{"transform":)" + transform +
                      "}}]}")
        .arms[0]
        .altered;
  };
  EXPECT_EQ(altered("", "{}"), "");
  EXPECT_EQ(altered(R"("mount":{"position":{"x":0},"rotation":{"w":1,"z":0.0},"scale":{"y":1}})", R"({"rotation":{"w":-1}})"),
            "");
  for (const char* other : {R"({"position":{"z":0.001}})", R"({"rotation":{"w":0.9999,"x":0.014}})", R"({"scale":{"x":2}})",
                            R"({"scale":{"y":"1"}})", R"({"rotation":[1,0,0,0]})", R"("none")"}) {
    EXPECT_NE(altered("", other).find("transform: expected the identity"), std::string::npos) << other;
    EXPECT_NE(altered(R"("mount":)" + std::string(other), "{}").find("mount: expected the identity"), std::string::npos)
        << other;
    EXPECT_NE(altered(R"("transform":)" + std::string(other), "{}").find("transform: expected"), std::string::npos) << other;
  }
}

TEST(haply_messages, what_says_nothing_of_its_calibration_has_none) {
  constexpr const char* kPosition = R"({"x":0,"y":0,"z":0})";
  EXPECT_FALSE(message_of(state(kPosition, "{}")).arms[0].calibrated);
  EXPECT_FALSE(message_of(state(kPosition, R"({"calibrated":"yes"})")).arms[0].calibrated);
  EXPECT_FALSE(message_of(state(kPosition, R"({"calibration_state":1})")).arms[0].calibrated);
  EXPECT_TRUE(message_of(state(kPosition, R"({"calibration_state":2})")).arms[0].calibrated);
}

TEST(haply_messages, other_sessions_than_ours_are_counted) {
  for (const auto& [answer, words] :
       {std::pair{"{}", ""},
        {"[]", ""},
        {R"([{"id":7}])", ""},
        {R"([{"id":7},{"id":8}])", "1 other session of the Inverse Service is open; its forces would be added"},
        {R"({"data":[1,2,3]})", "2 other sessions of the Inverse Service are open; their forces would be added"}})
    EXPECT_EQ(words_of_other_sessions(sessions_in(answer)), words) << answer;
}

// Answers each message with the next of these texts, and keeps what it was sent.
class Scripted final : public Conversation {
 public:
  explicit Scripted(std::vector<std::string> answers, std::vector<std::string>* sent = nullptr)
      : answers_(std::move(answers)), sent_(sent) {}
  void close(Time) noexcept override {}

 private:
  void send(std::string_view text) override {
    if (sent_ != nullptr) sent_->emplace_back(text);
    ++asked_;
    was_sent();
  }
  void wait(std::int64_t) override {
    if (!keeps_message() && told_ < std::min(asked_, answers_.size())) came(answers_[told_++]);
  }

  std::vector<std::string> answers_;
  std::vector<std::string>* sent_;
  std::size_t asked_ = 1, told_ = 0;  // the service speaks first
};

const Version kVersion = version_of("3.5.1");

std::string with_status(const std::string& status) {
  return state(R"({"x":0,"y":-0.15,"z":0.2})", status);
}

TEST(haply_link, gives_forces_only_where_arm_power_and_user_let_it) {
  struct Case {
    const char* status;
    bool may_force, calibrated, forces_on;
    const char* words;
  };
  for (const Case& its :
       {Case{R"({"calibrated":true})", true, true, true, ""},
        {R"({"calibrated":true,"power_supply":true,"ready":true})", true, true, true, ""},
        {R"({"calibrated":false})", true, false, true, ""},
        {R"({"calibrated":true,"power_supply":false})", true, true, false, "its power supply is off"},
        {R"({"calibrated":true,"ready":false})", true, true, false, "the service reports that it is not ready"},
        {R"({"calibrated":true})", false, true, false, ""}}) {
    std::vector<std::string> sent;
    Link link(std::make_unique<Scripted>(std::vector{with_status("{}"), with_status("{}"), with_status(its.status)}, &sent),
              kVersion, "049D", {.force = its.may_force});
    EXPECT_EQ(link.exchange({0, 0, 0.5}).position.norm(), 0);
    const FrameState seen = link.exchange({0, 0, 0.5});
    EXPECT_EQ(seen.calibrated, its.calibrated) << its.status;
    EXPECT_EQ(seen.forces_on, its.forces_on) << its.status;
    EXPECT_STREQ(seen.forces_off, its.words);
    EXPECT_EQ(sent.back().find("set_cursor_force") != std::string::npos, its.may_force);
  }
}

TEST(haply_device, is_refused_where_forces_would_be_anothers_or_go_another_way) {
  const auto opening = [](const std::string& config, const std::string& status) -> std::string {
    const std::string text = R"({"inverse3":[{"device_id":"049D","config":{)" + config + R"(},"status":)" + status + "}]}";
    Attendant nobody;
    return tests::thrown_by<DeviceError>([&] {
      open(std::make_unique<Scripted>(std::vector{text, text}), kVersion, "", {}, nobody);
    });
  };
  EXPECT_EQ(opening("", "{}"), "");
  EXPECT_EQ(opening(R"("basis":"XYZ")", R"({"in_use":false})"), "");
  expect_refused(opening("", R"({"in_use":true})"), "another program uses the Inverse3 049D");
  expect_refused(opening(R"("basis":"XZY")", "{}"), "the Inverse Service's basis: expected XYZ, got XZY");
  expect_refused(opening(R"("basis":{"permutation":"YXZ"})", "{}"), "expected XYZ, got YXZ");
  expect_refused(opening(R"("mount":{"scale":{"x":2}})", "{}"), "mount: expected the identity");
}

TEST(haply_messages, the_buttons_are_those_of_the_first_grip) {
  const auto buttons = [](const char* grips) { return message_of(grips).buttons; };
  EXPECT_EQ(buttons(R"({"verse_grip":[{"state":{"button":true}}]})"), 1);
  EXPECT_EQ(buttons(R"({"wireless_verse_grip":[{"state":{"buttons":{"a":false,"b":true,"c":true}}}]})"), 6);
  EXPECT_EQ(buttons(R"({"wireless_verse_grip":[{"state":{"awake":false,"buttons":{"a":true}}}]})"), 0);
  EXPECT_EQ(buttons(R"({"verse_grip":[{"state":{}},{"state":{"button":true}}]})"), 0);
}

TEST(haply_messages, an_arm_is_chosen_by_its_id_or_serial_number_or_because_it_is_alone) {
  const Message
      none = message_of(R"({"inverse3":[]})"),
      two = message_of(
          R"({"inverse3":[{"device_id":"A1","config":{"device_info":{"uuid":"u-1"}}},{"device_id":"B2","config":{}}]})");
  EXPECT_EQ(chosen(two, "B2").id, "B2");
  EXPECT_EQ(chosen(two, "u-1").id, "A1");
  expect_refused(tests::thrown_by<Error>([&] { chosen(two, ""); }), "several Inverse3 are connected (A1, B2)");
  expect_refused(tests::thrown_by<Error>([&] { chosen(two, "C3"); }), "C3 is not connected; the Inverse Service lists A1, B2");
  expect_refused(tests::thrown_by<Error>([&] { chosen(none, ""); }), "no Inverse3 is connected");
}

}  // namespace
}  // namespace forceshade::device::haply
