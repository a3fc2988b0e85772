// Levels of detail.
#pragma once

#include "msl_faces.h"

namespace msl {
// Of a change along x and along y, in texels.
template <class V> inline float lod_of(const msl_texture* t, V dx, V dy) {
  double sizes[3] = {(double)t->width, (double)t->height, (double)t->depth}, a = 0, b = 0;
  for (int i = 0; i < size<V>; i++) { double x = sizes[i] * element(dx, i), y = sizes[i] * element(dy, i); a += x * x; b += y * y; }
  return (float)(0.5 * __builtin_log2(a > b ? a : b));
}
// Of a cube: the derivatives of the coordinates on the face of this direction.
inline float cube_lod(const msl_texture* t, float3 v, float3 dx, float3 dy) {
  on_face f = face_of(v.x, v.y, v.z);
  auto change = [&](float3 d) {
    int m = f.face / 2, si = m == 0 ? 2 : 0, ti = m == 1 ? 2 : 1;
    double major = v[m], s = (d[si] * major - v[si] * d[m]) / (major * major), q = (d[ti] * major - v[ti] * d[m]) / (major * major);
    s *= 0.5 * t->width; q *= 0.5 * t->width; return s * s + q * q;
  };
  double a = change(dx), b = change(dy);
  return (float)(0.5 * __builtin_log2(a > b ? a : b));
}
} // namespace msl
