// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/origins.h"

#include <algorithm>
#include <utility>

#include "files/printable.h"
#include "study/analysis/tables.h"

namespace forceshade::analysis {
namespace {

using experiments::AnsweredBy;
using experiments::Origin;

std::string joined(const std::vector<std::string>& all, const char* between = ", ") {
  std::string text;
  for (const std::string& one : all) text += (text.empty() ? "" : between) + one;
  return text;
}

std::string trials(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " trial" : " trials");
}

void add(Origins& origins, const std::string& participant, const Origin& origin) {
  std::vector<std::string>& its = origin.answered_by == AnsweredBy::person  ? origins.people
                                  : origin.answered_by == AnsweredBy::model ? origins.models
                                                                            : origins.not_recorded;
  if (std::ranges::find(its, participant) == its.end()) its.push_back(participant);
  ++origins.devices[origin.device];
  ++(!origin.certified ? origins.unknown : *origin.certified ? origins.certified : origins.uncertified);
}

std::string sentence_of_devices(const Origins& origins) {
  std::vector<std::string> words;
  for (const auto& [device, count] : origins.devices)
    words.push_back((device.empty() ? "not recorded" : device) + " (" + trials(count) + ")");
  return (words.size() == 1 ? "Device: " : "Devices: ") + joined(words) + '.';
}

std::string sentence_of_forces(const Origins& origins) {
  std::vector<std::string> words;
  if (origins.certified > 0) words.push_back("certified in " + trials(origins.certified));
  if (origins.uncertified > 0) words.push_back("not certified in " + trials(origins.uncertified));
  if (origins.unknown > 0) words.push_back("not known to be certified in " + trials(origins.unknown));
  return "Forces: " + joined(words) + '.';
}

}  // namespace

Origins origins_of(const experiments::Results& results) {
  Origins origins;
  for (const auto& trial : results.matching) add(origins, trial.participant, trial.origin);
  for (const auto& trial : results.classification) add(origins, trial.participant, trial.origin);
  return origins;
}

std::string fault_of(const Origins& origins) {
  if (origins.models.empty() || (origins.people.empty() && origins.not_recorded.empty())) return "";
  const std::string& other = origins.people.empty() ? origins.not_recorded.front() : origins.people.front();
  return "expected people or virtual participants, got both: " + files::printable(origins.models.front()) +
         " is a virtual participant, a model, and " + files::printable(other) +
         (origins.people.empty() ? " is not recorded as one" : " is a person") + "; analyse them separately";
}

std::vector<std::string> sentences_of(const Origins& origins) {
  std::vector<std::string> all;
  if (origins.devices.empty()) return all;
  if (origins.are_virtual()) all.emplace_back("These are virtual participants: a model answered, and no person.");
  if (origins.people.empty() && !origins.not_recorded.empty())
    all.emplace_back("It was not recorded who answered, a person or a model.");
  else if (!origins.not_recorded.empty())
    all.push_back("It was not recorded who answered, a person or a model, for " + joined(origins.not_recorded) + '.');
  all.push_back(sentence_of_devices(origins));
  all.push_back(sentence_of_forces(origins));
  return all;
}

std::string answered_by(const Origins& origins, const std::string& participant) {
  std::vector<std::string> words;
  for (const auto& [names, word] : {std::pair(&origins.people, name_of(AnsweredBy::person)),
                                    {&origins.models, name_of(AnsweredBy::model)},
                                    {&origins.not_recorded, std::string_view("not recorded")}})
    if (!names->empty() && (participant == kOverall || std::ranges::find(*names, participant) != names->end()))
      words.emplace_back(word);
  return joined(words, " and ");
}

}  // namespace forceshade::analysis
