// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/trial_log.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "files/input_file.h"
#include "files/printable.h"
#include "study/experiments/json_text.h"

namespace forceshade::experiments {
namespace {

constexpr std::array<std::string_view, 11> kEventNames{"run-started",       "block-started", "trial-started", "radius-changed",
                                                       "match-done",        "answered",      "break-started", "break-ended",
                                                       "question-answered", "session-ended", "run-ended"};
constexpr std::array<std::string_view, 3> kInitialNames{"large", "same", "small"};
constexpr std::string_view kChecksumKey = ",\"crc\":\"";
constexpr std::size_t kChecksumSize = kChecksumKey.size() + 8 + 2;  // eight digits, quote and brace

std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
    table[i] = value;
  }
  return table;
}

std::string hex_of(std::uint32_t value) {
  std::array<char, 9> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", static_cast<unsigned>(value));
  return digits.data();
}

// `line` without its line feed.
bool has_its_checksum(std::string_view line) {
  if (line.size() <= kChecksumSize) return false;
  const std::string_view text = line.substr(0, line.size() - kChecksumSize);
  return line.substr(text.size()) == std::string(kChecksumKey) + hex_of(crc32(text)) + "\"}";
}

template <std::size_t n>
std::size_t place_in(const std::array<std::string_view, n>& names, const Json& name) {
  for (std::size_t i = 0; i < n; ++i)
    if (name == names[i]) return i;
  throw std::invalid_argument("expected a known word, got " + files::printable(name.dump()));
}

Event event_of(std::string_view line, std::size_t number) {
  const Json json = json_of(line);
  if (member(json, "n") != number) throw std::invalid_argument("expected event " + std::to_string(number));
  Event event;
  event.kind = static_cast<EventKind>(place_in(kEventNames, member(json, "event")));
  if (!member(json, "t").is_number()) throw std::invalid_argument("t: expected a number of seconds");
  event.time = member(json, "t").get<double>();
  event.run = whole_member(json, "run");
  const auto whole = [&](const char* key) { return json.contains(key) ? whole_member(json, key) : 0; };
  event.block = whole("block");
  event.index = whole("index");
  event.attempt = whole("attempt");
  event.radius = whole("radius_mil");
  event.answer = whole("answer");
  if (json.contains("text")) event.text = text_member(json, "text");
  if (json.contains("device")) event.device = text_member(json, "device");
  if (json.contains("certified")) {
    if (!member(json, "certified").is_boolean()) throw std::invalid_argument("certified: expected true or false");
    event.certified = member(json, "certified").get<bool>();
  }
  if (json.contains("trial")) {
    const Json& trial = member(json, "trial");
    event.trial = {whole_member(trial, "number"),
                   text_member(trial, "stimulus"),
                   whole_member(trial, "radius_mil"),
                   static_cast<InitialRadius>(place_in(kInitialNames, member(trial, "initial"))),
                   whole_member(trial, "initial_radius_mil"),
                   whole_member(trial, "repetition")};
  }
  return event;
}

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = crc_table();
  std::uint32_t value = UINT32_MAX;
  for (const char byte : bytes) value = table[(value ^ static_cast<unsigned char>(byte)) & 0xFFU] ^ (value >> 8U);
  return ~value;
}

std::string line_of(const Event& event, std::size_t number) {
  Json json{{"n", number}, {"event", kEventNames[static_cast<std::size_t>(event.kind)]}, {"t", event.time}, {"run", event.run}};
  const auto add = [&](const char* key, int value) {
    if (value != 0) json[key] = value;
  };
  add("block", event.block);
  add("index", event.index);
  add("attempt", event.attempt);
  add("radius_mil", event.radius);
  add("answer", event.answer);
  if (event.kind == EventKind::block_started) json["block"] = event.block;  // 0 is the practice
  if (!event.text.empty()) json["text"] = event.text;
  if (!event.device.empty()) json["device"] = event.device;
  if (event.certified) json["certified"] = *event.certified;
  if (event.kind == EventKind::trial_started)
    json["trial"] = {{"number", event.trial.number},
                     {"stimulus", event.trial.stimulus},
                     {"radius_mil", event.trial.radius},
                     {"initial", kInitialNames[static_cast<std::size_t>(event.trial.initial)]},
                     {"initial_radius_mil", event.trial.initial_radius},
                     {"repetition", event.trial.repetition}};
  std::string text = json.dump();
  text.pop_back();  // the closing brace
  return text + std::string(kChecksumKey) + hex_of(crc32(text)) + "\"}\n";
}

LogText read_log(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be opened: " + std::generic_category().message(errno));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw Error(file, "cannot be read: " + std::generic_category().message(errno));
  LogText log;
  while (log.size < text.size()) {
    const std::size_t number = log.events.size() + 1, end = text.find('\n', log.size);
    const std::string_view line = std::string_view(text).substr(log.size, end == std::string::npos ? end : end - log.size);
    const bool is_last = end == std::string::npos || end + 1 == text.size();
    if (end == std::string::npos || !has_its_checksum(line)) {
      if (!is_last) throw Error(file, number, "expected a line with its checksum: the file was changed or the disk is damaged");
      log.note = file.string() + ":" + std::to_string(number) + ": the last line was cut short, most likely by a crash; its " +
                 std::to_string(text.size() - log.size) + " bytes are left out";
      break;
    }
    try {
      log.events.push_back(event_of(line, number));
    } catch (const std::exception& error) {
      throw Error(file, number, files::printable(error.what()));
    }
    log.size = end + 1;
  }
  return log;
}

}  // namespace forceshade::experiments
