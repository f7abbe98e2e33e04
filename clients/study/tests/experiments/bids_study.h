// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two sessions and their export to BIDS, and how its files are read.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "study/experiments/bids.h"
#include "study/experiments/virtual_participant.h"
#include "study/tests/experiments/example_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {

inline std::string text_of(const std::filesystem::path& file) {
  return (std::ostringstream() << std::ifstream(file, std::ios::binary).rdbuf()).str();
}

using Rows = std::vector<std::vector<std::string>>;

inline Rows rows_of(const std::filesystem::path& file) {
  Rows rows;
  std::istringstream in(text_of(file));
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream fields(line + '\t');
    for (std::string field; std::getline(fields, field, '\t');) row.push_back(field);
  }
  return rows;
}

inline nlohmann::json json_of(const std::filesystem::path& file) {
  return nlohmann::json::parse(text_of(file), nullptr, false);
}

inline bool is_number(const std::string& text) {
  static const std::regex number(R"([-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?)");  // schema: objects.formats.number
  return std::regex_match(text, number);
}

// Two sessions: one finished by a virtual participant, one interrupted in a trial and in a break, with made ticks.
class Bids : public testing::Test {
 protected:
  void SetUp() override {
    Protocol protocol = read_protocol(kExamples / "matching.toml");
    std::ifstream in(kExamples / "matching.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("[600, 800, 1000, 1200, 1400]", "[1000]");
    replace("repetitions = 4", "repetitions = 1");
    replace("trials_before_break = 20", "trials_before_break = 2");
    replace("\"english.toml\"", '"' + (kExamples / "english.toml").string() + '"');
    const std::string file = directory.write("p.toml", text);
    sessions = run_virtual_study(directory.file("study"), file, 1, 3);
    const std::filesystem::path second = directory.file("second");
    for (int run = 1; run <= 2; ++run) {
      RecordedSession recorded =
          run == 1 ? RecordedSession::start(second, file, "B-2", 1, {}, Sync::never, {AnsweredBy::person, "an arm", true})
                   : RecordedSession::resume(second, {}, Sync::never, {AnsweredBy::person, "an arm", false});
      VirtualParticipant participant(protocol, fitted_observer(), feel_of_laws(protocol), 5);
      double time = 0;
      const auto has_run = [&] {
        return run == 1 ? recorded.session().current() && !recorded.session().current()->is_practice
                        : recorded.session().screen().title == "A break";
      };
      while (!has_run()) {
        const Response response = participant.next(recorded.session().screen(), recorded.session().scene());
        recorded.session().press(response.press, time += response.seconds);
      }
    }
    sessions.push_back(second);
    export_bids(sessions, out(), [&](const std::filesystem::path& session, int run) -> std::optional<Motion> {
      if (session != second || run != 2) return std::nullopt;
      return Motion{1000, "maker", "model", [i = 0]() mutable -> std::optional<MotionSample> {
                      if (++i > 5) return std::nullopt;
                      return MotionSample{0.001 * i, 1e-7, 0, -2.5, 0, 0, 1};
                    }};
    });
  }

  std::filesystem::path out() const { return directory.file("bids"); }

  tests::TemporaryDirectory directory;
  std::vector<std::filesystem::path> sessions;
};

}  // namespace forceshade::experiments
