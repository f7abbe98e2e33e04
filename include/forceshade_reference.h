/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef FORCESHADE_REFERENCE_H
#define FORCESHADE_REFERENCE_H
/* The exact side for programs in any language: the force of every law, height map and mesh by its definition, in as many decimal
 * digits as one likes, compared with rational numbers, or rounded once to binary32; and the property tests and certificates of
 * the renderer of forceshade.h. The library is libforceshade-reference.so.0.
 *
 *   const char text[] = "law = \"bump-2p\"\nradius = \"15.24mm\"\nwidth = \"25.4mm\"\nstiffness = \"0.5N/mm\"\n";
 *   forceshade_reference bump;
 *   float position[3] = {3, 0, -0.5f};                                            // mm
 *   char force[100];                                                              // N
 *   if (forceshade_reference_parse(text, sizeof text - 1, "bump.toml", &bump) == FORCESHADE_OK &&
 *       forceshade_reference_decimals(bump, position, 20, force, sizeof force, NULL, NULL) == FORCESHADE_OK)
 *     puts(force);
 *   else
 *     puts(forceshade_reference_message());
 *   forceshade_reference_free(bump);
 *
 * It shares no formula, constant or tolerance with what forceshade.h computes, which is why a comparison of the two says
 * something. It shares frame, units, results, statuses and the batch with forceshade.h, which states them.
 *
 * Errors. As in forceshade.h; but the sentence is in forceshade_reference_message(). Nothing throws, aborts, prints, or changes
 * the floating-point environment; but GMP, which computes with the exact numbers, ends the process where memory runs out within
 * it. What a callback throws may not leave it, and it may not jump out.
 *
 * Builds. Properties and certificates are checked of the copy of the renderer that this library holds. They say something of
 * libforceshade.so.0, which a program drives devices with, where it was compiled of the same objects: the functions that check are
 * FORCESHADE_FAILED where the digest of the one that is loaded, forceshade_library_digest(), is another.
 *
 * Threads. Definitions do not change: any number of threads may use one, as long as none frees it meanwhile. All functions may
 * be called from any thread at any time; what takes exact numbers is computed by one thread at a time.
 *
 * Real time. Call no function of this header in it: all allocate and take locks, and a force takes from a microsecond to a second.
 * The calling thread has to round to nearest and keep subnormals, or gets FORCESHADE_BAD_ARITHMETIC.
 *
 * Not promised: the words of messages and counterexamples, and the time of a call. */

#include <stddef.h>
#include <stdint.h>

#include "forceshade.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A definition: what a subject is, exactly. One that is all zero is never valid. It is worth nothing in another process, and is
 * no forceshade_subject. */
typedef struct forceshade_reference {
  uint64_t handle;
} forceshade_reference;

/* The sentence of this thread's last error of this library; "" before the first. Never NULL. It stays until this thread's next
 * error here; forceshade_message() is that of the other library. */
FORCESHADE_API const char* forceshade_reference_message(void);

/* ---- Definitions ---- */

/* A subject file (docs/subjects.md): a law, height map, mesh or scene. Files that it names lie beside it. FORCESHADE_BAD_INPUT
 * with file and line where it is refused. */
FORCESHADE_API forceshade_result forceshade_reference_read(const char* file, forceshade_reference* made);

/* The same of a text of so many bytes. file: what messages call it; the files that the text names lie beside it. */
FORCESHADE_API forceshade_result forceshade_reference_parse(const char* text, size_t length, const char* file,
                                                            forceshade_reference* made);

/* No thread may be in a call with the definition. */
FORCESHADE_API forceshade_result forceshade_reference_free(forceshade_reference reference);

/* ---- Exact forces ---- */

/* The force (N) at a position (mm, three floats) of a law or a height map as "x y z", each component correctly rounded to so many
 * significant decimal digits, 1 to 10000: what is exact in fewer has fewer. Digits are in positional notation; those of a height
 * map below 10^-5000 N are 1.25e-6000. A position that is FORCESHADE_INVALID or FORCESHADE_FREE has "0 0 0". Writes the text and
 * a zero at its end into `size` bytes, as much as there is room for; `length`, where it is not NULL, gets the length of the whole
 * text without the zero. text may be NULL where size is 0, and status always. A mesh's force depends on the path, so that it is
 * FORCESHADE_WRONG_KIND here. */
FORCESHADE_API forceshade_result forceshade_reference_decimals(forceshade_reference reference, const float* position,
                                                               uint32_t digits, char* text, size_t size, size_t* length,
                                                               forceshade_status* status);

/* -1, 0 or 1: the sign of a component of the force (N; axis 0 to 2 for x, y and z) less a rational number, exactly. rational:
 * "p/q", "-3/4", or a decimal, "-0.75", "7.5e-1", of 10000 characters at most and an exponent within +-10000. Where there is no
 * force, it is 0 that is compared. FORCESHADE_WRONG_KIND for a mesh. */
FORCESHADE_API forceshade_result forceshade_reference_compare(forceshade_reference reference, const float* position,
                                                              uint32_t axis, const char* rational, int32_t* sign);

/* The exact forces of a batch, each component rounded once to binary32, to nearest, ties to even; those of a mesh along a path from
 * its beginning. The rules for the batch are those of forceshade_forces(). invalid, where it is not NULL, gets the number of
 * positions that are FORCESHADE_INVALID. */
FORCESHADE_API forceshade_result forceshade_reference_forces(forceshade_reference reference, const forceshade_batch* batch,
                                                             size_t* invalid);

/* Compares forces that the caller has with the exact ones, bit for bit: batch->forces, and batch->statuses where they are not NULL,
 * are only read, and say what some renderer answered at batch->positions; those of a mesh along a path from its beginning. A zero
 * is +0. count gets the number of positions where a component or the status differs; first, where it is not NULL, the index of
 * the first of them, or batch->count where there is none. */
FORCESHADE_API forceshade_result forceshade_reference_differences(forceshade_reference reference,
                                                                  const forceshade_batch* batch, size_t* first,
                                                                  size_t* count);

/* d, h, w', h' (mm) and theta (rad) of a bump (docs/laws.md), one in a line, each correctly rounded to so many significant decimal
 * digits, 1 to 10000. radius: R, mm, in [0.1, 10^4]; width: w, mm, in [10^-3, 2R]. text, size and length as for
 * forceshade_reference_decimals(). */
FORCESHADE_API forceshade_result forceshade_reference_geometry(float radius, float width, uint32_t digits, char* text,
                                                               size_t size, size_t* length);

/* ---- Properties and certificates: of the renderer that forceshade.h calls ---- */

/* A property is finished: its name, 1 where it held in all cases and else 0, how many there were, and the simplest case that was
 * found to violate it, "" where it held. The texts live as long as the call. What is not 0 stops what called. */
typedef int32_t (*forceshade_reference_property)(void* user, const char* name, int32_t held, uint64_t cases,
                                                 const char* counterexample);

/* Runs the properties, each on so many generated cases (passivity, whose case is a whole loop, on a tenth of them): 1 to 10^9, or
 * 0 for the 2000 that a device is driven with. The same seed gives the same cases. callback is called by the calling thread, with
 * user, which may be NULL. A property that does not hold is no error, and neither is a callback that stops: no property is
 * finished after that. */
FORCESHADE_API forceshade_result forceshade_reference_properties(forceshade_reference reference, uint64_t cases, uint64_t seed,
                                                                 forceshade_reference_property callback, void* user);

/* The standing of a certificate. */
enum {
  FORCESHADE_REFERENCE_SUFFICIENT = 0,   /* every check held, and a device may be driven */
  FORCESHADE_REFERENCE_INSUFFICIENT = 1, /* every check held, but there is too little evidence to drive */
  FORCESHADE_REFERENCE_REFUTED = 2       /* a check failed; the certificate has the counterexample */
};

/* The amount to check. A member that is 0 stands for the amount that driving a device requires. */
typedef struct forceshade_reference_plan {
  size_t size;      /* sizeof(forceshade_reference_plan) */
  uint64_t points;  /* to compare, 1 to 10^12, and a quarter as many with other parameters; 0: 10^6 for a law, else 2 10^5 */
  uint64_t cases;   /* for each property, 1 to 10^9; 0: 2000 */
  uint64_t seed;    /* of points and cases; any number, also 0 */
  uint32_t threads; /* 1 to 1024; 0: one for each processor. The points do not depend on it */
} forceshade_reference_plan;

/* The share of the work that is done, 0 to 1. It is called from one thread at a time, which need not be the calling one. What is
 * not 0 stops. */
typedef int32_t (*forceshade_reference_progress)(void* user, double done);

/* Certifies the renderer for a definition, and writes the certificate (certificate/schema.md) to the file, whole or not at all;
 * forceshade_certificate_covers() reads it. FORCESHADE_OK where every check held; FORCESHADE_FAILED with the first counterexample
 * where one did not, although the certificate is written. standing, where it is not NULL, then gets one of the above; where no
 * certificate is written it is unchanged. progress may be NULL; where it stops, nothing is written, which is FORCESHADE_FAILED.
 * Nothing is written to standard output: "-" is FORCESHADE_BAD_VALUE. */
FORCESHADE_API forceshade_result forceshade_reference_certify(forceshade_reference reference,
                                                              const forceshade_reference_plan* plan, const char* file,
                                                              forceshade_reference_progress progress, void* user,
                                                              int32_t* standing);

#ifdef __cplusplus
}
#endif

#endif
