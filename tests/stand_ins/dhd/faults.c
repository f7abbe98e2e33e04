// SPDX-License-Identifier: BSD-3-Clause
// The state, the journal, and the faults of the client.

#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "stand_in.h"

const struct choice_entry kFaultTable[kFaults] = {
    {"not-open", "", "a call before a device was opened"},
    {"after-close", "", "a call after the device was closed"},
    {"bad-id", "", "a call of a device that there is not"},
    {"null-argument", "", "a null pointer for a result"},
    {"out-of-range", "", "an argument that the documents do not allow"},
    {"no-expert-mode", "", "a function of the expert mode without dhdEnableExpertMode"},
    {"opened-twice", "", "a device opened again without dhdClose"},
    {"force-first", "", "a force before any position was read"},
    {"not-enabled", "", "a force that was not enabled, or that the client itself had switched off"},
    {"after-cut", "", "a force 100 ms after the device had switched its forces off"},
    {"uncalibrated-force", "", "a force while the device waits for its calibration"},
    {"not-finite", "", "a number that is NaN or infinite"},
    {"absurd-force", "", "a force beyond most-force: wrong units, or no clamp"},
    {"blind", "", "100 forces in a row without a reading"},
    {"gap", "", "no force for longer than longest-gap while forces were on"},
    {"two-threads", "", "forces from two threads"},
    {"after-unplug", "", "a force 100 ms after the device was unplugged"},
    {"force-at-end", "", "the end while a force acted"},
    {"no-stop", "", "dhdClose while forces were on, without dhdStop"},
    {"left-open", "", "the client ended without dhdClose"},
};

static const uint64_t kMark = UINT64_C(0x6468642d73696d31);
static struct state own;
struct state* state = &own;
static int journal = -1;

int64_t now_ns(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * INT64_C(1000000000) + time.tv_nsec;
}

static struct state* mapped(const char* path, bool is_new) {
  const int file = open(path, is_new ? O_RDWR | O_CREAT : O_RDWR, 0600);
  if (file < 0) return NULL;
  void* at = MAP_FAILED;
  if (is_new ? ftruncate(file, sizeof(struct state)) == 0 : lseek(file, 0, SEEK_END) == (off_t)sizeof(struct state))
    at = mmap(NULL, sizeof(struct state), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return at == MAP_FAILED ? NULL : at;
}

static _Noreturn void refuse(const char* what, const char* words) {
  fprintf(stderr, "forceshade-standin dhd: %s: %s\n", what, words);
  _exit(2);
}

void begin_state(void) {
  const char* const settings = getenv("FORCESHADE_STANDIN_DHD");
  const char* const wrong = read_settings(settings ? settings : "");
  if (wrong) refuse("FORCESHADE_STANDIN_DHD", wrong);
  const char* const path = getenv("FORCESHADE_STANDIN_JOURNAL");
  if (path && *path) {
    char beside[1024];
    snprintf(beside, sizeof beside, "%s.state", path);
    journal = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    struct state* const shared = mapped(beside, true);
    if (journal < 0 || !shared) refuse(path, "expected a file that can be written");
    state = shared;
  }
  state->mark = kMark;
  snprintf(state->settings, sizeof state->settings, "%s", settings ? settings : "");
}

struct session* session(void) {
  return &state->sessions[(state->session_count > 0 ? state->session_count - 1 : 0) % kMostSessions];
}

static void write_line(const char* line, int size) {
  if (journal >= 0 && write(journal, line, (size_t)size) != size) refuse("journal", "it cannot be written");
}

void note(const char* event) {
  char line[256];
  const int size = snprintf(line, sizeof line, "{\"time_ns\": %lld, \"event\": \"%s\", \"session\": %d, \"call\": %llu}\n",
                            (long long)now_ns(), event, state->session_count, (unsigned long long)session()->calls);
  write_line(line, size);
}

void fault(enum fault fault, const char* words, ...) {
  struct recorded_fault* const it = &state->faults[fault];
  if (it->count++ > 0) return;
  va_list more;
  va_start(more, words);
  vsnprintf(it->words, sizeof it->words, *words ? words : "", more);
  va_end(more);
  if (!*it->words) snprintf(it->words, sizeof it->words, "%s", kFaultTable[fault].words);
  it->session = state->session_count;
  it->call = session()->calls;
  char line[400];
  const int size = snprintf(line, sizeof line,
                            "{\"time_ns\": %lld, \"event\": \"fault\", \"fault\": \"%s\", \"session\": %d, \"call\": %llu}\n",
                            (long long)now_ns(), kFaultTable[fault].name, it->session, (unsigned long long)it->call);
  write_line(line, size);
  if (journal < 0) fprintf(stderr, "forceshade-standin dhd: fault: %s: %s\n", kFaultTable[fault].name, it->words);
}

// The last moment of a force, in ns: a client that is gone or stands still leaves it to the watchdog; 0: for ever.
static int64_t force_until(const struct session* last) {
  if (last->closed_ns > 0) return last->force_at_end * 1000 > kSmall ? last->closed_ns : last->last_force_ns;
  const int64_t watchdog = last->last_force_ns + state->watchdog * INT64_C(125000);
  if (state->cause == CAUSE_WATCHDOG) return watchdog;
  if (!state->forces_on && state->cause != CAUSE_NONE) return state->cut_ns;
  if (!state->forces_on || length(state->commanded) * 1000 <= kSmall) return last->last_force_ns;
  return state->watchdog > 0 ? watchdog : 0;
}

static void write_sessions(FILE* out) {
  fprintf(out, "  \"sessions\": [");
  const int first = state->session_count > kMostSessions ? state->session_count - kMostSessions : 0;
  for (int i = first; i < state->session_count; ++i) {
    const struct session* const it = &state->sessions[i % kMostSessions];
    const bool is_last = i + 1 == state->session_count;
    fprintf(out,
            "%s\n    {\"session\": %d, \"readings\": %llu, \"forces\": %llu, \"contact_forces\": %llu, "
            "\"largest_force_N\": %.9g, \"longest_gap_ms\": %.3f, \"end\": \"%s\", \"force_at_end_N\": %.9g, "
            "\"last_force_ns\": %lld, \"closed_ns\": %lld, \"force_until_ns\": %lld}",
            i > first ? "," : "", i + 1, (unsigned long long)it->readings, (unsigned long long)it->forces,
            (unsigned long long)it->contact_forces, it->largest_force, it->longest_gap_ms,
            it->closed_ns > 0 ? "closed" : "left-open",
            it->closed_ns > 0 || !is_last ? it->force_at_end : length(state->commanded), (long long)it->last_force_ns,
            (long long)it->closed_ns, (long long)(is_last ? force_until(it) : it->closed_ns));
  }
  fprintf(out, "%s],\n", state->session_count > 0 ? "\n  " : "");
}

// Called by the client's starter, once the client has ended: reads its state, writes the verdict as JSON, and prints each
// fault. Returns the number of kinds of fault; -1 where no client has loaded the library, -2 where one did and called nothing,
// and -3 where the report cannot be written.
PUBLISHED int forceshade_stand_in_verdict(const char* path, const char* report) {
  char beside[1024];
  snprintf(beside, sizeof beside, "%s.state", path);
  state = mapped(beside, false);
  if (!state || state->mark != kMark) return -1;
  if (!state->called) return -2;
  FILE* const out = report && *report ? fopen(report, "w") : NULL;
  if (report && *report && !out) return -3;
  read_settings(state->settings);
  if (state->owner != 0) {
    fault(FAULT_LEFT_OPEN, "%s", "");
    if (state->forces_on && length(state->commanded) * 1000 > kSmall)
      fault(FAULT_FORCE_AT_END, "%.3f N", length(state->commanded));
    state->owner = 0;
  }
  int kinds = 0;
  for (int i = 0; i < kFaults; ++i) {
    const struct recorded_fault* const it = &state->faults[i];
    if (it->count == 0) continue;
    ++kinds;
    fprintf(stderr, "fault: %s, %llu times, first in call %llu of session %d: %s\n", kFaultTable[i].name,
            (unsigned long long)it->count, (unsigned long long)it->call, it->session, it->words);
  }
  if (!out) return kinds;
  fprintf(out, "{\n  \"stand_in\": \"dhd\",\n  \"held\": %s,\n  \"assumptions\": {", kinds == 0 ? "true" : "false");
  for (int i = 0; i < kSwitches; ++i)
    fprintf(out, "%s\"%s\": \"%s\"", i > 0 ? ", " : "", kChoices[i].name, chosen((enum choice)i));
  fprintf(out, "},\n");
  write_sessions(out);
  fprintf(out, "  \"faults\": {");
  bool is_first = true;
  for (int i = 0; i < kFaults; ++i) {
    const struct recorded_fault* const it = &state->faults[i];
    if (it->count == 0) continue;
    fprintf(out, "%s\n    \"%s\": {\"count\": %llu, \"first\": {\"session\": %d, \"call\": %llu, \"words\": \"%s\"}}",
            is_first ? "" : ",", kFaultTable[i].name, (unsigned long long)it->count, it->session, (unsigned long long)it->call,
            it->words);
    is_first = false;
  }
  fprintf(out, "%s}\n}\n", is_first ? "" : "\n  ");
  return fclose(out) == 0 ? kinds : -3;
}

// Reads the settings. Returns the first error in words, or an empty text.
PUBLISHED const char* forceshade_stand_in_settings(const char* settings) {
  const char* const wrong = read_settings(settings);
  return wrong ? wrong : "";
}

// Prints the tables of faults, assumptions and events.
PUBLISHED void forceshade_stand_in_describe(void) {
  printf("faults of a client:\n");
  for (int i = 0; i < kFaults; ++i) printf("  %s: %s\n", kFaultTable[i].name, kFaultTable[i].words);
  printf("assumptions (--assume NAME=VALUE; the first value is the default):\n");
  for (int i = 0; i < kSwitches; ++i) printf("  %s=%s: %s\n", kChoices[i].name, kChoices[i].values, kChoices[i].words);
  printf("events (--event NAME@READING, counted from 1 in each session, or NAME@contact, once 100 forces were felt):\n");
  for (int i = 0; i < kEvents; ++i) printf("  %s: %s\n", kEventTable[i].name, kEventTable[i].words);
  fflush(stdout);
}
