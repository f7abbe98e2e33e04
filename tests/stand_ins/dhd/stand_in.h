// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A stand-in for the shared library of Force Dimension's DHD, with one device in a simulated hand. It judges the client that
// loads it. What outlives the client is in the state, which may be a mapped file that the client's starter reads.

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PUBLISHED __attribute__((visibility("default")))

enum { kFaults = 20, kSwitches = 23, kEvents = 19, kMostSessions = 16, kMostOrders = 32, kStatusLength = 17 };
enum { kSmall = 10 };  // mN: less is not felt
#define kGap 0.012     // m: of the gripper

// The faults of a client, by the documents. The order is that of the table in faults.c.
enum fault {
  FAULT_NOT_OPEN,
  FAULT_AFTER_CLOSE,
  FAULT_BAD_ID,
  FAULT_NULL,
  FAULT_RANGE,
  FAULT_EXPERT,
  FAULT_OPENED_TWICE,
  FAULT_FORCE_FIRST,
  FAULT_NOT_ENABLED,
  FAULT_AFTER_CUT,
  FAULT_UNCALIBRATED,
  FAULT_NOT_FINITE,
  FAULT_ABSURD,
  FAULT_BLIND,
  FAULT_GAP,
  FAULT_TWO_THREADS,
  FAULT_AFTER_UNPLUG,
  FAULT_FORCE_AT_END,
  FAULT_NO_STOP,
  FAULT_LEFT_OPEN,
};

// The choices that the documents leave open, and which device is connected. The order is that of the table in switches.c.
enum choice {
  SET_FORCE_OFF,
  NOT_FINITE,
  WATCHDOG,
  WATCHDOG_WORKS,
  TIME_GUARD,
  UNPLUGGED,
  LAST_ERROR,
  ERROR_KEPT,
  EXPERT,
  STATUS_LENGTH,
  BRAKES,
  FORCES,
  ENABLE_UNCALIBRATED,
  MAX_FORCE,
  CALL_TIME,
  MODEL,
  SERIAL,
  CALIBRATED,
  AVAILABLE,
  PRESSED,
  CLOCK,
  LONGEST_GAP,
  MOST_FORCE,
};

enum event {
  EVENT_UNPLUG,
  EVENT_LATE,
  EVENT_NAN,
  EVENT_GARBAGE,
  EVENT_WRONG_UNIT,
  EVENT_JUMP,
  EVENT_BUTTON,
  EVENT_OVERSPEED,
  EVENT_USB,
  EVENT_DEADMAN,
  EVENT_SATURATE,
  EVENT_TIME_GUARD,
  EVENT_READ_ERROR,
  EVENT_FORCE_ERROR,
  EVENT_UNCALIBRATED,
  EVENT_CALIBRATED,
  EVENT_PRESS,
  EVENT_POWER_OFF,
  EVENT_ERROR,
};

// The published error numbers that are given here, and the causes of forces that are off.
enum {
  ERROR_NONE = 0,
  ERROR_COM = 2,
  ERROR_NO_DEVICE = 5,
  ERROR_NOT_AVAILABLE = 6,
  ERROR_TIMEOUT = 7,
  ERROR_EXPERT = 9,
  ERROR_NOT_IMPLEMENTED = 10,
  ERROR_NOT_READY = 12,
  ERROR_INDEX = 15,
  ERROR_NULL = 17,
  ERROR_NOT_ENABLED = 19,
  ERROR_IN_USE = 20,
  ERROR_INVALID = 21,
};
enum { CAUSE_NONE = 0, CAUSE_BUTTON = 1, CAUSE_VELOCITY = 2, CAUSE_WATCHDOG = 3, CAUSE_USB = 5, CAUSE_DEADMAN = 6 };

struct recorded_fault {
  uint64_t count, call;  // of the first
  int32_t session;
  char words[96];
};

struct session {
  uint64_t readings, forces, contact_forces, calls;
  int64_t opened_ns, last_force_ns, closed_ns, enabled_ns;
  double largest_force, longest_gap_ms, force_at_end;  // N, ms, N
  int32_t thread;                                      // that sent forces
  int32_t since_reading;                               // forces
};

struct arm {
  double time;                                // s
  double position[3], velocity[3], force[3];  // m, m/s, N: the vendor's axes; the force that acts
};

// Everything that outlives the client, and the device itself.
struct state {
  uint64_t mark;
  bool called;  // any function, by the client
  char settings[1024];
  struct recorded_fault faults[kFaults];
  struct session sessions[kMostSessions];
  int32_t session_count;
  int32_t owner;  // the process that has the device open; 0: none
  struct arm arm;
  int64_t time_ns;  // up to which the arm has moved
  bool forces_on, brakes_on, gravity, reset, powered, plugged, was_in_contact, was_settling, has_error, pressed;
  int32_t cause;                    // of the forces being off
  int64_t cut_ns, unplugged_ns;     // times: the device switched them off by itself; it was unplugged
  int32_t watchdog, time_guard_us;  // units of 125 µs; µs
  // N, N·m, N; negative: none
  double max_force, max_torque, max_gripper_force;
  double effector_mass;  // kg
  double base_angle[2];  // rad about x and z
  uint32_t velocity_threshold;
  double commanded[3];  // N
  double last_read[3];  // m
  int64_t last_read_ns;
};

// switches.c
struct choice_entry {
  const char *name, *values, *words;  // values: separated by |, the first is the default; NUMBER stands for any number from 0
};
extern const struct choice_entry kChoices[kSwitches];
struct event_entry {
  const char *name, *words;
};
extern const struct event_entry kEventTable[kEvents];
const char* chosen(enum choice choice);
bool is_chosen(enum choice choice, const char* value);
double number_chosen(enum choice choice);
// NAME=VALUE and EVENT@READING or EVENT@contact, separated by commas. The first error, or null.
const char* read_settings(const char* text);
// Calls for each event of this reading; 0 stands for contact.
void events_at(uint64_t reading, void (*happen)(enum event));

// faults.c
extern const struct choice_entry kFaultTable[kFaults];
extern struct state* state;
void begin_state(void);  // once, by the first call
int64_t now_ns(void);
[[gnu::format(printf, 2, 3)]] void fault(enum fault fault, const char* words, ...);
// A line of the journal: an event's name and its session.
void note(const char* event);
struct session* session(void);

// arm.c
void arm_begin(struct arm* arm);
void arm_advance(struct arm* arm, double seconds);

// device.c
void device_opened(void);
void device_advance(void);  // to now: the arm moves, and the watchdog's time may be over
void device_cut(int cause);
void device_happen(enum event event);
// Takes what an event leaves for the next call; true once.
bool take_pending(enum event event);
double length(const double force[3]);
double small(void);

// calls.c: each published function of a device begins and ends so, and holds the lock in between.
bool call_begins(const char* function, signed char id);  // false: it has failed, and the lock is free
int call_ends(int result, int error);                    // the result; sets the last error where it is negative
void lock(void);
void unlock(void);
void set_error(int error);
bool is_expert(void);
bool expert_call_begins(const char* function, signed char id);  // the same for a function of the expert mode

// opening.c
bool has_gripper(void);

// frames.c: the one reading of the position, in m; the angles are 0, and the matrix, where one is asked for, that of rest.
int read_position(const char* function, double* x, double* y, double* z, double* a, double* b, double* c, double matrix[3][3],
                  signed char id);
