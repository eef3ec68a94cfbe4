/* A closed room of 6 x n x n patches with a light in its ceiling: form factors, their closure,
 * light.
 *
 *   cc -std=c99 room.c -lhemicube -o room && ./room
 *
 * exits with 0 if every row closes. */
#include "hemicube.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 4, kPatches = 6 * n * n };

static double vertices[4 * kPatches][3];
static uint32_t indices[4 * kPatches];
static uint64_t offsets[kPatches + 1];
static uint32_t materials[kPatches];

/* Squares of the wall where coordinate `axis` is 0 or 1, each with its own four vertices, fronts
 * inwards. */
static void add_wall(int wall) {
  const int axis = wall / 2, side = wall % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int k = 0; k < n * n; ++k) {
    const int patch = wall * n * n + k;
    for (int c = 0; c < 4; ++c) {
      const int corner = side == 0 ? c : 3 - c;
      double* vertex = vertices[4 * patch + c];
      vertex[axis] = side;
      vertex[u] = (double)(k / n + (corner == 1 || corner == 2)) / n;
      vertex[v] = (double)(k % n + (corner >= 2)) / n;
      indices[4 * patch + c] = (uint32_t)(4 * patch + c);
    }
    offsets[patch + 1] = 4 * (uint64_t)(patch + 1);
  }
}

static int check(int code, const char* what) {
  if (code != HC_OK) {
    fprintf(stderr, "%s: %s\n", what, hc_error_text());
    exit(1);
  }
  return code;
}

int main(void) {
  static const double reflectance[2] = {0.7, 0.0}, exitance[2] = {0, 100};
  for (int wall = 0; wall < 6; ++wall)
    add_wall(wall);
  materials[5 * n * n + n + 1] = 1; /* the light, of 1/n x 1/n metres, in the wall z = 1 */

  hc_scene_desc desc = {.struct_size = sizeof desc};
  desc.vertices = &vertices[0][0];
  desc.vertex_count = 4 * kPatches;
  desc.polygon_offsets = offsets;
  desc.polygon_count = kPatches;
  desc.indices = indices;
  desc.index_count = 4 * kPatches;
  desc.polygon_materials = materials;
  desc.material_count = 2;
  desc.band_count = 1;
  desc.reflectance = reflectance;
  desc.exitance = exitance;

  hc_scene* scene;
  hc_form_factors* form_factors;
  check(hc_scene_create(&desc, &scene), "scene");
  check(hc_form_factors_create(scene, NULL, &form_factors), "form factors");

  uint64_t rows, nonzeros;
  hc_form_factors_get_size(form_factors, &rows, NULL, &nonzeros);
  uint64_t* row_offsets = malloc((size_t)(rows + 1) * sizeof *row_offsets);
  double* values = malloc((size_t)nonzeros * sizeof *values);
  if (row_offsets == NULL || values == NULL)
    return 1;
  check(
      hc_form_factors_get_csr(form_factors, rows, nonzeros, row_offsets, NULL, values, NULL, NULL),
      "rows");
  double worst = 0;
  for (uint64_t i = 0; i < rows; ++i) {
    double sum = 0;
    for (uint64_t k = row_offsets[i]; k < row_offsets[i + 1]; ++k)
      sum += values[k];
    worst = fabs(sum - 1) > worst ? fabs(sum - 1) : worst;
  }
  printf("%d patches, %d form factors, row sums within %.1e of 1\n", (int)rows, (int)nonzeros,
         worst);

  /* The light by these form factors. Handles keep what they need of each other. */
  hc_solution* solution;
  double radiosity[kPatches];
  hc_certificate certificate = {.struct_size = sizeof certificate};
  check(hc_solve(scene, form_factors, NULL, &solution), "light");
  hc_form_factors_release(form_factors);
  hc_scene_release(scene);
  check(hc_solution_get_values(solution, HC_RADIOSITY, kPatches, radiosity), "radiosity");
  check(hc_solution_get_certificate(solution, &certificate), "certificate");
  printf("floor below the light: %.6f W/m^2, wrong by about %.1e; hash %016llx\n",
         radiosity[4 * n * n + n + 1], certificate.radiosity_error,
         (unsigned long long)certificate.radiosity_hash);
  hc_solution_release(solution);
  free(values);
  free(row_offsets);
  return worst < 1e-6 ? 0 : 1;
}
