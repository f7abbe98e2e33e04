// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A second process, for what must be let go whatever becomes of this one. Chosen at the link, as system.h is. All times are in
// ns.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace forceshade::system {

// One end of a socket between two processes, which keeps messages whole.
class Packets {
 public:
  Packets(int end, int other_process) noexcept : end_(end), other_process_(other_process) {}

  // False if the other end is closed.
  bool send(const void* message, std::size_t size) noexcept;

  enum class Received { message, nothing_yet, closed };
  // Waits until then. A message of another size is as good as a closed end.
  Received receive(void* message, std::size_t size, std::int64_t deadline) noexcept;

  // The other end is closed, or the process that has it is gone. Waits until then for that.
  bool is_alone(std::int64_t deadline = 0) noexcept;

  // For the code that makes, moves and closes it.
  int end() const noexcept { return end_; }

 private:
  int end_, other_process_;
};

// While one lives, the system kills this process first where memory runs out, so that a program which holds a force, and ends
// it when its other end is gone, outlives it. What was made before is as ready to be killed as it was; what is made meanwhile,
// as this process.
class KilledFirst {
 public:
  KilledFirst() noexcept;
  ~KilledFirst();
  KilledFirst(const KilledFirst&) = delete;
  KilledFirst& operator=(const KilledFirst&) = delete;
};

// Another process, which begins as a copy of this one. Nothing that is sent to a terminal's programs reaches it, no handler of
// a library's is ever called in it, no file of this process stays open there, and what it prints goes to standard error. Where
// memory runs out, the system kills this process first, and the other one last.
class Process {
 public:
  // Runs this there, with its end of the packets; what it returns is the exit code. The name has at most 15 characters. Throws
  // std::system_error.
  Process(const char* name, const std::function<int(Packets&)>& body);
  // Closes this end. The process goes on, where it does not end for that.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int id() const noexcept { return id_; }
  Packets& packets() noexcept { return packets_; }
  void close() noexcept;

  struct Ended {
    int code = 0, signal = 0;  // 0 where the program ignores SIGCHLD, so that the system keeps none
  };
  // The end of the process, once; waits until then.
  std::optional<Ended> ended(std::int64_t deadline) noexcept;
  // Goes on where a signal has stopped it.
  void resume() noexcept;
  void kill() noexcept;

 private:
  int id_ = -1;
  Packets packets_;
  std::optional<KilledFirst> first_;
};

// The last act of such a process before it ends, whatever ends it.
class LastAct {
 public:
  // Called by the thread that crashes or calls exit(), before anything is destroyed. False: it could not.
  virtual bool let_go() noexcept = 0;
  // Called by a thread that interrupt() was called for, wherever it is. True: it never goes on.
  virtual bool interrupted() noexcept = 0;

 protected:
  ~LastAct() = default;
};

// All of these are called in such a process. The act lives as long as it. To be called again once a library is loaded, since
// what such a library does at exit() then comes after the act.
void before_end(LastAct& act) noexcept;
// Ends it with all of its threads, at once.
[[noreturn]] void end(int code) noexcept;

int this_thread() noexcept;
// Lets this thread be interrupted, also in the system's calls.
void allow_interrupt() noexcept;
void interrupt(int thread) noexcept;

// Memory of zeros that a process and those that it makes have in common. Throws std::system_error.
void* map_shared(std::size_t size);
void unmap_shared(void* memory, std::size_t size) noexcept;

}  // namespace forceshade::system
