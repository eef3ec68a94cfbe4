/* hemicube: diffuse form factors and radiosity, for C99 and whatever calls C.
 *
 *   hc_scene_desc desc = {.struct_size = sizeof desc, .vertices = ...};
 *   hc_scene* scene;
 *   hc_solution* solution;
 *   if (hc_scene_create(&desc, &scene) != HC_OK || hc_solve(scene, NULL, NULL, &solution) != HC_OK)
 *     puts(hc_error_text());
 *
 * What holds for every call:
 * - It returns HC_OK or what went wrong, and hc_error_text says it in words. Arguments are checked:
 *   bad ones are an error and nothing else. What cannot be checked is the caller's: that arrays are
 *   as long as said, that handles are alive, that pointers point.
 * - A pointer must not be NULL unless its description says that it may be.
 * - Arrays are the caller's. They are read or filled during the call, never kept.
 * - A handle is made by a call whose name ends in _create or by hc_solve, and belongs to the caller
 *   until it is given to the _release of its kind, once. Handles keep what they need of others, and
 *   may be released in any order. After an error the handle is NULL, unless said otherwise.
 * - Any thread may call anything at any time, with the same handles too; but what is set for the
 *   whole process (hc_set_...) is set before other calls, and a handle's last release comes last.
 * - Structs begin with their size in bytes, which the caller sets; all else 0 is the default. Later
 *   versions add fields at the end and take what was compiled for earlier ones. A size that is not
 *   that of this version or an earlier one is HC_INVALID_ARGUMENT.
 * - The same input gives the same bits: for any number of threads, any executor, instruction set,
 *   compiler and machine. Callbacks must not throw, nor leave by longjmp.
 *
 * Units: metres, W/m^2. Patches, polygons, vertices and bands count from 0.
 */
#ifndef HEMICUBE_H
#define HEMICUBE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define HC_API __attribute__((visibility("default")))
#else
#define HC_API
#endif

#define HC_VERSION_MAJOR 0
#define HC_VERSION_MINOR 1
#define HC_VERSION_PATCH 0

/* "MAJOR.MINOR.PATCH" of the library that runs, which may be newer than this header. */
HC_API const char* hc_version(void);

/* ---- Errors ---- */

enum {
  HC_OK = 0,
  HC_INVALID_ARGUMENT = 1,     /* an argument is out of range, NULL, or of the wrong size */
  HC_BAD_SCENE = 2,            /* the scene cannot be modelled as it is */
  HC_OUT_OF_MEMORY = 3,        /* the allocator gave nothing */
  HC_NOT_CONVERGED = 4,        /* the solver stopped before its tolerance */
  HC_SINGULAR = 5,             /* the equations have no solution: light that nothing absorbs */
  HC_CANCELLED = 6,            /* a callback asked to stop */
  HC_BAD_FLOAT_ENVIRONMENT = 7 /* this build does not compute the promised bits */
};

/* What was wrong in the last call of this thread that failed: one line, "" before. Never NULL;
 * valid until the next failing call of this thread. */
HC_API const char* hc_error_text(void);

/* ---- For the whole process ---- */

/* Where all memory comes from. */
typedef struct hc_allocator {
  size_t struct_size;
  /* Returns `bytes` > 0 bytes aligned to 64, or NULL. From any thread, several at once. */
  void* (*allocate)(void* context, size_t bytes);
  /* Takes them back. memory is not NULL; bytes is what was asked for. */
  void (*release)(void* context, void* memory, size_t bytes);
  void* context; /* may be NULL */
} hc_allocator;

/* NULL: the C library's. Errors: HC_INVALID_ARGUMENT, also while there are handles. Memory that is
 * walked at random is asked for in multiples of 2 MiB: best aligned to that, on huge pages. */
HC_API int hc_set_allocator(const hc_allocator* allocator);

/* Told of what is noteworthy and no error, one line: repaired polygons, an unknown HEMICUBE_ISA in
 * the environment. From any thread, several at once. NULL: nobody, which is the default. */
HC_API int hc_set_log(void (*log)(void* context, const char* message), void* context);

/* Called when the library finds itself broken (it is then not to be called again). NULL: stops the
 * program, which is the default. */
HC_API int hc_set_assert(void (*failed)(void* context, const char* expression, const char* file,
                                        int line),
                         void* context);

/* ---- Scenes: polygons with materials ---- */

typedef struct hc_scene hc_scene;

typedef struct hc_scene_desc {
  size_t struct_size;
  const double* vertices; /* [vertex_count][3], finite */
  uint64_t vertex_count;
  const uint64_t* polygon_offsets; /* [polygon_count + 1]: polygon p has the corners indices[o[p]]
                                      .. indices[o[p + 1] - 1], 3 or more, counter-clockwise seen
                                      from its front; first 0, last index_count */
  uint64_t polygon_count;          /* >= 1 */
  const uint32_t* indices;         /* [index_count] into vertices */
  uint64_t index_count;
  const uint32_t* polygon_materials; /* [polygon_count], < material_count; NULL: all 0 */
  uint32_t material_count;           /* 0: one, black, which is enough for form factors */
  uint32_t band_count;               /* 0: one */
  const double* reflectance;         /* [material_count][band_count], 0..1; NULL: all 0 */
  const double* exitance;            /* [material_count][band_count], W/m^2, >= 0; NULL: all 0 */
  const uint8_t* two_sided;          /* [material_count], 0 or 1; NULL: all 0 */
  const double* space_exitance; /* [band_count], W/m^2, >= 0: what an unblocked direction radiates;
                                   NULL: all 0 */
} hc_scene_desc;

/* Makes patches of polygons, in their order: without area or with a repeated vertex: none; convex
 * and planar: one; others: one per triangle they are cut into. Then the backs of two-sided ones, in
 * the same order. What was left out or cut is counted (hc_scene_info). Errors: HC_INVALID_ARGUMENT,
 * HC_BAD_SCENE (an index or a number out of range: says which; no polygon has an area),
 * HC_OUT_OF_MEMORY. */
HC_API int hc_scene_create(const hc_scene_desc* desc, hc_scene** scene);
HC_API void hc_scene_release(hc_scene* scene); /* NULL: nothing */

typedef struct hc_scene_info {
  size_t struct_size;
  uint64_t patch_count;
  uint64_t front_count; /* patches before the first back of a two-sided polygon */
  uint64_t band_count;
  uint64_t dropped_repeated_index, dropped_zero_area; /* polygons */
  uint64_t triangulated_concave, triangulated_warped; /* polygons */
  uint64_t duplicate_polygons; /* with the vertices of an earlier one: kept */
  uint64_t scene_hash;         /* of patches and materials, as the program prints it */
} hc_scene_info;

HC_API int hc_scene_get_info(const hc_scene* scene, hc_scene_info* info);

/* Arrays to be filled, [patch_count] each; any may be NULL. */
typedef struct hc_patches {
  size_t struct_size;
  uint64_t patch_count; /* set by the caller: the length of the arrays, that of hc_scene_info */
  double* area;         /* m^2, > 0 */
  double* centre;       /* [][3]: area centroid */
  double* normal;       /* [][3]: unit, out of the front */
  uint32_t* polygon;    /* of the description */
} hc_patches;

HC_API int hc_scene_get_patches(const hc_scene* scene, const hc_patches* patches);

/* ---- Options ---- */

enum { /* how exact form factors are; each takes over what the one before knows */
       HC_RUNG_CHOSEN = 0, /* the cheapest that meets `error` */
       HC_RUNG_HEMICUBE = 1,
       HC_RUNG_ANALYTIC = 2,
       HC_RUNG_AREA = 3,
       HC_RUNG_ADAPTIVE = 4,
       HC_RUNG_EXACT = 5
};

enum { HC_SOLVER_GAUSS_SEIDEL = 0, HC_SOLVER_JACOBI = 1, HC_SOLVER_PROGRESSIVE = 2 };

enum { HC_STAGE_ROWS = 0, HC_STAGE_BALANCE = 1, HC_STAGE_SWEEPS = 2, HC_STAGE_SHOTS = 3 };

typedef struct hc_progress {
  size_t struct_size; /* set by the library: what there is to be read */
  int32_t stage;      /* HC_STAGE_... */
  uint64_t done;      /* rows, iterations, sweeps or shots */
  uint64_t total;     /* rows; 0 in other stages */
  double error;       /* closure residual; estimated error; unshot share; 0 of rows */
} hc_progress;

/* One of a call's pieces of work. @return 0 to go on; else blocks not begun need not be run. */
typedef int (*hc_block)(void* block_context, uint64_t block, uint32_t worker);

/* Threads of the caller's instead of the library's. */
typedef struct hc_executor {
  size_t struct_size;
  uint32_t worker_count; /* 1..1024 */
  /* Runs block(block_context, b, worker) for b = 0 .. block_count - 1, each once, in any order,
   * with worker < worker_count, blocks of one worker never at the same time, and returns when all
   * are done. Not called again before it has returned, but for each of several calls of the library
   * at once.
   * @return 0; else it failed. Then, or where a block was not run once, the library's call ends
   * with HC_INVALID_ARGUMENT */
  int (*run)(void* context, uint64_t block_count, hc_block block, void* block_context);
  void* context; /* may be NULL */
} hc_executor;

/* What a computation does. All zero but struct_size: the defaults of the program. */
typedef struct hc_options {
  size_t struct_size;
  int32_t rung;              /* HC_RUNG_... */
  uint32_t resolution;       /* pixels along the hemicube's edge, even, 16..2048; 0: chosen to meet
                                `error`, 256 at points */
  double error;              /* wanted, relative RMS of B (of F without light), 0..1; 0: 0.01 */
  double tolerance;          /* relative error of B that the solver may leave, 0..1; 0: 1e-6 */
  uint64_t max_sweeps;       /* 0: 1000000 */
  int32_t solver;            /* HC_SOLVER_... */
  int32_t balance;           /* 1: make form factors reciprocal */
  int32_t no_error_estimate; /* 1: errors are not estimated, nor `error` made sure of */
  int32_t no_black_irradiance; /* 1: not of patches that reflect nothing: NaN */
  double stop_unshot; /* progressive: stop at this share of unshot light, 0..1; 0: see README */
  uint64_t max_shots; /* progressive; 0: no limit */
  const char* isa;    /* "scalar", "sse41", "avx2", "avx512", "neon", "wasm"; NULL: the best */
  uint32_t threads;   /* workers, the caller included, at most 1024; 0: one per core */
  const hc_executor* executor; /* NULL: threads of the library's */
  /* NULL, or told how far a call is: from any worker, never twice at once.
   * @return not 0: the call ends with HC_CANCELLED */
  int (*progress)(void* context, const hc_progress* progress);
  /* NULL, or asked often whether to stop, by any worker, several at once.
   * @return not 0: as of progress */
  int (*is_cancelled)(void* context);
  void* context; /* of the two; may be NULL */
} hc_options;

/* ---- Certificates ---- */

/* The error report of a run; numbers that there are not are NaN, hashes 0. */
typedef struct hc_certificate {
  size_t struct_size;
  uint64_t patches, hemicubes, nonzeros;
  uint64_t subpixel_patches; /* entries of patches without a pixel of their own */
  int32_t rung;              /* asked for or chosen, HC_RUNG_... */
  uint32_t resolution;
  double target;                                             /* of HC_RUNG_ADAPTIVE */
  double row_sum_raw_min, row_sum_raw_mean, row_sum_raw_max; /* before closure */
  double row_sum_min, row_sum_mean, row_sum_max;
  double space_mean, space_max;              /* fraction of the hemisphere that sees space */
  double back_side_mean, back_side_max;      /* that sees back sides */
  double form_factor_error, radiosity_error; /* estimates, relative RMS */
  double reciprocity_max, reciprocity_rms;   /* how far from A_i F_ij = A_j F_ji */
  double balance_max_change, balance_rms_change, balance_closure_residual;
  double residual, estimated_error; /* of the solver; see radiosity/README.md */
  uint64_t sweeps, shots;
  double unshot, unshot_bound;
  int32_t solved, converged;
  uint64_t scene_hash, form_factor_hash, radiosity_hash; /* as the program prints them */
} hc_certificate;

/* ---- Form factors: of the light leaving i the share F_ij arrives at patch j ---- */

typedef struct hc_form_factors hc_form_factors;

/* Of all patches: row i is that of patch i. options: NULL: all defaults.
 * Errors: HC_INVALID_ARGUMENT, HC_BAD_SCENE (balance would change them too much), HC_OUT_OF_MEMORY,
 * HC_CANCELLED, HC_BAD_FLOAT_ENVIRONMENT; so for all that compute rows. */
HC_API int hc_form_factors_create(hc_scene* scene, const hc_options* options,
                                  hc_form_factors** form_factors);

/* Of some patches: row k is that of patch patches[k] (each < patch_count), count >= 1. Not with
 * balance. */
HC_API int hc_patch_form_factors_create(hc_scene* scene, const uint32_t* patches, uint64_t count,
                                        const hc_options* options, hc_form_factors** form_factors);

/* Seen from points: row k is that of a small surface at points[k] that faces along normals[k],
 * which need not be unit but not 0; [count][3] each, finite, count >= 1. Not with balance. */
HC_API int hc_point_form_factors_create(hc_scene* scene, const double* points,
                                        const double* normals, uint64_t count,
                                        const hc_options* options, hc_form_factors** form_factors);
HC_API void hc_form_factors_release(hc_form_factors* form_factors); /* NULL: nothing */

/* Rows, columns (patches) and non-zero entries. Any may be NULL. */
HC_API int hc_form_factors_get_size(const hc_form_factors* form_factors, uint64_t* rows,
                                    uint64_t* columns, uint64_t* nonzeros);

/* Compressed rows: row i has the entries offsets[i] .. offsets[i + 1] - 1, columns ascending.
 * @param row_count, nonzero_count  the caller's idea of the sizes: must be those of get_size
 * @param offsets  [row_count + 1]   @param columns, values  [nonzero_count]   Any may be NULL.
 * @param space, back_side  [row_count] what of the hemisphere sees space, and backs; may be NULL
 * Row sum + space + back side is 1. */
HC_API int hc_form_factors_get_csr(const hc_form_factors* form_factors, uint64_t row_count,
                                   uint64_t nonzero_count, uint64_t* offsets, uint32_t* columns,
                                   double* values, double* space, double* back_side);

HC_API int hc_form_factors_get_certificate(const hc_form_factors* form_factors,
                                           hc_certificate* certificate);

/* One row: F_ij = scale * values[k] for j = columns[k]. */
typedef struct hc_row {
  size_t struct_size; /* set by the library */
  uint64_t index;
  uint64_t count;
  const uint32_t* columns; /* [count], ascending */
  const float* values;     /* [count], > 0 */
  double scale, space, back_side;
} hc_row;

/* Takes one row, whose arrays are the library's and valid until it returns. Called from any worker,
 * never twice at once, in no fixed order. @return not 0: stop, with HC_CANCELLED */
typedef int (*hc_row_callback)(void* context, const hc_row* row);

/* The rows of all patches, each given away as soon as it is there and not kept. Bit for bit those
 * of hc_form_factors_create. Not with balance; errors are not estimated.
 * @param certificate  may be NULL */
HC_API int hc_form_factors_for_each(hc_scene* scene, const hc_options* options,
                                    hc_row_callback callback, void* context,
                                    hc_certificate* certificate);

/* ---- Light ---- */

typedef struct hc_solution hc_solution;

/* The light on every patch.
 * @param form_factors  NULL: computed on the way, only what is needed of them. Or those of all
 *                      patches of a scene with the same polygons: rung and resolution of the
 *                      options are then not looked at
 * @param options       NULL: all defaults
 * Errors: as of rows; HC_SINGULAR; HC_NOT_CONVERGED: the solution is there all the same. */
HC_API int hc_solve(hc_scene* scene, const hc_form_factors* form_factors, const hc_options* options,
                    hc_solution** solution);
HC_API void hc_solution_release(hc_solution* solution); /* NULL: nothing */

enum {                    /* values of a solution */
       HC_RADIOSITY = 0,  /* [patch][band] leaving flux per area, W/m^2 */
       HC_IRRADIANCE = 1, /* [patch][band] arriving, W/m^2 */
       HC_ROW_SUM = 2,    /* [patch] NaN where no row was made */
       HC_SPACE = 3,      /* [patch] fraction of the hemisphere that sees space */
       HC_BACK_SIDE = 4   /* [patch] fraction that sees back sides */
};

/* @param values  receives `count` numbers: exactly as many as there are */
HC_API int hc_solution_get_values(const hc_solution* solution, int quantity, uint64_t count,
                                  double* values);

typedef struct hc_energy { /* power in W, one band; NaN without the irradiance of black patches */
  size_t struct_size;
  double emitted, absorbed, back_side, escaped;
  double cut, unshot; /* shooting alone */
  double imbalance;   /* (emitted - all others) / emitted */
} hc_energy;

HC_API int hc_solution_get_energy(const hc_solution* solution, uint32_t band, hc_energy* energy);
HC_API int hc_solution_get_certificate(const hc_solution* solution, hc_certificate* certificate);

#ifdef __cplusplus
}
#endif

#endif
