// SPDX-License-Identifier: BSD-3-Clause
#include "study/command/trial_profiles.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "apps/command.h"
#include "study/apparatus/motion.h"
#include "study/experiments/session_results.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;
using experiments::EventKind;
using experiments::Experiment;
using experiments::SavedSession;

constexpr std::size_t kMostPoints = 6000;  // of a figure: five of them on each of its pixels across

struct Named {
  std::string words, participant;
  int trial = 0;
};

Named named(const std::string& words) {
  Named one{words, words.substr(0, words.rfind(':'))};
  const char* const end = words.data() + words.size();
  const char* const number = words.data() + std::min(words.size(), one.participant.size() + 1);
  const auto [last, error] = std::from_chars(number, end, one.trial);
  if (error != std::errc() || last != end || one.trial < 1 || one.participant.empty())
    throw Error("--trial: expected PARTICIPANT:NUMBER such as P-01:12, got \"" + words + '"');
  return one;
}

// The ticks of the trial as it was answered, out of the log.
struct Span {
  int run = 0;
  double from = 0, to = 0;  // s since the run's first tick
  experiments::Trial trial;
  experiments::Mil radius = 0;  // of the bump that was matched or classified, at the end
};

std::optional<Span> span_of(const SavedSession& session, const Named& one) {
  if (session.participant != one.participant) return std::nullopt;
  std::optional<Span> found, going;
  const std::vector<experiments::TrialUse> uses = experiments::uses_of(session);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const experiments::Event& event = session.events[i];
    if (uses[i] != experiments::TrialUse::result) continue;
    if (event.kind == EventKind::trial_started) {
      going = Span{event.run, event.time, 0, event.trial, event.trial.radius};
    } else if (event.kind == EventKind::answered && going && going->trial.number == one.trial) {
      going->to = event.time;
      if (session.protocol.experiment == Experiment::matching) going->radius = event.radius;
      found = going;
    }
  }
  return found;
}

std::vector<analysis::Position> positions_of(const fs::path& folder, const Span& span) {
  std::vector<analysis::Position> all, some;
  const auto motion = apparatus::motion_of(folder, span.run);
  if (!motion) return {};
  while (const auto sample = motion->next()) {
    if (sample->time > span.to) break;
    if (sample->time >= span.from) all.push_back({sample->x, sample->z});
  }
  const std::size_t step = all.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

// One law's surface between two places, all in mil; nothing of a height map or mesh.
void add_surface(const SavedSession& session, const experiments::Stimulus& stimulus, experiments::Mil radius, double centre,
                 double from, double to, std::vector<analysis::Position>& line) {
  if (stimulus.kind != experiments::StimulusKind::law) return;
  const double mil = experiments::kMillimetresPerMil;
  const std::vector<analysis::Position> more =
      analysis::nominal_line(stimulus.law, session.protocol.parameters(radius), centre * mil, from * mil, to * mil);
  line.insert(line.end(), more.begin(), more.end());
}

std::vector<analysis::Position> surface_of(const SavedSession& session, const Span& span) {
  const experiments::Protocol& protocol = session.protocol;
  const experiments::Stimulus& stimulus = protocol.stimulus(span.trial.stimulus);
  std::vector<analysis::Position> line;
  if (protocol.experiment == Experiment::matching) {
    const double spacing = protocol.spacing;
    add_surface(session, protocol.reference, span.trial.radius, -spacing / 2, -spacing, 0, line);
    add_surface(session, stimulus, span.radius, spacing / 2, 0, spacing, line);
  } else {
    add_surface(session, stimulus, span.radius, 0, -protocol.width, protocol.width, line);
  }
  return line;
}

// "P-01, bump-2p-shaded, 920 mil at the end, reference 800 mil, trial 12"; a shape of one size has no radius.
std::string title_of_positions(const SavedSession& session, const Span& span, const Named& one) {
  const bool is_matching = session.protocol.experiment == Experiment::matching;
  std::string title = one.participant + ", " + span.trial.stimulus;
  if (span.radius > 0) title += ", " + std::to_string(span.radius) + (is_matching ? " mil at the end" : " mil");
  if (is_matching) title += ", reference " + std::to_string(span.trial.radius) + " mil";
  return title + ", trial " + std::to_string(one.trial);
}

std::optional<analysis::RadiusProfile> radius_profile(const experiments::Results& results, const Named& one) {
  const auto is_its = [&](const auto& row) { return row.participant == one.participant && row.trial == one.trial; };
  const auto trial = std::ranges::find_if(results.matching, is_its);
  if (trial == results.matching.end()) return std::nullopt;
  analysis::RadiusProfile profile{one.participant + ", " + trial->stimulus + (trial->vision ? ", vision" : ", no vision") +
                                      ", trial " + std::to_string(one.trial),
                                  trial->reference_radius,
                                  {}};
  for (const experiments::RadiusChange& change : results.radius_changes)
    if (is_its(change)) profile.changes.push_back({change.seconds, change.radius});
  if (profile.changes.empty()) return std::nullopt;
  return profile;
}

}  // namespace

analysis::Profiles profiles_of(const std::vector<std::string>& trials, const std::vector<fs::path>& folders,
                               const experiments::Results& results) {
  std::vector<Named> all;
  for (const std::string& words : trials) all.push_back(named(words));
  analysis::Profiles profiles;
  std::vector<bool> has_profile(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (auto profile = radius_profile(results, all[i])) {
      profiles.radii.push_back(std::move(*profile));
      has_profile[i] = true;
    }
  for (const fs::path& folder : all.empty() ? std::vector<fs::path>{} : folders) {
    if (!fs::exists(folder / "trials.jsonl")) continue;
    const SavedSession session = experiments::read_session(folder);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto span = span_of(session, all[i]);
      if (!span) continue;
      std::vector<analysis::Position> positions = positions_of(folder, *span);
      if (positions.empty()) continue;
      profiles.positions.push_back(
          {title_of_positions(session, *span, all[i]), std::move(positions), surface_of(session, *span)});
      has_profile[i] = true;
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!has_profile[i])
      throw Error(
          "--trial: expected an answered trial with its radii (radius.csv) or its ticks (the folder of a session), got " +
          all[i].words);
  return profiles;
}

}  // namespace forceshade::apps
