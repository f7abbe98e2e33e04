// SPDX-License-Identifier: BSD-3-Clause
// Haply's Inverse Service and its arm, as a thread of the simulated world.

#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/haply/conversation.h"
#include "device/haply/haply.h"
#include "device/haply/haply_messages.h"
#include "files/csv.h"
#include "tests/world/arms.h"
#include "tests/world/channel.h"

namespace forceshade::world {
namespace {

constexpr Ns kMillisecond = 1'000'000;

// The fault of the next answer of the running session's service.
struct Serving {
  // Another text in place of a part of it, or of the whole; so much too late; one more message before it.
  const char *part = nullptr, *instead = nullptr, *message = nullptr;
  Ns late = 0;
  bool is_unasked = false;
  // It is lost, the service stands still, or it closes the connection for this reason.
  bool is_lost = false, freezes = false;
  const char* closes = nullptr;
};
Serving serving;

using device::haply::Conversation;

constexpr Ns kAnswer = 50'000;
const Eigen::Vector3d kMiddle{0, -150, 200};  // mm, of the workspace

struct Connection {
  Channel<std::string> in, out;
  std::string why;  // the service has closed it
  bool has_lost_client = false;
};

class Service {
 public:
  Service(Arm& arm, std::shared_ptr<Connection> its) : arm_(arm), its_(std::move(its)) {}

  void run() {
    its_->out.send(state(true));
    while (const std::optional<std::string> message = its_->in.receive(system::kForever)) {
      arm_.is_out_of_reach = false;
      const char* force = std::strstr(message->c_str(), R"("vector":)");
      double x = 0, y = 0, z = 0;
      if (force == nullptr) {
        its_->out.send(state(true));
      } else if (std::sscanf(force, R"("vector":{"x":%lf,"y":%lf,"z":%lf})", &x, &y, &z) == 3) {
        arm_.push({x, y, z});
        answer();
      }
      if (!its_->why.empty()) return;
    }
    if (!its_->has_lost_client) arm_.close();
    its_->out.close();
  }

 private:
  void answer() {
    const Serving what = std::exchange(serving, {});
    arm_.is_out_of_reach = what.late > 0 || what.freezes || what.closes;  // until it reads again
    system::sleep_until(system::now() + kAnswer + what.late);
    if (what.closes) {
      its_->why = what.closes;
      return its_->out.close();
    }
    const system::Number nothing = 0;
    while (what.freezes) system::wait_for_change(nothing, 0, system::kForever);
    if (what.is_lost) return;
    std::string text = what.message ? what.message : state(false);
    if (what.part) text.replace(text.find(what.part), std::strlen(what.part), what.instead);
    its_->out.send(text);
    if (what.is_unasked) its_->out.send(text);
  }

  std::string state(bool has_configuration) {
    if (arm_.sent().empty()) arm_.push({0, 0, 0});
    const device::FrameState its = arm_.state();
    const Eigen::Vector3d at = (its.position + kMiddle) / 1000;
    const auto flag = [](bool is) { return is ? "true" : "false"; };
    return std::string(R"({"inverse3":[{"device_id":"049D")") +
           (has_configuration ? R"(,"config":{"type":"inverse3","basis":{"permutation":"XYZ"}})" : "") +
           R"(,"state":{"cursor_position":{"x":)" + shortest(at.x()) + R"(,"y":)" + shortest(at.y()) + R"(,"z":)" +
           shortest(at.z()) + R"(}},"status":{"calibrated":)" + flag(its.calibrated) + R"(,"power_supply":)" +
           flag(its.forces_on) + R"(}}],"verse_grip":[{"state":{"button":)" + flag((its.buttons & 1U) != 0) + "}}]}";
  }

  Arm& arm_;
  std::shared_ptr<Connection> its_;
};

// Our side of the connection.
class Client final : public Conversation {
 public:
  explicit Client(Arm& arm) : arm_(arm), its_(std::make_shared<Connection>()) {
    arm.on_lost = [its = its_] {
      its->has_lost_client = true;
      its->in.close();
    };
    system::Thread(kPartner, [&arm, its = its_] { Service(arm, its).run(); }).leave();
  }
  ~Client() override { its_->in.close(); }

  // The other side's end is waited for.
  void close(Time timeout) noexcept override {
    its_->in.close();
    const Ns until = system::now() + system::in_ns(timeout);
    while (!its_->out.is_closed() && system::now() < until) its_->out.receive(until);
  }

 private:
  void send(std::string_view text) override {
    its_->in.send(std::string(text));
    was_sent();
  }
  void wait(std::int64_t until) override {
    if (is_closed() || keeps_message()) return;
    if (auto text = its_->out.receive(until)) {
      text_ = std::move(*text);
      arm_.answered();
      came(text_);
    } else if (its_->out.is_closed()) {
      was_closed(its_->why);
    }
  }

  Arm& arm_;
  std::shared_ptr<Connection> its_;
  std::string text_;
};

std::unique_ptr<device::Device> open_haply(Arm& arm) {
  static device::Attendant nobody;
  serving = {};
  arm.peak = 5;
  return device::haply::open(std::make_unique<Client>(arm), {3, 5, "3.5.1"}, "", kOptions, nobody);
}

Fault serves(const char* name, const Serving& its, std::vector<std::string> words = {}) {
  return {name, [=](World&, Arm&) { serving = its; }, std::move(words)};
}

// The stand-in's events, with the words that end the run.
std::vector<Fault> faults_of_the_service() {
  const std::string silent = "the Inverse Service has not answered for 25 ms",
                    closed = "the Inverse Service has closed the connection", json = "the Inverse Service: expected JSON";
  return {
      serves("a message without a request", {.is_unasked = true}),
      serves("an answer 5 ms late", {.late = 5 * kMillisecond}),
      serves("an answer 40 ms late", {.late = 40 * kMillisecond}, {silent}),
      serves("a message is lost", {.is_lost = true}, {silent}),
      serves("the service stands still", {.freezes = true}, {silent}),
      serves("the service closes the connection", {.closes = "its words"}, {closed + " (its words)"}),
      serves("the connection is lost", {.closes = "Connection reset by peer"}, {closed + " (Connection reset by peer)"}),
      serves("garbage", {.message = "{\"inverse3\": [{\"device_id\": \"04"}, {json}),
      serves("a number that is NaN", {.part = "\"x\":", .instead = "\"x\":NaN"}, {json}),
      serves("another unit", {.part = "\"x\":", .instead = "\"x\":2.5e3,\"w\":"},
             {"cursor_position: expected x, y and z of at most 2"}),
      serves("its space is scaled",
             {.part = "\"cursor_position\"", .instead = "\"transform\":{\"scale\":{\"x\":2}},\"cursor_position\""},
             {"transform: expected the identity"}),
      serves("no position", {.part = "cursor_position", .instead = "cursor"}, {"a state without a position of the Inverse3"}),
      serves("it is unplugged", {.message = R"({"inverse3":[]})"}, {"the Inverse3 is no longer connected"}),
      serves("another arm", {.part = "049D", .instead = "050E"}, {"the Inverse3 is no longer connected"}),
      {"it is not calibrated any more", [](World&, Arm& arm) { arm.is_calibrated = false; }, {"tripped: uncalibrated"}},
      {"its power is lost", [](World&, Arm& arm) { arm.has_forces_on = false; }},
      {"the arm leaps by 10 mm", [](World&, Arm& arm) { arm.jump(); }, {"tripped: jump"}}};
}

}  // namespace

ArmKind haply_arm() {
  // The device's idle time, which no document has.
  constexpr Ns kOwnWatchdog = 100 * kMillisecond;
  return {"haply", open_haply, kOwnWatchdog, faults_of_the_service()};
}

}  // namespace forceshade::world
