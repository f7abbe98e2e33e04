// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/dialogue.h"

#include <string>
#include <system_error>

#include "files/child_process.h"
#include "files/json_line.h"
#include "files/printable.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kProtocol = "conform 1";

}  // namespace

Dialogue::Dialogue(const std::string& command, const files::ProcessLimits& limits, const char* whose) try
    : whose_(whose), process_(command, limits, whose) {
} catch (const std::system_error& error) {
  throw files::ProcessFailed(std::string("the ") + whose + "'s process could not be made: " + error.what());
}

Json Dialogue::open(const Json& scene) {
  Json said = ask(Json{{"forceshade", kProtocol}, {"scene", scene}}.dump());
  const files::KeyReader hello(said, std::string("the ") + whose_ + "'s hello");
  if (const std::string protocol = hello.text("forceshade"); protocol != kProtocol)
    throw files::ProcessFailed(std::string("the ") + whose_ + " speaks " + files::shown(protocol) + "; expected \"" +
                               kProtocol + '"');
  return said;
}

Json Dialogue::ask(const std::string& line) {
  return files::object_in(say(line), whose_);
}

std::string Dialogue::say(const std::string& line) {
  return process_.ask(line);
}

void Dialogue::say_goodbye() {
  process_.say_goodbye(R"({"goodbye":true})");
}

const nlohmann::ordered_json& list_in(const nlohmann::ordered_json& answer, const char* key, std::size_t size,
                                      const char* asked, const char* whose) {
  const auto all = answer.find(key);
  if (all == answer.end() || !all->is_array())
    throw files::ProcessFailed(std::string("the ") + whose + " answered without a list \"" + key +
                               "\": " + files::shown_json(answer));
  if (all->size() != size)
    throw files::ProcessFailed(std::string("the ") + whose + " answered " + std::to_string(size) + ' ' + asked + " with " +
                               std::to_string(all->size()) + " entries of \"" + key + '"');
  return *all;
}

}  // namespace forceshade::conformance
