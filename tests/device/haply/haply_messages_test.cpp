// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply_messages.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace forceshade::device::haply {
namespace {

// What it throws, or "".
template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const Unexpected& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& words, const std::string& expected) {
  EXPECT_NE(words.find(expected), std::string::npos) << '"' << words << "\" lacks \"" << expected << '"';
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
    expect_refused(refusal([&] { version_of(text); }), std::string("expected 3.1 or later, below 4, got ") + text);
  for (const char* text : {"", "{}", "<html>", R"({"ok":false,"error":"no"})", "99999999999999999999.1"})
    expect_refused(refusal([&] { version_of(text); }), "version: expected");
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
    EXPECT_FALSE(refusal([&] { message_of(state(position)); }).empty()) << position;
  for (const char* text : {"", "{", "[]", "7", R"({"inverse3":[{"state":{}}]})",
                           R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":NaN,"y":0,"z":0}}}]})"})
    EXPECT_FALSE(refusal([&] { message_of(text); }).empty()) << text;
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
  expect_refused(refusal([&] { chosen(two, ""); }), "several Inverse3 are connected (A1, B2)");
  expect_refused(refusal([&] { chosen(two, "C3"); }), "C3 is not connected; the Inverse Service lists A1, B2");
  expect_refused(refusal([&] { chosen(none, ""); }), "no Inverse3 is connected");
}

}  // namespace
}  // namespace forceshade::device::haply
