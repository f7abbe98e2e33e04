// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A participant's answers, one row a trial: a session yields and the analysis takes them (thesis 5.5, 5.6, chapter 6).

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade::experiments {

// The initial radius of a matching trial beside the reference radius: the symbols +, × and o of the thesis's plots. Where the
// largest or smallest initial radius equals the reference, that trial is still of its own condition.
enum class InitialRadius { large, same, small };

// The one who answers: a person, or a model of one (virtual_participant.h). Sessions of earlier versions and results of other
// programs do not say it.
enum class AnsweredBy { not_recorded, person, model };

// "", "person", "virtual participant": in files.
std::string_view name_of(AnsweredBy who);

// The origin of an answer. Fields that were not recorded are empty.
struct Origin {
  AnsweredBy answered_by = AnsweredBy::not_recorded;
  std::string device = {};             // that gave the forces, by the name with which it was opened; printable
  std::optional<bool> certified = {};  // true if these forces were

  friend bool operator==(const Origin&, const Origin&) = default;
};

struct MatchingResult {
  std::string participant;  // a pseudonym
  int trial = 0;            // from 1, in the order of the session
  bool vision = true;
  std::string stimulus;  // the matching bump, as the protocol names it: bump-1p-shaded and so on
  InitialRadius initial = InitialRadius::same;
  int repetition = 0;  // from 1
  // mil
  double reference_radius = 0, initial_radius = 0, final_radius = 0;
  int satisfaction = 0;  // 1 to 10
  int steps = 0;         // changes of the radius
  double seconds = 0;    // from the first tick of the trial to the satisfaction entered
  Origin origin = {};
};

struct ClassificationResult {
  std::string participant;
  int trial = 0;
  std::string stimulus;
  double radius = 0;  // mil
  int repetition = 0;
  int answer = 0;  // 1 to 4: plane, two polygons, three polygons, cylinder (figure 5-8)
  double seconds = 0;
  Origin origin = {};
};

// The matching radius through one trial: figure 6-6 of the thesis.
struct RadiusChange {
  std::string participant;
  int trial = 0;
  int step = 0;        // 0 for the initial radius, then 1 to MatchingResult::steps
  double seconds = 0;  // since the trial's first tick
  double radius = 0;   // mil
};

// Practice trials are not among them.
struct Results {
  std::vector<MatchingResult> matching;
  std::vector<ClassificationResult> classification;
  std::vector<RadiusChange> radius_changes;  // of the matching trials, in their order
};

}  // namespace forceshade::experiments
