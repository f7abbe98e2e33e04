/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef FORCESHADE_H
#define FORCESHADE_H
/* Haptic force laws, height maps and triangle meshes for programs in any language: each component of each force is the exact
 * force rounded to binary32, to nearest, ties to even.
 *
 *   forceshade_law parameters = {sizeof parameters, 15.24f, 25.4f, 0.5f};         // mm, mm, N/mm
 *   forceshade_subject bump;
 *   float position[3] = {3, 0, -0.5f}, force[3];                                  // mm, N
 *   if (forceshade_law_new("bump-2p", &parameters, &bump) == FORCESHADE_OK &&
 *       forceshade_force(bump, position, force, NULL) == FORCESHADE_OK)
 *     printf("%g N\n", force[2]);
 *   else
 *     puts(forceshade_message());
 *   forceshade_subject_free(bump);
 *
 * Frame and units. x points right, y into the page, z up (docs/laws.md). Lengths are in mm, forces in N, stiffnesses in N/mm. A
 * coordinate below 2^-30 mm in size is read as 0; one beyond 10^4 mm, or NaN, makes its position FORCESHADE_INVALID.
 *
 * Errors. Every function that can fail returns a forceshade_result, FORCESHADE_OK or the kind of the error, and then leaves a
 * sentence for people in forceshade_message(). What a function was to write is then unchanged, unless it says otherwise. Nothing
 * throws, aborts, prints, or changes the floating-point environment.
 *
 * Threads. Subjects do not change: any number of threads may use one, as long as none frees it meanwhile. A session or a scene is
 * for one thread at a time: a second one gets FORCESHADE_BUSY. So is a state of damping, which nothing guards. All other functions
 * may be called from any thread at any time.
 *
 * Real time. forceshade_force(), forceshade_forces() and the functions that step a session allocate nothing and take no lock, but
 * memory where very many triangles meet (docs/soups.md). The thread has to be as forceshade_arithmetic_fault() demands.
 *
 * Not promised: the words of messages, and the time of a call (docs/speed.md has figures). A program that was built with an
 * older header of the same major version goes on working: structs say their size, and only grow at their end. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define FORCESHADE_API __declspec(dllexport)
#elif defined(__GNUC__)
#define FORCESHADE_API __attribute__((visibility("default")))
#else
#define FORCESHADE_API
#endif

/* The version of this header; forceshade_version() is that of the library. */
#define FORCESHADE_VERSION_MAJOR 0
#define FORCESHADE_VERSION_MINOR 1
#define FORCESHADE_VERSION_PATCH 0

typedef int32_t forceshade_result;
enum {
  FORCESHADE_OK = 0,
  FORCESHADE_NULL_POINTER = 1,   /* an argument that may not be NULL */
  FORCESHADE_BAD_HANDLE = 2,     /* a subject or session that was never made, or is freed */
  FORCESHADE_BAD_SIZE = 3,       /* the size of a struct, a count or a stride */
  FORCESHADE_BAD_VALUE = 4,      /* a number outside its domain, or an unknown word */
  FORCESHADE_BAD_INPUT = 5,      /* a file or text that is refused; the message has file and line */
  FORCESHADE_WRONG_KIND = 6,     /* a request that a subject of this kind cannot answer */
  FORCESHADE_BUSY = 7,           /* another thread is in this session or scene */
  FORCESHADE_BAD_ARITHMETIC = 8, /* the calling thread's: forceshade_arithmetic_fault() */
  FORCESHADE_NO_MEMORY = 9,
  FORCESHADE_FAILED = 10,        /* anything else */
  FORCESHADE_NOT_COVERED = 11,   /* a certificate does not cover the subject */
  FORCESHADE_LEFT_OUT = 12       /* a feature that this build of the library lacks: forceshade_has() */
};

/* The status of a position. */
typedef uint8_t forceshade_status;
enum {
  FORCESHADE_FREE = 0,      /* outside: no force */
  FORCESHADE_CONTACT = 1,   /* inside */
  FORCESHADE_INVALID = 2,   /* a coordinate is NaN or beyond 10^4 mm: no force */
  FORCESHADE_UNFINISHED = 3 /* a contact whose god-object used up the moves or looks of a tick; the next tick goes on from there */
};

/* Handles. One that is all zero is never valid. A handle is worth nothing in another process. */
typedef struct forceshade_subject {
  uint64_t handle;
} forceshade_subject;
typedef struct forceshade_session {
  uint64_t handle;
} forceshade_session;
typedef struct forceshade_scene {
  uint64_t handle;
} forceshade_scene;

/* ---- The library ---- */

/* 0x00MMmmpp: major, minor, patch. */
FORCESHADE_API uint32_t forceshade_version(void);

/* 1 where the library has the feature, else 0, also for NULL: "laws", "height-maps", "meshes", "states", "scenes" and "damping",
 * which every build has, and so "corner-normals" of meshes; "subject-files", "image-files", "csv-files" and "certificates", which a
 * build for another machine may be without, and "device-loop" and "exact-side", which say whether the same build has these libraries
 * for C++ (docs/platforms.md); and "avx2", "avx512" where it will use these instructions on this processor. Without "certificates"
 * the FORCESHADE_DIGEST of a subject is "". */
FORCESHADE_API int32_t forceshade_has(const char* feature);

/* The sentence of this thread's last error; "" before the first. Never NULL. It stays until this thread's next error. */
FORCESHADE_API const char* forceshade_message(void);

/* The name of a result without its prefix, "BAD_HANDLE"; "" for an unknown number. Never NULL; lives as long as the process. */
FORCESHADE_API const char* forceshade_name_of_result(forceshade_result result);

/* SHA-256, in 64 hexadecimal digits, of the compiled objects that answer here: what a certificate is bound to. */
FORCESHADE_API const char* forceshade_library_digest(void);

/* The fault of the calling thread's arithmetic against IEEE 754 rounding to nearest, as a noun; NULL if nothing was
 * found. Every force that is given under a fault is unproved. */
FORCESHADE_API const char* forceshade_arithmetic_fault(void);

/* ---- Subjects: what is rendered ---- */

/* The parameters of a law. */
typedef struct forceshade_law {
  size_t size;     /* sizeof(forceshade_law) */
  float radius;    /* R, mm, in [0.1, 10^4]; the wall reads the stiffness alone */
  float width;     /* w, mm, the chord of the bump on the plane, in [10^-3, 2R] */
  float stiffness; /* K, N/mm, in [10^-3, 10^3] */
} forceshade_law;

/* law: a name of docs/laws.md: "wall", "cylinder", "bump-cylinder", or "bump-1p", "bump-2p" or "bump-3p", also with "-shaded". */
FORCESHADE_API forceshade_result forceshade_law_new(const char* law, const forceshade_law* parameters, forceshade_subject* made);

/* A height map of samples in a rectangular grid, whose middle is the origin. */
typedef struct forceshade_height_map {
  size_t size;              /* sizeof(forceshade_height_map) */
  const float* heights;     /* mm, within +-10^4, 0 below 2^-30; read while it is made, and not kept */
  uint32_t columns, rows;   /* along x and y; 2 to 2^15 each, 2^26 samples at most */
  ptrdiff_t column_stride;  /* bytes from a sample to the next one along x; a multiple of 4 */
  ptrdiff_t row_stride;     /* bytes from a sample to the next one along y, from the smallest y; a multiple of 4 */
  float pitch;              /* mm between samples */
  const char* interpolant;  /* "bilinear" or "cubic-spline", which goes through the heights; NULL is "cubic-spline" */
  const char* edge;         /* beyond the grid: "clamp" or "tile"; NULL is "clamp" */
  const char* render;       /* "height-map", "height-map-shaded" or "height-map-conservative"; NULL is "height-map" */
  float stiffness;          /* K, N/mm, in [10^-3, 10^3] */
} forceshade_height_map;

FORCESHADE_API forceshade_result forceshade_height_map_new(const forceshade_height_map* map, forceshade_subject* made);

/* The properties of a triangle's surface that a hand feels (docs/meshes.md, "Materials and friction"). */
typedef struct forceshade_material {
  size_t size;            /* sizeof(forceshade_material) */
  float stiffness;        /* K, N/mm, in [10^-3, 10^3]; 0 is that of the mesh */
  float static_friction;  /* a coefficient: 0, infinity, or 2^-10 to 2^10; at least the dynamic one */
  float dynamic_friction;
} forceshade_material;

/* Any triangles, of which one has an area. Whether they are a regular mesh (docs/meshes.md) or docs/soups.md defines their forces
 * is found exactly, in a second for some hundred thousand. FORCESHADE_BAD_VALUE has the numbers of faces and vertices. */
typedef struct forceshade_mesh {
  size_t size;               /* sizeof(forceshade_mesh) */
  const float* vertices;     /* mm, three for each vertex; read while the mesh is made, and not kept */
  size_t vertex_count;
  const uint32_t* triangles; /* three numbers of vertices, from 0, for each; (b - a) x (c - a) points to the front */
  size_t triangle_count;
  const char* sides;         /* that block: "front" or "both"; NULL is "front" for a closed mesh and "both" for another */
  const char* shading;       /* "none", "vertex" or, if regular, "edge"; NULL is "vertex", and "none" with "sub-goal" */
  const char* contact;       /* "direct", "friction" or, if regular, "sub-goal"; NULL is "friction" if a material has some, else "direct" */
  double crease;             /* degrees, 0 to 180, for normals of the vertex scheme and of sub-goals; 180 has no creases */
  float stiffness;           /* K, N/mm, in [10^-3, 10^3] */
  int32_t self_intersecting; /* deprecated, and not read: triangles of any mesh may cross */
  /* Here ends the struct of a program that was built before there were materials; its mesh has none. */
  const forceshade_material* materials; /* read while the mesh is made; not NULL where there are some */
  size_t material_count;                /* 0: no friction, and the stiffness of the mesh */
  const uint32_t* material_of_triangle; /* the number of its material, from 0, for each; NULL: all have the first */
} forceshade_mesh;

FORCESHADE_API forceshade_result forceshade_mesh_new(const forceshade_mesh* mesh, forceshade_subject* made);

/* A subject file (docs/subjects.md): a law, height map, mesh or scene. Files that it names lie beside it. FORCESHADE_LEFT_OUT, with the
 * feature in the message, where it names a PNG or TIFF file, or one of a motion, that this library cannot read. */
FORCESHADE_API forceshade_result forceshade_subject_read(const char* file, forceshade_subject* made);

/* The same of a text of so many bytes. file: what messages call it; the files that the text names lie beside it. */
FORCESHADE_API forceshade_result forceshade_subject_parse(const char* text, size_t length, const char* file,
                                                          forceshade_subject* made);

/* Its sessions stay. No thread may be in a call with the subject. */
FORCESHADE_API forceshade_result forceshade_subject_free(forceshade_subject subject);

/* The parts of a subject's identity, as certificates have it. */
enum {
  FORCESHADE_KIND = 0,       /* "law", "height map" or "mesh" */
  FORCESHADE_NAME = 1,       /* of the law, or of the file; "samples" or "triangles" where there was no file */
  FORCESHADE_PARAMETERS = 2, /* "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm" */
  FORCESHADE_DIGEST = 3      /* SHA-256, in hexadecimal digits, of what name and parameters leave out; "" for a law */
};

/* Writes the text and a zero at its end into `size` bytes, as much as there is room for; `length`, where it is not NULL, gets
 * the length of the whole text without the zero. text may be NULL where size is 0. */
FORCESHADE_API forceshade_result forceshade_subject_text(forceshade_subject subject, int32_t what, char* text, size_t size,
                                                         size_t* length);

/* Checks whether a device may be driven with the subject: FORCESHADE_OK where the certificate, a file that `forceshade certify`
 * wrote, is of this very library, covers the subject, and has enough evidence; FORCESHADE_NOT_COVERED with the reason where it
 * does not, or was compared with a renderer that is not the library's; FORCESHADE_BAD_INPUT for a file that is no certificate.
 * A library that was exchanged after certification has another digest (docs/certificate.md, "What drive refuses"). */
FORCESHADE_API forceshade_result forceshade_certificate_covers(const char* file, forceshade_subject subject);

/* ---- Forces ---- */

/* The force (N, three floats) at a position (mm, three floats) of a law or a height map. status may be NULL. A mesh's force
 * depends on the path, so that it is FORCESHADE_WRONG_KIND here. */
FORCESHADE_API forceshade_result forceshade_force(forceshade_subject subject, const float* position, float* force,
                                                  forceshade_status* status);

/* Many positions and their forces. Strides are in bytes, multiples of 4, and may be negative; an array of (n, 3) floats without
 * gaps has 12 and 4. The forces may take the place of the positions, with the same strides; any other overlap is not allowed. */
typedef struct forceshade_batch {
  size_t size;                        /* sizeof(forceshade_batch) */
  size_t count;                       /* of positions; 0 does nothing */
  const float* positions;             /* mm */
  ptrdiff_t position_stride;          /* from a position to the next one */
  ptrdiff_t position_component;       /* from x to y, and from y to z */
  float* forces;                      /* N */
  ptrdiff_t force_stride;             /* as for positions; not 0 */
  ptrdiff_t force_component;
  forceshade_status* statuses;        /* one for each, or NULL */
  ptrdiff_t status_stride;            /* from a status to the next one; 1 without gaps */
  size_t threads;                     /* that share the work of forceshade_forces() and of what advances: at most 256, and one
                                       * for each 1024 positions; 0 and 1: the calling one alone. Starting the others takes
                                       * memory, and some 20 us each */
} forceshade_batch;

/* Bit for bit what forceshade_force() gives for each, with the widest instructions of the processor, on however many threads.
 * invalid, where it is not NULL, gets the number of positions that are FORCESHADE_INVALID. */
FORCESHADE_API forceshade_result forceshade_forces(forceshade_subject subject, const forceshade_batch* batch, size_t* invalid);

/* ---- Sessions: one path of the hand ---- */

/* At the beginning of a path. */
FORCESHADE_API forceshade_result forceshade_session_open(forceshade_subject subject, forceshade_session* made);
FORCESHADE_API forceshade_result forceshade_session_close(forceshade_session session);

/* The next position of the path (mm, three floats) and the force there (N, three floats). status may be NULL. */
FORCESHADE_API forceshade_result forceshade_session_step(forceshade_session session, const float* position, float* force,
                                                         forceshade_status* status);

/* The next positions of the path, one after the other. */
FORCESHADE_API forceshade_result forceshade_session_steps(forceshade_session session, const forceshade_batch* batch,
                                                          size_t* invalid);

/* Back to the beginning of a path. */
FORCESHADE_API forceshade_result forceshade_session_reset(forceshade_session session);

/* All that a session remembers of its path: the god-object of a mesh, exact and the same on every machine. A law or a height map
 * remembers nothing, which is FORCESHADE_NOWHERE. What a place does not use is 0. */
enum {
  FORCESHADE_NOWHERE = 0, /* no valid position has come yet */
  FORCESHADE_IN_THE_OPEN = 1,
  FORCESHADE_AT_VERTEX = 2,
  FORCESHADE_ON_EDGE = 3,
  FORCESHADE_IN_TRIANGLE = 4
};
/* The other places on a mesh that is not regular (docs/soups.md). A foot is the point of its feature nearest to `position`. */
enum {
  FORCESHADE_MEETS_NOTHING = 0,    /* the place says all */
  FORCESHADE_ON_LINE = 1,          /* of triangles {i, j}, where the weight of corner further[0] of i is parameter[0] */
  FORCESHADE_MEETS_EDGE = 2,       /* edge {a, b} and edge `further` */
  FORCESHADE_MEETS_TRIANGLE = 3,   /* edge {a, b} and triangle further[0] */
  FORCESHADE_MEETS_TRIANGLES = 4,  /* triangles {i, j} and further[0] */
  FORCESHADE_FOOT_IN_TRIANGLE = 5, /* on the plane of triangle {i} */
  FORCESHADE_FOOT_ON_EDGE = 6,     /* on edge {a, b} */
  FORCESHADE_FOOT_ON_LINE = 7      /* on the line of triangles {i, j}, whose grid is that of corner further[0] of i */
};
typedef struct forceshade_state {
  size_t size;           /* sizeof(forceshade_state) */
  uint8_t place;         /* one of the above */
  uint8_t side;          /* of the surface: 0 front, 1 back */
  uint8_t slipping;      /* 1 where friction has let it slip and does not hold it yet, else 0 */
  float position[3];     /* mm; in the open, and for a foot the hand */
  uint32_t index[2];     /* vertex: {v}; edge: {a, b}, a < b; triangle: {i}; triangles: {i, j} */
  uint32_t parameter[2]; /* in units of 2^-24. Edge: a + m (b - a): {m}. Triangle: a + k (b - a) + l (c - a): {k, l}. Line: {k} */
  uint8_t meeting;       /* what it meets, as above. Here ended the struct before meshes that are not regular, which need all of it */
  uint32_t further[2];
  uint32_t cell[2];      /* with `side` the name of its cell (docs/soups.md): a triangle, and the number of a piece in it */
} forceshade_state;

/* After the last step. state->size has to be set. */
FORCESHADE_API forceshade_result forceshade_session_state(forceshade_session session, forceshade_state* state);

/* Goes on from a state of the same subject. A state that is invalid for this mesh counts, and is kept, as FORCESHADE_NOWHERE. */
FORCESHADE_API forceshade_result forceshade_session_resume(forceshade_session session, const forceshade_state* state);

/* One tick of each of many paths, as of the hands in a learning loop: path i is at states[i], its next position is that of the
 * batch, and states[i] is then what the tick left. A state that is 0, or invalid for this mesh, begins a path. Bit for bit what
 * a session of its own gives for each path, on however many threads. Of a law or a height map, which remember nothing, the
 * states stay as they are. On a mesh that is not regular the call takes memory. states: batch->count of them; states[0].size has
 * to be set, and is that of each. */
FORCESHADE_API forceshade_result forceshade_advance(forceshade_subject subject, forceshade_state* states,
                                                    const forceshade_batch* batch, size_t* invalid);

/* ---- Scenes: one path of the hand through objects that move ---- */

/* The pose of an object: its point a is at R a + translation in the world, R the quaternion's exact rotation (docs/scenes.md). */
typedef struct forceshade_pose {
  float translation[3]; /* mm, within +-10^4; 0 below 2^-30 */
  float rotation[4];    /* w, x, y, z, of any length: each 0 or of a size from 2^-30 to 2, and not all 0 */
} forceshade_pose;

/* Objects at the beginning of a path: 1 to 32 laws, height maps and meshes, of which one may come several times. The subjects may
 * be freed before the scene is closed. */
FORCESHADE_API forceshade_result forceshade_scene_open(const forceshade_subject* objects, size_t count, forceshade_scene* made);
FORCESHADE_API forceshade_result forceshade_scene_close(forceshade_scene scene);

/* The next position of the hand (mm, three floats, in the world), with one pose for each object, and the force there (N, three
 * floats): the exact sum of the objects' forces, turned into the world's axes, rounded once. status may be NULL; it is
 * FORCESHADE_INVALID, and the force 0, where the position, a pose, or where an object sees the hand, is outside the domain. */
FORCESHADE_API forceshade_result forceshade_scene_step(forceshade_scene scene, const float* position, const forceshade_pose* poses,
                                                       size_t count, float* force, forceshade_status* status);

/* The force of one object in the last step, in its own axes. status may be NULL. */
FORCESHADE_API forceshade_result forceshade_scene_object(forceshade_scene scene, size_t object, float* force,
                                                         forceshade_status* status);

/* ---- Damping: the force of any renderer and the speed of the hand (docs/damping.md) ---- */

/* With damping and drag 0, force and state stay as they are. */
typedef struct forceshade_damping {
  size_t size;   /* sizeof(forceshade_damping) */
  float rate;    /* r, Hz, of the device: 1 to 2^17 */
  float share;   /* that of the new velocity in the filter: 2^-10 to 1; 1 is no filter */
  float damping; /* B, N s/mm along the force: 0, or 2^-20 to 16 */
  float most;    /* S, the most by which damping lengthens the force: 1 to 1024, or infinity; usual: 2 */
  float drag;    /* B_t, N s/mm across the force: 0, or 2^-20 to 16 */
  float full_at; /* F_0, N, the force from which on drag is full: 2^-10 to 1024; usual: 0.25 */
} forceshade_damping;

/* That of the subject's file, its table [damping], at a rate (Hz); off without one. damping->size has to be set. The subject's
 * forces are without it: the functions below put it behind them. FORCESHADE_WRONG_KIND, although the damping is written, where
 * the subject's materials limit it: forceshade_session_damped_step() and forceshade_scene_damped_step() damp each face as its
 * material lets them; the others see forces alone. */
FORCESHADE_API forceshade_result forceshade_subject_damping(forceshade_subject subject, float rate, forceshade_damping* damping);

/* One that is 0 but for its size begins a path, as does one that no tick leaves. */
typedef struct forceshade_damping_state {
  size_t size;          /* sizeof(forceshade_damping_state) */
  uint8_t has_position; /* 0: no valid position has come yet, and all else is 0 */
  uint8_t periods;      /* since that position; 17 stands for all above 16 */
  float position[3];    /* mm: the last valid one, as it is read */
  float velocity[3];    /* mm/s: each 0, or of a size from 2^-20 to 2^32 */
} forceshade_damping_state;

/* Damps the force (N, three floats) that a renderer gave at the next position of a path (mm, three floats), in its place.
 * periods: those since the tick before, 1 unless some were missed; 0 answers the same reading of the device again. status: the
 * renderer's, and afterwards that of the damped force; NULL: FORCESHADE_CONTACT. If it is FORCESHADE_INVALID, or the position is,
 * the force becomes 0. It allocates nothing, takes no lock, and may be called from any thread. */
FORCESHADE_API forceshade_result forceshade_damping_step(const forceshade_damping* damping, forceshade_damping_state* state,
                                                         uint32_t periods, const float* position, float* force,
                                                         forceshade_status* status);

/* forceshade_session_step() and forceshade_damping_step() at once, on each face with the damping that its material lets act. */
FORCESHADE_API forceshade_result forceshade_session_damped_step(forceshade_session session, const forceshade_damping* damping,
                                                                forceshade_damping_state* state, uint32_t periods,
                                                                const float* position, float* force,
                                                                forceshade_status* status);

/* The same of forceshade_scene_step(). */
FORCESHADE_API forceshade_result forceshade_scene_damped_step(forceshade_scene scene, const forceshade_damping* damping,
                                                              forceshade_damping_state* state, uint32_t periods,
                                                              const float* position, const forceshade_pose* poses, size_t count,
                                                              float* force, forceshade_status* status);

/* forceshade_damping_step() for the next positions of a path, one after the other: the forces and statuses of the batch are those
 * of a renderer, and afterwards the damped ones. The forces may not take the place of the positions. periods: one for each, or NULL
 * for 1 each. */
FORCESHADE_API forceshade_result forceshade_damping_steps(const forceshade_damping* damping, forceshade_damping_state* state,
                                                          const uint32_t* periods, const forceshade_batch* batch, size_t* invalid);

/* The same for one tick of each of many paths, on batch->threads: path i is at states[i]. states: batch->count of them;
 * states[0].size has to be set, and is that of each. */
FORCESHADE_API forceshade_result forceshade_damping_advance(const forceshade_damping* damping, forceshade_damping_state* states,
                                                            const uint32_t* periods, const forceshade_batch* batch,
                                                            size_t* invalid);

/* ---- Your own renderer, which `forceshade conform --command FILE.so` holds against the exact forces ---- */

/* The functions of a shared object that is a renderer (examples/renderers/wall.c); it links nothing of forceshade, and a program
 * that only calls forceshade does not need them. The object is loaded in a process of its own, and its functions are called by
 * one thread, each after the one before has returned. No member may be NULL but one of `answer` and `answer_after`. */
typedef struct forceshade_renderer {
  size_t size; /* sizeof(forceshade_renderer) */

  /* Opens it on a scene: JSON, ended by a zero, as in docs/conformance-protocol.md. Returns 0, and writes to `state` what the
   * other functions get, and to `hello` the JSON of the same page's hello, ended by a zero: what it is and can do, and
   * "accepts":false where it does not render this scene. Anything but 0 fails, and `hello` may then be a sentence why. The text
   * has to stay until close() returns; both are NULL before. */
  int32_t (*open)(const char* scene, void** state, const char** hello);

  /* The answers for the next `count` positions of the path (1 to 1024 of them, any bits), three floats for each position and
   * each answer: in the units and frame of its hello. is_reset: 1 where a new path begins with them, from no contact, and else 0.
   * Returns 0; anything else fails. Answers that it does not write are NaN. */
  int32_t (*answer)(void* state, const float* positions, float* answers, size_t count, int32_t is_reset);

  /* Called once after an open() that returned 0. */
  void (*close)(void* state);

  /* The same as answer(), and called in its place unless it is NULL. A renderer whose hello declares damping has it: periods are
   * those from the position before to each, `count` of them. */
  int32_t (*answer_after)(void* state, const float* positions, const uint32_t* periods, float* answers, size_t count,
                          int32_t is_reset);
} forceshade_renderer;

/* The type of the one function that the object exports, forceshade_renderer_entry(). Its table stays while the object is loaded. */
typedef const forceshade_renderer* forceshade_renderer_function(void);

#ifdef __cplusplus
}
#endif

#endif
