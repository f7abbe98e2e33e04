// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "files/input_file.h"
#include "study/experiments/session_folder.h"
#include "tests/fuzz/input_file.h"

namespace {

constexpr const char* kProtocol = R"(experiment = "classification"
name = "One trial"
language = "language.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
practice_trials = 0
trials_before_break = 0
resume = "trial"
stimuli = [{ law = "bump-2p" }]
radii_mil = [600]
repetitions = 1
)";

// A session of one trial, begun and left.
std::filesystem::path session_folder(const forceshade::tests::TemporaryDirectory& directory) {
  using namespace forceshade;
  std::filesystem::copy_file(std::filesystem::path(FORCESHADE_SOURCE_DIR) / "clients/study/examples/english.toml",
                             directory.file("language.toml"));
  const std::filesystem::path folder = directory.file("session");
  auto recorded = experiments::RecordedSession::start(folder, directory.write("protocol.toml", kProtocol), "P1", 1, {},
                                                      experiments::Sync::never);
  recorded.session().close(1);
  return folder;
}

}  // namespace

// session.json, in the folder of a session that is otherwise whole.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  static const tests::TemporaryDirectory directory;
  static const std::filesystem::path folder = session_folder(directory);
  const std::string file = directory.write("session/session.json", fuzz::text_of(data, size));
  fuzz::read_or_refuse<Error>(file, [&] {
    const experiments::SavedSession saved = experiments::read_session(folder);
    fuzz::require(experiments::is_participant(saved.participant), "a participant is a pseudonym");
    fuzz::require(!saved.protocol.bumps().empty() && !saved.events.empty(), "the rest of the session is as it was");
  });
  return 0;
}
