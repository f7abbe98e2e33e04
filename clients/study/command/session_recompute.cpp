// SPDX-License-Identifier: BSD-3-Clause
#include "study/command/session_recompute.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/command_check.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "forceshade/checks.h"
#include "forceshade/properties.h"
#include "properties/binary32.h"
#include "run/recorder/settings.h"
#include "run/summary.h"
#include "study/apparatus/bumps.h"
#include "study/apparatus/motion.h"
#include "study/experiments/session_folder.h"
#include "study/experiments/stimulus_list.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;
using experiments::Bump;

constexpr std::uint64_t kShownDifferences = 10;  // differences

// run-1, run-2 and so on, in that order.
std::vector<fs::path> runs_of(const fs::path& session) {
  std::vector<fs::path> runs;
  for (int run = 1; fs::is_directory(experiments::ticks_of_run(session, run)); ++run)
    runs.push_back(experiments::ticks_of_run(session, run));
  if (runs.empty()) throw Error(session.string() + ": expected a session with ticks/run-1, got none");
  return runs;
}

// The subjects of a protocol's bumps, each read once.
class Subjects {
 public:
  explicit Subjects(experiments::Protocol protocol) : bumps_(std::move(protocol), read_with_progress) {}

  const properties::Subject& of(const Bump& bump) {
    std::shared_ptr<const properties::Subject>& subject = kept_[{bump.stimulus, bump.radius}];
    if (!subject) subject = properties::subject_of(bumps_.description(bump));
    return *subject;
  }

 private:
  apparatus::Bumps bumps_;
  std::map<std::pair<std::string, experiments::Mil>, std::shared_ptr<const properties::Subject>> kept_;
};

// One side of a stimulus.
struct Side {
  Bump bump;
  Eigen::Vector3f origin;
};

struct Line {
  std::optional<Side> left, right;
  float seam = 0;
};

// The stimuli of stimuli.jsonl.
class Stimuli {
 public:
  Stimuli(const fs::path& file, Subjects& subjects) {
    for (const experiments::ListedStimulus& listed : experiments::read_stimuli(file)) {
      Line line{.left = std::nullopt, .right = std::nullopt, .seam = listed.seam};
      for (const auto& [side, its] : {std::pair{&line.left, &listed.left}, std::pair{&line.right, &listed.right}}) {
        if (!*its) continue;
        const Bump bump{(*its)->stimulus, (*its)->radius, 0};
        const auto& [x, y, z] = (*its)->origin;
        if (const std::string subject = run::summary_of(subjects.of(bump).identity()).dump(); (*its)->subject != subject)
          throw Error(file.string() + ":" + std::to_string(listed.number) + ": the rendered " + apparatus::words_of(bump) +
                      " was " + (*its)->subject + "; the protocol's is " + subject);
        *side = Side{bump, {x, y, z}};
      }
      lines_[listed.number] = line;
    }
  }

  const Line* find(std::uint32_t number) const {
    const auto found = lines_.find(number);
    return found == lines_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::uint32_t, Line> lines_;
};

// The exact definition of a stimulus along the path since it was first stepped.
class Definition {
 public:
  Definition(std::uint32_t number, const Line& line, Subjects& subjects) : number_(number), line_(line) {
    if (line.left) left_ = subjects.of(line.left->bump).open_reference();
    if (line.right) right_ = subjects.of(line.right->bump).open_reference();
  }

  std::uint32_t number() const { return number_; }

  // Both sides follow the path, as in the stage.
  reference::Rounded step(const Eigen::Vector3f& position) {
    const auto answer = [&](auto& reference, const std::optional<Side>& side) {
      return reference ? reference->step(position - side->origin) : reference::Rounded{};
    };
    const reference::Rounded left = answer(left_, line_.left);
    if (!right_) return left;
    const reference::Rounded right = answer(right_, line_.right);
    return position.x() < line_.seam ? left : right;
  }

 private:
  std::uint32_t number_;
  Line line_;
  std::unique_ptr<properties::ReferenceSession> left_, right_;
};

struct Counts {
  std::uint64_t ticks = 0, contacts = 0, differences = 0;
};

// One run, from its first tick through all of its parts.
class Run {
 public:
  Run(const fs::path& folder, Subjects& subjects, const std::optional<damping::Parameters>& damping)
      : subjects_(subjects), stimuli_(folder / "stimuli.jsonl", subjects), name_(folder.string()) {
    if (damping) damping_ = std::get<reference::Damping>(reference::Damping::build(*damping));
  }

  void compute(const recorder::Recording& recording, const device::Sample& sample, Counts& counts) {
    const auto& [x, y, z] = sample.position;
    const Eigen::Vector3f position(x, y, z);
    ++counts.ticks;
    const auto shown = static_cast<std::uint32_t>(sample.shown), waiting = static_cast<std::uint32_t>(sample.shown >> 32U);
    // The one that waited last may be the one that is felt now.
    if (shown != number_of(current_)) {
      current_ = shown == number_of(waiting_) ? std::move(waiting_) : opened(shown, recording, sample);
      waiting_.reset();
    }
    if (waiting != number_of(waiting_)) waiting_ = waiting == 0 ? nullptr : opened(waiting, recording, sample);
    reference::Rounded exact = current_ ? current_->step(position) : reference::Rounded{};
    if (damping_) exact = damping_->tick(position, sample.periods(), exact);
    if (waiting_) waiting_->step(position);
    counts.contacts += finished(exact.status) == Status::contact ? 1 : 0;
    const auto& [fx, fy, fz] = sample.law_force;
    if (finished(exact.status) == finished(sample.law_status()) && (exact.force.array() == Eigen::Array3f(fx, fy, fz)).all())
      return;
    if (++counts.differences > kShownDifferences) return;
    tell(recording.path() + ": tick " + std::to_string(sample.tick) + ": recorded " +
         properties::show(Eigen::Vector3f(fx, fy, fz)) + " N, expected " + properties::show(exact.force) + " N");
  }

 private:
  static std::uint32_t number_of(const std::unique_ptr<Definition>& of) { return of ? of->number() : 0; }

  std::unique_ptr<Definition> opened(std::uint32_t number, const recorder::Recording& recording, const device::Sample& sample) {
    if (number == 0) return nullptr;
    const Line* line = stimuli_.find(number);
    if (line == nullptr)
      throw Error(recording.path() + ": tick " + std::to_string(sample.tick) + " has the stimulus " + std::to_string(number) +
                  ", which " + name_ + "/stimuli.jsonl does not list");
    return std::make_unique<Definition>(number, *line, subjects_);
  }

  Subjects& subjects_;
  Stimuli stimuli_;
  std::string name_;
  std::unique_ptr<Definition> current_, waiting_;
  std::optional<reference::Damping> damping_;
};

// A part that a crash cut off is whole as far as it goes.
bool is_whole(recorder::Recording& recording, bool is_last) {
  bool whole = true;
  for (const std::string& problem : problems_of(recording)) {
    if (is_last && !recording.ended() && problem.find(": no end: cut off") != std::string::npos) continue;
    tell(problem);
    whole = false;
  }
  return whole;
}

}  // namespace

int recompute_session(const fs::path& folder) {
  const experiments::SavedSession saved = experiments::read_session(folder);
  Subjects subjects(saved.protocol);
  watch_for_interrupt();
  Counts counts;
  std::uint64_t commands = 0, changed = 0, other_commands = 0;
  bool whole = true;
  for (const fs::path& run_folder : runs_of(folder)) {
    const std::vector<fs::path> parts = apparatus::parts_of(run_folder);
    std::optional<Run> run;
    std::unique_ptr<CommandCheck> check;
    for (const fs::path& part : parts) {
      if (interrupted()) throw Interrupted(folder.string() + " was not computed to its end");
      recorder::Recording recording(part);
      // After a gap the supervisor's memory is not what it was.
      if (!is_whole(recording, part == parts.back())) {
        whole = false;
        break;
      }
      if (!run) run.emplace(run_folder, subjects, recorder::damping_in(recording.metadata(), recording.path()));
      if (!check) check = std::make_unique<CommandCheck>(recording);
      if (!check->why_not().empty()) throw Error(part.string() + ": commands cannot be computed: " + check->why_not());
      recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
        for (const device::Sample& sample : chunk) {
          if (sample.status == device::Sample::kEnd) continue;
          run->compute(recording, sample, counts);
          if (!check->is_same(sample) && other_commands + check->differences() <= kShownDifferences)
            tell(part.string() + ": tick " + std::to_string(sample.tick) +
                 ": the command is not what supervisor and controller make of the force");
        }
      });
    }
    if (!check) continue;
    commands += check->ticks();
    changed += check->changed();
    other_commands += check->differences();
  }
  const auto number = [](std::uint64_t count) { return static_cast<unsigned long long>(count); };
  std::printf("computed again: %llu ticks, %llu in contact, %llu differ\n", number(counts.ticks), number(counts.contacts),
              number(counts.differences));
  std::printf("commands: %llu ticks, %llu changed by supervisor or controller, %llu differ\n", number(commands),
              number(changed), number(other_commands));
  return whole && counts.differences == 0 && other_commands == 0 ? kHeld : kFailed;
}

int verify_session(const fs::path& folder) {
  std::uint64_t samples = 0;
  std::size_t parts = 0, problems = 0;
  for (const fs::path& run : runs_of(folder))
    for (const fs::path& part : apparatus::parts_of(run)) {
      recorder::Recording recording(part);
      for (const std::string& problem : problems_of(recording)) {
        tell(problem);
        ++problems;
      }
      ++parts;
      samples += recording.extent().samples;
    }
  if (problems > 0) return kFailed;
  std::printf("whole: %zu parts, %llu samples, every tick and every checksum, and the metadata\n", parts,
              static_cast<unsigned long long>(samples));
  return kHeld;
}

}  // namespace forceshade::apps
