// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/dialogue.h"

#include <string>
#include <system_error>

#include "properties/conformance/doors/answer.h"
#include "properties/conformance/hello_reader.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kProtocol = "conform 1";

}  // namespace

Dialogue::Dialogue(const std::string& command, const ProcessLimits& limits, const char* whose) try
    : whose_(whose), process_(command, limits, whose) {
} catch (const std::system_error& error) {
  throw RendererFailed(std::string("the ") + whose + "'s process could not be made: " + error.what());
}

Json Dialogue::open(const Json& scene) {
  Json said = ask(Json{{"forceshade", kProtocol}, {"scene", scene}}.dump());
  const HelloReader hello(said, whose_);
  if (const std::string protocol = hello.text("forceshade"); protocol != kProtocol)
    throw RendererFailed(std::string("the ") + whose_ + " speaks " + shown(protocol) + "; expected \"" + kProtocol + '"');
  return said;
}

Json Dialogue::ask(const std::string& line) {
  return object_in(say(line), whose_);
}

std::string Dialogue::say(const std::string& line) {
  try {
    return process_.ask(line);
  } catch (const ProcessFailed& failure) {
    throw RendererFailed(failure.what());
  }
}

void Dialogue::say_goodbye() {
  try {
    process_.say_goodbye(R"({"goodbye":true})");
  } catch (const ProcessFailed& failure) {
    throw RendererFailed(failure.what());
  }
}

}  // namespace forceshade::conformance
