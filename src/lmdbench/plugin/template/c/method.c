/* SPDX-License-Identifier: 0BSD */
/* METHOD_NAME: the nearest pair of vertices. Replace it; lmdbench_method.h has the contract. */
#include "lmdbench_method.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A vertex with a triangle that it is a corner of. */
typedef struct { double p[3]; int32_t triangle, corner; } site;
typedef struct { site *a, *b; uint64_t count_a, count_b; double cutoff; } state;

static site *sites_of(const lmdbench_mesh *mesh, uint64_t *count) {
  site *sites = malloc((mesh->vertex_count + 1) * sizeof *sites);
  char *seen = calloc(mesh->vertex_count + 1, 1);
  *count = 0;
  if (sites && seen)
    for (uint64_t i = 0; i < 3 * mesh->triangle_count; ++i) {
      const int32_t v = mesh->triangles[i];
      if (seen[v]) continue;
      seen[v] = 1;
      memcpy(sites[*count].p, mesh->vertices + 3 * v, sizeof sites->p);
      sites[*count].triangle = (int32_t)(i / 3);
      sites[(*count)++].corner = (int32_t)(i % 3);
    }
  free(seen);
  return sites;
}

static void destroy(void *instance) {
  state *s = instance;
  if (!s) return;
  free(s->a);
  free(s->b);
  free(s);
}

static int32_t create(const lmdbench_mesh *a, const lmdbench_mesh *b, double cutoff, const char *options,
                      void **instance, char *message, uint64_t message_size) {
  state *s = calloc(1, sizeof *s);
  (void)options; /* JSON text that holds every option of `options_schema` below */
  if (s) s->a = sites_of(a, &s->count_a), s->b = sites_of(b, &s->count_b), s->cutoff = cutoff;
  if (s && s->a && s->b) return *instance = s, 0;
  snprintf(message, message_size, "no memory for two meshes");
  destroy(s);
  return 1;
}

static int32_t search(void *instance, const double X[12], lmdbench_contact *contacts, uint64_t capacity,
                      uint64_t *needed) {
  const state *s = instance;
  double best = s->cutoff * s->cutoff;
  *needed = 0;
  for (uint64_t i = 0; i < s->count_a; ++i) {
    const double *v = s->a[i].p;
    double p[3];
    for (int r = 0; r < 3; ++r) p[r] = X[4 * r] * v[0] + X[4 * r + 1] * v[1] + X[4 * r + 2] * v[2] + X[4 * r + 3];
    for (uint64_t j = 0; j < s->count_b; ++j) {
      const double *q = s->b[j].p;
      const double d = (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]) + (q[2] - p[2]) * (q[2] - p[2]);
      if (d > best) continue;
      best = d;
      *needed = 1;
      if (capacity == 0) continue;
      memcpy(contacts[0].point_a, p, sizeof p);
      memcpy(contacts[0].point_b, q, sizeof p);
      contacts[0].triangle_a = s->a[i].triangle, contacts[0].part_a = LMDBENCH_CORNER_0 + s->a[i].corner;
      contacts[0].triangle_b = s->b[j].triangle, contacts[0].part_b = LMDBENCH_CORNER_0 + s->b[j].corner;
    }
  }
  return 0;
}

static const lmdbench_method METHOD = {
    sizeof(lmdbench_method), "METHOD_NAME", "0.1", "the nearest pair of vertices, each against each",
    LMDBENCH_PROMISE_APPROXIMATION, 0, NULL, create, search, destroy, NULL};

static const lmdbench_method *get(uint32_t index) { return index == 0 ? &METHOD : NULL; }

const lmdbench_method_entry_type lmdbench_method_entry = {LMDBENCH_METHOD_ABI_MAJOR, LMDBENCH_METHOD_ABI_MINOR,
                                                          sizeof(lmdbench_method_entry_type), get};
