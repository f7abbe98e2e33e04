// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/session_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "files/input_file.h"
#include "files/output_folder.h"
#include "files/printable.h"
#include "study/experiments/json_text.h"
#include "study/experiments/trial_log.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

constexpr int kSessionSchema = 1;
constexpr std::size_t kLongestId = 32;

Error failed(const fs::path& file, const char* what) {
  return {file, std::string("cannot ") + what + ": " + std::generic_category().message(errno)};
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw failed(file, "be opened");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw failed(file, "be read");
  return text;
}

// session.json, but for the experiment, which the protocol holds.
struct About {
  AnsweredBy answered_by = AnsweredBy::not_recorded;
  std::string participant;
  std::uint64_t seed = 0;
  fs::path files_from;
};

AnsweredBy answered_by_in(const std::string& name) {
  for (const AnsweredBy who : {AnsweredBy::person, AnsweredBy::model})
    if (name == name_of(who)) return who;
  throw std::invalid_argument("answered_by: expected person or virtual participant, got " + name);
}

About read_about(const fs::path& folder) {
  const fs::path file = folder / "session.json";
  const std::string text = content_of(file);
  try {
    const Json json = json_of(text);
    whole_member(json, "schema", kSessionSchema, kSessionSchema);
    About about;
    about.participant = text_member(json, "participant");
    if (!is_participant(about.participant)) throw std::invalid_argument("participant: expected letters, digits and dashes");
    if (json.contains("answered_by")) about.answered_by = answered_by_in(text_member(json, "answered_by"));
    const std::string seed = text_member(json, "seed");
    const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), about.seed);
    if (error != std::errc() || end != seed.data() + seed.size())
      throw std::invalid_argument("seed: expected a whole number below 2^64 in quotes, got " + seed);
    about.files_from = text_member(json, "files_from");
    return about;
  } catch (const std::invalid_argument& error) {
    throw Error(file, files::printable(error.what()));
  }
}

// The contents of the folder but for the events.
struct Opened {
  About about;
  Protocol protocol;
  Language language;
};

Opened opened(const fs::path& folder, Files files) {
  Opened all{read_about(folder), {}, {}};
  all.protocol = read_protocol(folder / "protocol.toml", all.about.files_from, files);
  all.language = read_language(folder / "language.toml");
  return all;
}

fs::path log_in(const fs::path& folder) {
  return folder / "trials.jsonl";
}

// Logs the events of a session, and the origin of its answers beside each start of a run.
template <class Log>
Session::Log logged(std::shared_ptr<Log> log, const Origin& origin) {
  return [log = std::move(log), device = files::printable(origin.device), certified = origin.certified](const Event& event) {
    if (event.kind != EventKind::run_started) return log->append(event);
    Event start = event;
    start.device = device;
    start.certified = certified;
    log->append(start);
  };
}

// `make` builds the session; an event that does not fit becomes an error of its line.
template <class Make>
auto with_lines(const fs::path& folder, const Make& make) {
  try {
    return make();
  } catch (const ReplayError& error) {
    throw Error(log_in(folder), error.event + 1, error.what());
  }
}

}  // namespace

bool is_participant(std::string_view id) {
  const auto is_alphanumeric = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  };
  return !id.empty() && id.size() <= kLongestId && is_alphanumeric(id.front()) &&
         std::ranges::all_of(id, [&](char c) { return is_alphanumeric(c) || c == '-'; });
}

fs::path ticks_of_run(const fs::path& session, int run) {
  return session / "ticks" / ("run-" + std::to_string(run));
}

// Appends lines; holds a lock on the file, so that no second process goes on with the same session.
class RecordedSession::Log {
 public:
  // at: where the file is for now; file: its name in messages.
  Log(const fs::path& at, fs::path file, int flags, Sync sync)
      : file_(std::move(file)), descriptor_(::open(at.c_str(), flags | O_WRONLY | O_APPEND | O_CLOEXEC, 0666)), sync_(sync) {
    if (descriptor_ < 0) throw failed(file_, "be opened for writing");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(descriptor_);
    throw Error(file_, "another process goes on with this session");
  }
  ~Log() { ::close(descriptor_); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // Cuts off what stands after the whole lines.
  void keep(std::size_t size, std::size_t lines) {
    size_ = static_cast<off_t>(size);
    lines_ = lines;
    if (::ftruncate(descriptor_, size_) != 0) throw failed(file_, "be cut to its whole lines");
  }

  void append(const Event& event) {
    const std::string line = line_of(event, lines_ + 1);
    for (std::size_t done = 0; done < line.size();) {
      const ssize_t written = ::write(descriptor_, line.data() + done, line.size() - done);
      if (written >= 0) {
        done += static_cast<std::size_t>(written);
      } else if (errno != EINTR) {
        const Error error = failed(file_, "be written");
        // The rest of the line would damage the next one. Where this fails, too, the line is torn, and is recognised.
        [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, size_);
        throw error;
      }
    }
    size_ += static_cast<off_t>(line.size());
    ++lines_;
    if (sync_ == Sync::each_event && ::fdatasync(descriptor_) != 0) throw failed(file_, "reach the disk");
  }

 private:
  fs::path file_;
  int descriptor_;
  Sync sync_;
  off_t size_ = 0;
  std::size_t lines_ = 0;
};

RecordedSession RecordedSession::start(const fs::path& folder, const fs::path& protocol_file, const std::string& participant,
                                       std::uint64_t seed, KeyNames keys, Sync sync, const Origin& origin) {
  if (!is_participant(participant))
    throw Error(folder, "participant: expected 1 to 32 letters, digits and dashes, the first no dash, got \"" +
                            files::printable(participant) + '"');
  Protocol protocol = read_protocol(protocol_file);
  Language language = read_language(protocol.language);
  files::OutputFolder whole(folder);
  if (!whole.is_for_an_empty_path())
    throw Error(folder, "expected no file of this name, or an empty folder: a session has a folder of its own");
  whole.write("protocol.toml", content_of(protocol_file));
  whole.write("language.toml", content_of(protocol.language));
  Json about{{"schema", kSessionSchema},
             {"participant", participant},
             {"experiment", name_of(protocol.experiment)},
             {"seed", std::to_string(seed)},
             {"files_from", fs::absolute(protocol_file).parent_path().string()}};
  if (origin.answered_by != AnsweredBy::not_recorded) about["answered_by"] = name_of(origin.answered_by);
  whole.write("session.json", about.dump(2) + '\n');
  std::error_code error;
  if (!fs::create_directory(whole.so_far() / "ticks", error)) throw Error(folder, "cannot be made: " + error.message());
  RecordedSession recorded;
  recorded.log_ = std::make_shared<Log>(log_in(whole.so_far()), log_in(folder), O_CREAT | O_EXCL, sync);
  whole.commit();
  recorded.folder_ = folder;
  recorded.participant_ = participant;
  recorded.session_ = std::make_unique<Session>(std::move(protocol), std::move(language), seed, logged(recorded.log_, origin),
                                                std::span<const Event>(), keys);
  return recorded;
}

RecordedSession RecordedSession::resume(const fs::path& folder, KeyNames keys, Sync sync, const Origin& origin) {
  Opened all = opened(folder, Files::must_exist);
  const AnsweredBy first = all.about.answered_by, now = origin.answered_by;
  if (first != now && first != AnsweredBy::not_recorded && now != AnsweredBy::not_recorded)
    throw Error(folder, "the session was begun by a " + std::string(name_of(first)) + ", so a " + std::string(name_of(now)) +
                            " cannot go on with it");
  RecordedSession recorded;
  recorded.log_ = std::make_shared<Log>(log_in(folder), log_in(folder), 0, sync);  // locked before it is read
  LogText text = read_log(log_in(folder));
  if (std::ranges::any_of(text.events, [](const Event& event) { return event.kind == EventKind::session_ended; }))
    throw Error(folder, "the session is over: there is nothing to go on with");
  with_lines(folder, [&] {
    return Session(
        all.protocol, all.language, all.about.seed, [](const Event&) {}, text.events);
  });
  recorded.log_->keep(text.size, text.events.size());
  recorded.folder_ = folder;
  recorded.participant_ = all.about.participant;
  recorded.note_ = text.note;
  recorded.run_ = 1 + static_cast<int>(std::ranges::count(text.events, EventKind::run_started, &Event::kind));
  recorded.session_ = std::make_unique<Session>(std::move(all.protocol), std::move(all.language), all.about.seed,
                                                logged(recorded.log_, origin), text.events, keys);
  return recorded;
}

SavedSession read_session(const fs::path& folder) {
  Opened all = opened(folder, Files::may_be_missing);
  LogText text = read_log(log_in(folder));
  with_lines(folder, [&] {
    return Session(
        all.protocol, all.language, all.about.seed, [](const Event&) {}, text.events);
  });
  return {all.about.participant,  all.about.seed, std::move(all.protocol), std::move(all.language),
          std::move(text.events), text.note,      all.about.answered_by};
}

}  // namespace forceshade::experiments
