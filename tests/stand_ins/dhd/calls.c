// SPDX-License-Identifier: BSD-3-Clause
// The beginning and end of each published function of a device: the lock, the judgement of its ID, and the last error.

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "stand_in.h"

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t begun = PTHREAD_ONCE_INIT;
static _Thread_local int threads_error = ERROR_NONE;
static int process_error = ERROR_NONE;
static _Thread_local bool is_thread_expert = false;
static bool is_process_expert = false;

// A client that loads the library and calls nothing has a state, too, so that this can be told.
__attribute__((constructor)) static void loaded(void) {
  const char* const journal = getenv("FORCESHADE_STANDIN_JOURNAL");
  if (journal && *journal) pthread_once(&begun, begin_state);
}

void lock(void) {
  pthread_once(&begun, begin_state);
  pthread_mutex_lock(&mutex);
  state->called = true;
}

void unlock(void) {
  pthread_mutex_unlock(&mutex);
}

void set_error(int error) {
  threads_error = process_error = error;
}

bool is_expert(void) {
  return is_chosen(EXPERT, "thread") ? is_thread_expert : is_process_expert;
}

bool call_begins(const char* function, signed char id) {
  lock();
  ++session()->calls;
  if (state->owner != getpid()) {
    fault(state->session_count > 0 ? FAULT_AFTER_CLOSE : FAULT_NOT_OPEN, "%s", function);
  } else if (id != -1 && id != 0) {
    fault(FAULT_BAD_ID, "%s: %d", function, id);
  } else if (!state->plugged && !is_chosen(UNPLUGGED, "stale")) {
    while (is_chosen(UNPLUGGED, "block")) {
      unlock();
      pause();
      lock();
    }
    set_error(ERROR_COM);
    unlock();
    return false;
  } else {
    device_advance();
    return true;
  }
  set_error(state->owner == getpid() ? ERROR_INDEX : ERROR_NO_DEVICE);
  unlock();
  return false;
}

int call_ends(int result, int error) {
  if (result < 0)
    set_error(error);
  else if (is_chosen(ERROR_KEPT, "no"))
    set_error(ERROR_NONE);
  unlock();
  return result;
}

bool expert_call_begins(const char* function, signed char id) {
  if (!call_begins(function, id)) return false;
  if (is_expert()) return true;
  fault(FAULT_EXPERT, "%s", function);
  call_ends(-1, ERROR_EXPERT);
  return false;
}

PUBLISHED int dhdErrorGetLast(void) {
  lock();
  const int error = is_chosen(LAST_ERROR, "thread") ? threads_error : process_error;
  unlock();
  return error;
}

PUBLISHED const char* dhdErrorGetStr(int error) {
  static const char* const names[] = {"no error",         "unspecified error", "communication error", "controller busy",
                                      "no driver",        "no device",         "not available",       "timeout",
                                      "geometry",         "expert mode off",   "not implemented",     "out of memory",
                                      "device not ready", "no file",           "configuration",       "invalid index",
                                      "deprecated",       "null argument",     "redundancy",          "not enabled",
                                      "device in use",    "invalid",           "no regulation"};
  return error >= 0 && error < (int)(sizeof names / sizeof *names) ? names[error] : "unknown error";
}

PUBLISHED const char* dhdErrorGetLastStr(void) {
  return dhdErrorGetStr(dhdErrorGetLast());
}

PUBLISHED int dhdEnableExpertMode(void) {
  lock();
  is_thread_expert = is_process_expert = true;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdDisableExpertMode(void) {
  lock();
  is_thread_expert = is_process_expert = false;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED double dhdGetTime(void) {
  lock();
  unlock();
  return (double)now_ns() / 1e9;
}

PUBLISHED void dhdSleep(double seconds) {
  lock();
  unlock();
  if (seconds > 0) usleep((useconds_t)(seconds * 1e6));
}
