// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session on disk: a folder with its protocol, its texts and an append-only log that survives a crash (session_format.md).

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "study/experiments/session.h"

namespace forceshade::experiments {

// A pseudonym: 1 to 32 letters, digits and dashes of ASCII, the first no dash.
bool is_participant(std::string_view id);

// The folder for the ticks of a run, from 1: SESSION/ticks/run-1 and so on. It need not exist.
std::filesystem::path ticks_of_run(const std::filesystem::path& session, int run);

// Puts each event on the disk before the session goes on, or not. Without it, a crash of the machine, not of the program, may
// lose the last seconds: enough for virtual participants.
enum class Sync { each_event, never };

// The session with its log: each event is a line of trials.jsonl, on the disk before the session goes on.
class RecordedSession {
 public:
  // Makes the folder, which must not exist or be empty, with session.json, protocol.toml, language.toml, trials.jsonl and an
  // empty ticks/: whole or not at all. Throws Error, and files::OutputError, also where another process makes it.
  static RecordedSession start(const std::filesystem::path& folder, const std::filesystem::path& protocol,
                               const std::string& participant, std::uint64_t seed, KeyNames keys = {},
                               Sync sync = Sync::each_event, const Origin& origin = {});

  // Goes on with an interrupted session. A torn last line is cut off the log, which note() reports. Throws Error, also
  // for a session that is over, is open in another process, or was begun by a person and would go on with a model, or the
  // reverse.
  static RecordedSession resume(const std::filesystem::path& folder, KeyNames keys = {}, Sync sync = Sync::each_event,
                                const Origin& origin = {});

  Session& session() { return *session_; }
  const Session& session() const { return *session_; }
  const std::string& participant() const { return participant_; }
  int run() const { return run_; }  // from 1
  const std::filesystem::path& folder() const { return folder_; }
  // The folder for the ticks of this run.
  std::filesystem::path ticks() const { return ticks_of_run(folder_, run_); }
  // Words about what was repaired; empty if nothing was.
  const std::string& note() const { return note_; }

 private:
  class Log;
  RecordedSession() = default;

  std::filesystem::path folder_;
  std::string participant_, note_;
  int run_ = 1;
  std::shared_ptr<Log> log_;
  std::unique_ptr<Session> session_;
};

// A session folder as it was left, for the analysis and the export. Reads only.
struct SavedSession {
  std::string participant;
  std::uint64_t seed = 0;
  Protocol protocol;
  Language language;
  std::vector<Event> events;
  std::string note;  // about a torn last line, which is left out
  AnsweredBy answered_by = AnsweredBy::not_recorded;
};

SavedSession read_session(const std::filesystem::path& folder);  // Throws Error.

}  // namespace forceshade::experiments
