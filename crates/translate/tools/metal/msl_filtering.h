// Filtering is in double: exact weights, rounded once.
#pragma once

#include "msl_faces.h"

namespace msl {
struct axis { long cell; double weight; };
inline axis along(float u, uint n, int offset, bool linear) {
  double x = (double)u * n + offset - (linear ? 0.5 : 0.0), cell = __builtin_floor(x);
  if (!(__builtin_fabs(x) < 1e15)) return {0, 0};
  return {(long)cell, linear ? x - cell : 0};
}
inline texel4 filtered(const reading& r, const float* u, uint level, bool linear) {
  uint w = at_level(r.texture->width, level), h = at_level(r.texture->height, level), d = r.is_volume ? at_level(r.texture->depth, level) : 1;
  axis x = along(u[0], w, r.offset[0], linear), y = along(u[1], h, r.offset[1], linear), z = r.is_volume ? along(u[2], d, r.offset[2], linear) : axis{0, 0};
  texel4 sum = {{0, 0, 0, 0}};
  for (int k = 0; k < (z.weight > 0 ? 2 : 1); k++) for (int j = 0; j < (y.weight > 0 ? 2 : 1); j++) for (int i = 0; i < (x.weight > 0 ? 2 : 1); i++) {
    double weight = (i ? x.weight : 1 - x.weight) * (j ? y.weight : 1 - y.weight) * (k ? z.weight : 1 - z.weight);
    texel4 t;
    if (r.is_cube) t = cube_texel(r, level, r.slice, (int)x.cell + i, (int)y.cell + j, w);
    else {
      uint slice = r.is_volume ? wrap(z.cell + k, d, r.sampler->address[2]) : r.slice;
      t = r.texel(level, slice, wrap(x.cell + i, w, r.sampler->address[0]), wrap(y.cell + j, h, r.sampler->address[1]));
    }
    for (int c = 0; c < 4; c++) sum.at[c] += weight * t.at[c];
  }
  return sum;
}
inline texel4 sampled(const reading& r, const float* u, float lod) {
  const msl_sampler& s = *r.sampler;
  double l = lod < s.lod_min ? s.lod_min : lod > s.lod_max ? s.lod_max : lod, last = r.texture->levels - 1;
  if (!(l > 0)) return filtered(r, u, 0, s.mag);
  if (!s.mip) { double m = __builtin_floor(l + 0.5); return filtered(r, u, (uint)(m < last ? m : last), s.min); }
  if (l > last) l = last;
  uint low = (uint)l; double weight = l - low;
  texel4 a = filtered(r, u, low, s.min);
  if (weight == 0) return a;
  texel4 b = filtered(r, u, low + 1, s.min);
  for (int c = 0; c < 4; c++) a.at[c] = a.at[c] * (1 - weight) + b.at[c] * weight;
  return a;
}
} // namespace msl
