// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/stimulus_list.h"

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <exception>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "files/input_file.h"
#include "files/printable.h"
#include "study/experiments/json_text.h"

namespace forceshade::experiments {
namespace {

// binary32 as binary64, which JSON gives back.
float length_of(const Json& value, const char* key) {
  const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(std::fabs(number) <= static_cast<double>(std::numeric_limits<float>::max())))
    throw std::invalid_argument(std::string(key) + ": expected a number of millimetres");
  return static_cast<float>(number);
}

Json json_of_side(const std::optional<ListedBump>& bump) {
  if (!bump) return nullptr;
  Json origin = Json::array();
  for (const float coordinate : bump->origin) origin.push_back(static_cast<double>(coordinate));
  return {{"stimulus", bump->stimulus},       {"radius_mil", bump->radius},
          {"origin_mm", std::move(origin)},   {"subject", json_of(bump->subject)},
          {"certificate", bump->certificate}, {"certificate_digest", bump->certificate_digest}};
}

std::optional<ListedBump> side_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  ListedBump bump;
  bump.stimulus = text_member(json, "stimulus");
  bump.radius = whole_member(json, "radius_mil", 0);
  const Json& origin = member(json, "origin_mm");
  if (!origin.is_array() || origin.size() != bump.origin.size())
    throw std::invalid_argument("origin_mm: expected a list of three numbers");
  for (std::size_t i = 0; i < bump.origin.size(); ++i) bump.origin[i] = length_of(origin[i], "origin_mm");
  bump.subject = member(json, "subject").dump();
  bump.certificate = text_member(json, "certificate");
  bump.certificate_digest = text_member(json, "certificate_digest");
  return bump;
}

ListedStimulus stimulus_of(const std::string& line, std::size_t number) {
  const Json json = json_of(line);
  ListedStimulus stimulus;
  // Each offer has the next number.
  stimulus.number = static_cast<std::uint32_t>(whole_member(json, "number", 1));
  if (stimulus.number != number) throw std::invalid_argument("number: expected " + std::to_string(number));
  stimulus.seam = length_of(member(json, "seam_mm"), "seam_mm");
  stimulus.left = side_of(member(json, "left"));
  stimulus.right = side_of(member(json, "right"));
  return stimulus;
}

}  // namespace

std::string line_of(const ListedStimulus& stimulus) {
  return Json{{"number", stimulus.number},
              {"seam_mm", static_cast<double>(stimulus.seam)},
              {"left", json_of_side(stimulus.left)},
              {"right", json_of_side(stimulus.right)}}
             .dump() +
         '\n';
}

std::vector<ListedStimulus> read_stimuli(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be opened: " + std::generic_category().message(errno));
  std::vector<ListedStimulus> all;
  for (std::string line; std::getline(in, line) && !in.eof();) {
    try {
      all.push_back(stimulus_of(line, all.size() + 1));
    } catch (const std::exception& error) {
      throw Error(file, all.size() + 1, files::printable(error.what()));
    }
  }
  if (in.bad()) throw Error(file, "cannot be read: " + std::generic_category().message(errno));
  return all;
}

}  // namespace forceshade::experiments
