// SPDX-License-Identifier: BSD-3-Clause
// forceshade-study experiment: the thesis's two experiments and others like them, from the protocol to the data.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include "apps/command.h"
#include "apps/device_run.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "device/placement_text.h"
#include "files/printable.h"
#include "study/analysis/tables.h"
#include "study/apparatus/certificates.h"
#include "study/apparatus/motion.h"
#include "study/apparatus/session_run.h"
#include "study/command/commands.h"
#include "study/command/experiment_fronts.h"
#include "study/command/experiment_run.h"
#include "study/command/experiment_virtual.h"
#include "study/command/session_recompute.h"
#include "study/experiments/bids.h"
#include "study/experiments/results_csv.h"
#include "study/experiments/session_results.h"
#include "study/preparation/prepare.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;
using apparatus::Bumps;
using apparatus::Front;
using experiments::Bump;
using experiments::Protocol;

constexpr const char* kSession = "DIR";

// mm below the plane at which the force on the two sides of the dividing plane begins to differ, because a cylinder is wider
// below the plane than on it; infinite where it never does.
double seam_depth(const Protocol& protocol) {
  constexpr double kMil = experiments::kMillimetresPerMil;
  const double half = protocol.spacing / 2 * kMil, chord = protocol.width / 2.0 * kMil;
  double depth = std::numeric_limits<double>::infinity();
  for (const Bump& bump : protocol.bumps()) {
    const experiments::Stimulus& stimulus = protocol.stimulus(bump.stimulus);
    if (stimulus.kind != experiments::StimulusKind::law || stimulus.law != LawId::bump_cylinder) continue;
    const double radius = bump.radius * kMil;
    if (radius > half)
      depth = std::min(depth, std::sqrt(radius * radius - chord * chord) - std::sqrt(radius * radius - half * half));
  }
  return depth;
}

int check(const std::string& file, const std::string& certificates) {
  const Protocol protocol = experiments::read_protocol(file);
  const experiments::Language language = experiments::read_language(protocol.language);
  Bumps bumps(protocol, read_with_progress);
  const std::vector<Bump> all = protocol.bumps();
  for (const Bump& bump : all) bumps.of(bump);
  std::printf("%s: a %s experiment, texts in %s\n", protocol.name.c_str(), name_of(protocol.experiment).data(),
              language.name.c_str());
  std::printf("%d trials for each participant, %d practice trials before them\n", protocol.trials(), protocol.practice_trials);
  std::printf("%zu bumps can be rendered, and need a certificate each\n", all.size());
  if (protocol.experiment == experiments::Experiment::matching)
    if (const double depth = seam_depth(protocol); std::isfinite(depth))
      std::printf(
          "the force is the same on both sides of the dividing plane down to %.2f mm below the surface; deeper, the widest "
          "cylinder reaches it\n",
          depth);
  if (certificates.empty()) return kHeld;
  apparatus::certificates_of(bumps, certificates);
  std::printf("every one of them is certified for this build\n");
  return kHeld;
}

int prepare(const std::string& file, const OutFolder& out, unsigned threads) {
  watch_for_interrupt();
  const Bumps bumps(experiments::read_protocol(file), read_with_progress);
  out.make();
  std::size_t all = 0, kept = 0;
  const auto say = [&](const apparatus::Prepared& one) {
    all = one.of;
    if (one.was_there) {
      ++kept;
      return;
    }
    std::printf("%3zu of %zu  %-28s %s\n", one.number, one.of, one.bump.c_str(),
                one.why_not.empty() ? "certified" : ("FAILED: " + one.why_not).c_str());
    std::fflush(stdout);
  };
  const bool held = apparatus::prepare(bumps, out.path(), {.threads = threads, .done = say}, interrupted());
  std::printf("%zu bumps, %zu of them certified before\n", all, kept);
  return held ? kHeld : kFailed;
}

// --certificates; `folder` is empty for none.
CLI::Option* add_certificates(CLI::App& command, std::string& folder) {
  return command
      .add_option_function<std::string>(
          "--certificates", [&folder](const std::string& given) { folder = given == kNoCertificate ? "" : given; },
          "the folder that 'experiment prepare' has filled for this build; or none, which drives uncertified")
      ->type_name("DIR|none")
      ->required();
}

// The common options of run and resume.
struct Driving {
  std::string device, certificates, place, settings;
  bool terminal = false, in_reset_pose = false, free_run = false;
  std::optional<int> dead_man;
  std::optional<double> watchdog_timeout;

  void add_to(CLI::App& command) {
    command.option_defaults()->group(kDeviceGroup);
    command
        .add_option("--device", device,
                    "as for drive --device; mouse is a PHANToM whose hand is the mouse over the participant's window")
        ->type_name("DEVICE")
        ->required();
    add_certificates(command, certificates)->group(kEvidenceGroup);
    command.add_flag("--terminal", terminal, "texts and keys in the terminal instead of a window");
    command.add_option("--window", settings, "a TOML file: size of window and text, keys (clients/study/README.md)")
        ->type_name("FILE")
        ->excludes("--terminal");
    command.add_option("--place", place, "the place of the scene's middle in the device's workspace: X,Y,Z; default: 0,0,0")
        ->type_name("X,Y,Z")
        ->group(kPlaceGroup);
    add_whole(command, "--dead-man", "button of the device to be held down, from 0; else there is no force", {0, 15},
              [this](std::uint64_t button) { dead_man = static_cast<int>(button); });
    add_watchdog_timeout(command, watchdog_timeout);
    command.add_flag("--free-run", free_run, "the loop as fast as it goes: for checks, not for hands")
        ->excludes("--watchdog-timeout");
    add_in_reset_pose(command, in_reset_pose);
  }

  SessionOptions options() const {
    const device::Placement placement = device::parse_placement(place);
    if (!(placement == device::Placement(placement.origin())))
      throw Error("--place: expected three lengths X,Y,Z without a turn, got \"" + place + '"');
    if (terminal && dead_man && (device.starts_with("simulated") || device.starts_with("mouse")))
      throw Error("--dead-man: expected a device with buttons of its own beside --terminal, which has the keys; got " + device);
    return {.device = device,
            .certificates = certificates,
            .origin = placement.origin(),
            .in_reset_pose = in_reset_pose,
            .servo = {.paced = !free_run, .watchdog_timeout = watchdog_timeout, .dead_man_button = dead_man}};
  }

  window::WindowSettings window_settings() const {
    return settings.empty() ? window::WindowSettings{} : window::read_settings(settings);
  }
  experiments::KeyNames key_names() const {
    return terminal ? experiments::KeyNames{} : window::key_names(window_settings().keys);
  }

  experiments::Origin answers() const {
    return apparatus::origin_of(experiments::AnsweredBy::person, device, !certificates.empty());
  }

  OpenFront front(const Eigen::Vector3f& at) const {
    if (terminal) return [](Bumps&, device::Steering*) -> std::unique_ptr<Front> { return std::make_unique<TerminalFront>(); };
    return [its = window_settings(), at](Bumps& bumps, device::Steering* steering) -> std::unique_ptr<Front> {
      return std::make_unique<WindowFront>(its, bumps, steering, at);
    };
  }
};

struct RunOptions {
  std::string protocol, participant, session;
  std::optional<std::uint64_t> seed;
  Driving driving;
};

int run(const RunOptions& options) {
  if (!experiments::is_participant(options.participant) || options.participant == analysis::kOverall)
    throw Error("--participant: expected a pseudonym of at most 32 letters, digits and dashes, and not \"" +
                std::string(analysis::kOverall) + "\", which the tables use, got \"" + options.participant + '"');
  const Protocol protocol = experiments::read_protocol(options.protocol);
  const SessionOptions session = options.driving.options();
  const std::uint64_t seed = options.seed.value_or(system::random());
  return run_session(protocol, session, options.driving.front(session.origin), [&] {
    return experiments::RecordedSession::start(options.session, options.protocol, options.participant, seed,
                                               options.driving.key_names(), experiments::Sync::each_event,
                                               options.driving.answers());
  });
}

int resume(const std::string& folder, const Driving& driving) {
  const experiments::SavedSession saved = experiments::read_session(folder);
  const SessionOptions session = driving.options();
  return run_session(saved.protocol, session, driving.front(session.origin), [&] {
    return experiments::RecordedSession::resume(folder, driving.key_names(), experiments::Sync::each_event, driving.answers());
  });
}

// A folder for results, where nothing that is there is replaced; none for an option that was not given.
std::unique_ptr<files::OutputFolder> new_folder(const std::string& option, const std::string& path) {
  if (path.empty()) return nullptr;
  auto folder = std::make_unique<files::OutputFolder>(path);
  if (folder->is_for_an_empty_path()) return folder;
  throw Error(option + ": expected a folder that does not exist or is empty, got \"" + path + '"');
}

struct ExportOptions {
  std::vector<std::string> sessions, authors;
  std::string csv, bids;
};

int write_out(const ExportOptions& options) {
  if (options.csv.empty() && options.bids.empty()) throw Error("expected --csv DIR, --bids DIR or both; got neither");
  const auto whole = [](const std::string& folder) { return fs::weakly_canonical(fs::absolute(folder) / ""); };
  if (!options.csv.empty() && !options.bids.empty() && whole(options.csv) == whole(options.bids))
    throw Error("--bids: expected another folder than --csv, got \"" + options.bids + '"');
  const std::vector<fs::path> folders(options.sessions.begin(), options.sessions.end());
  const std::unique_ptr<files::OutputFolder> csv = new_folder("--csv", options.csv), bids = new_folder("--bids", options.bids);
  const experiments::Results results = experiments::results_of(folders);
  if (csv) write_results(results, *csv);
  if (bids) experiments::export_bids(folders, *bids, apparatus::motion_of, options.authors);
  if (csv) csv->commit();
  if (bids) bids->commit();
  return kHeld;
}

void add_check(CLI::App& experiment, int& result) {
  struct Options {
    std::string protocol, certificates;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = experiment.add_subcommand("check", "Read a protocol and say what is wrong with it, or what it needs");
  command->add_option("protocol", options->protocol, "the experiment, a TOML file")->type_name("FILE")->required();
  command->add_option("--certificates", options->certificates, "folder in which every bump must be certified for this build")
      ->type_name("DIR");
  command->callback([options, &result] { result = check(options->protocol, options->certificates); });
}

void add_prepare(CLI::App& experiment, int& result) {
  struct Options {
    std::string protocol;
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = experiment.add_subcommand("prepare", "Certify every bump that a session can render, for this build");
  command->add_option("protocol", options->protocol, "the experiment, a TOML file")->type_name("FILE")->required();
  const auto out =
      std::make_shared<OutFolder>(*command, "directory for the certificates; those that cover this build are kept");
  out->require();
  add_whole(*command, "--threads", options->threads, "threads", {1, 1024});
  command->callback([options, out, &result] { result = prepare(options->protocol, *out, options->threads); });
}

void add_run(CLI::App& experiment, int& result) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = experiment.add_subcommand("run", "A session with a participant");
  command->add_option("protocol", options->protocol, "the experiment, a TOML file")->type_name("FILE")->required();
  command->add_option("--participant", options->participant, "a pseudonym")->type_name("ID")->required();
  command->add_option("--session", options->session, "folder that the session makes")->type_name(kSession)->required();
  add_whole(*command, "--seed", "of the order of the trials; default: another one each time", kSeeds,
            [options](std::uint64_t seed) { options->seed = seed; });
  options->driving.add_to(*command);
  command->callback([options, &result] { result = run(*options); });
}

void add_resume(CLI::App& experiment, int& result) {
  struct Options {
    std::string session;
    Driving driving;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = experiment.add_subcommand("resume", "Go on with a session that was interrupted");
  command->add_option("session", options->session, "its folder")->type_name(kSession)->required();
  options->driving.add_to(*command);
  command->callback([options, &result] { result = resume(options->session, options->driving); });
}

void add_virtual(CLI::App& experiment, int& result) {
  const auto options = std::make_shared<VirtualOptions>();
  struct Texts {
    std::string protocol, certificates;
  };
  const auto texts = std::make_shared<Texts>();
  options->threads = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command = experiment.add_subcommand("virtual", "Sessions with virtual participants on a simulated device");
  command->add_option("protocol", texts->protocol, "the experiment, a TOML file")->type_name("FILE")->required();
  add_whole(*command, "--participants", options->participants, "number of participants", {1, 1000});
  add_whole(*command, "--seed", options->plan.seed, "of orders and participants", kSeeds);
  add_whole(*command, "--threads", options->threads, "participants at a time", {1, 1024});
  const auto out = std::make_shared<OutFolder>(*command, "directory for the sessions, V1 and so on");
  out->require();
  add_certificates(*command, texts->certificates);
  command->callback([options, texts, out, &result] {
    options->plan.protocol = texts->protocol;
    options->certificates = texts->certificates;
    out->make();
    options->plan.out = out->path();
    result = run_virtual(*options);
  });
}

void add_export(CLI::App& experiment, int& result) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = experiment.add_subcommand("export", "The data of sessions for other programs");
  command->add_option("session", options->sessions, "their folders")->type_name(kSession)->required();
  command
      ->add_option("--csv", options->csv,
                   "directory for the answers as tidy CSV files: matching.csv, classification.csv, radius.csv")
      ->type_name("DIR");
  CLI::Option* bids =
      command->add_option("--bids", options->bids, "directory for a BIDS data set: answers, events and every tick")
          ->type_name("DIR");
  command
      ->add_option("--authors", options->authors, "an author of the BIDS data set; give the option again for each further one")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check([](const std::string& name) {
        return !name.empty() && files::is_printable(name) ? std::string()
                                                          : "expected a name, got \"" + files::printable(name) + '"';
      })
      ->needs(bids);
  command->callback([options, &result] { result = write_out(*options); });
}

void add_check_of_session(CLI::App& experiment, int& result, const char* name, const char* help,
                          int (*check)(const fs::path&)) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = experiment.add_subcommand(name, help);
  command->add_option("session", *folder, "its folder")->type_name(kSession)->required();
  command->callback([folder, check, &result] { result = check(*folder); });
}

}  // namespace

void add_experiment(CLI::App& app, int& result) {
  CLI::App* experiment = app.add_subcommand("experiment", "The matching and classification experiments: prepare, run, export");
  experiment->require_subcommand(1);
  add_check(*experiment, result);
  add_prepare(*experiment, result);
  add_run(*experiment, result);
  add_resume(*experiment, result);
  add_virtual(*experiment, result);
  add_export(*experiment, result);
  add_check_of_session(*experiment, result, "verify",
                       "Check that every recording of a session is whole: 0 if so, 1 if cut off, damaged or with ticks missing",
                       verify_session);
  add_check_of_session(*experiment, result, "recompute",
                       "Check that every force of a session is the exact one, rounded, and every command what supervisor and "
                       "controller make of it: 0 if so",
                       recompute_session);
}

}  // namespace forceshade::apps
