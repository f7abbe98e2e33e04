/* Two processes: that of the servo loop, and that which holds a PHANToM, with the driver's own thread and a watch. A frame is the unit of
   time; whoever can do something may wait for any time, but not for ever. The watch goes by next() of device/phantom/ending.h, whose table
   ending_table prints as next_state(). tests/proofs/phantom_test.sh runs this, also with what is wrong: docs/phantom.md says
   what is shown. */
#include "ending.pml"
#define T 3              /* frames for which an order is obeyed */
/* What is wrong is a number in the environment of the checker, which so is compiled once; 0 or none: nothing is. */
c_code {
  \#include <stdlib.h>
  static int wrong;
  __attribute__((constructor)) static void read_wrong(void) { const char* its = getenv("WRONG"); wrong = its ? atoi(its) : 0; }
}
#define OBEYS_FOR_EVER c_expr { wrong == 1 }
#define PORT_STAYS c_expr { wrong == 2 }             /* open, when the process of the driver ends */
#define STAYS c_expr { wrong == 3 + now.state }      /* the watch, in this state whatever it sees */
byte state = held, age = T, since = 0;                   /* of the newest order; frames since the loop's process is gone */
bool ordered = false, force = false;                     /* some force: by the loop; felt by the arm */
bool lives = true, linked = true, still = false;         /* the loop's process, its end of the packets; it does nothing any more */
bool asked = false, interrupts = false, closed = false;  /* to close; by a signal; zero was sent last, or the device was released */
bool due = false, ended = false;                         /* words about a call that did not return; the process of the driver */

active proctype loop() {
  do
  :: lives -> atomic { ordered = true; age = 0 }
  :: lives -> atomic { ordered = false; age = 0 }
  :: atomic { lives -> lives = false; linked = false; break }  /* killed between any two steps: the system closes its end */
  :: atomic { still = true; break }                            /* or it stands still for ever */
  od
}
active proctype driver() {
  bool sent, troubled = false;
  do
  :: ended || closed -> break
  :: atomic { interrupts && !ended && !closed -> closed = true; force = false; break }
  :: !ended && !closed ->
     if
     :: skip
     :: skip ->  /* a call returns never, */
        atomic { interrupts || ended -> if :: !ended -> closed = true; force = false :: else fi }; break
     :: skip -> ended -> break  /* or not for a signal either */
     fi;
     troubled = troubled || (ordered && age >= T && !OBEYS_FOR_EVER);
     sent = ordered && !troubled && !asked;
     atomic {
       if :: !ended || PORT_STAYS -> force = sent :: else fi; age = (age < T -> age + 1 : T);
       since = (lives -> 0 : since + (since < 20))
     };
     if :: (troubled || asked) && !sent -> closed = true :: else fi
  od
}
active proctype watch() {
  byte looks = 0, before; bool late;
  do
  :: state != over ->
     if :: due = true :: skip fi;
     if :: looks >= 2 -> late = true :: looks < 2 -> late = false :: late = true fi;
     atomic { before = state; if :: STAYS :: else -> next_state(state, !linked, due, closed, late) fi;
              looks = (state == before -> looks + (looks < 2) : 0);
              asked = asked || state == closing; interrupts = interrupts || state == interrupting }
  :: state == over -> break
  od;
  atomic { ended = true; if :: PORT_STAYS :: else -> force = false fi }
}
ltl gone  { [] (!lives -> <> [] !force) }          /* the loop's process dies: the force becomes zero for ever, */
ltl soon  { [] (since <= T + 1 || !force) }       /* and is after as many frames */
ltl after { [] (ended -> !force) }                 /* the process of the driver ends: nothing is felt */
ltl still_is_zero { [] (still -> <> !force) }      /* false: the loop stands still with its end open, and a call returns never */
