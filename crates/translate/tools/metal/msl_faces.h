// Faces of a cube: which one a direction meets and where, and what lies beyond their edges.
#pragma once

#include "msl_texels.h"

namespace msl {
struct on_face { uint face; double s, t; };
inline on_face face_of(double x, double y, double z) {
  double ax = __builtin_fabs(x), ay = __builtin_fabs(y), az = __builtin_fabs(z);
  if (az >= ax && az >= ay) return z < 0 ? on_face{5, 0.5 * (-x / az + 1), 0.5 * (-y / az + 1)} : on_face{4, 0.5 * (x / az + 1), 0.5 * (-y / az + 1)};
  if (ay >= ax) return y < 0 ? on_face{3, 0.5 * (x / ay + 1), 0.5 * (-z / ay + 1)} : on_face{2, 0.5 * (x / ay + 1), 0.5 * (z / ay + 1)};
  return x < 0 ? on_face{1, 0.5 * (z / ax + 1), 0.5 * (-y / ax + 1)} : on_face{0, 0.5 * (-z / ax + 1), 0.5 * (-y / ax + 1)};
}
// The texel beyond an edge of a face is the one on the neighbouring face that the direction through its centre meets.
inline texel4 beyond(const reading& r, uint level, uint first, uint face, int i, int j, int n) {
  double s = 2 * (i + 0.5) / n - 1, t = 2 * (j + 0.5) / n - 1;
  double d[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
  on_face f = face_of(d[face][0], d[face][1], d[face][2]);
  return r.texel(level, first + f.face, wrap((long)__builtin_floor(f.s * n), n, 0), wrap((long)__builtin_floor(f.t * n), n, 0));
}
inline texel4 cube_texel(const reading& r, uint level, uint slice, int i, int j, int n) {
  bool in_x = i >= 0 && i < n, in_y = j >= 0 && j < n;
  uint face = slice % 6, first = slice - face;
  if (in_x && in_y) return r.texel(level, slice, i, j);
  if (in_x != in_y) return beyond(r, level, first, face, i, j, n);
  int ci = wrap(i, n, 0), cj = wrap(j, n, 0);
  texel4 a = r.texel(level, slice, ci, cj), b = beyond(r, level, first, face, i, cj, n), c = beyond(r, level, first, face, ci, j, n), m;
  for (int k = 0; k < 4; k++) m.at[k] = (a.at[k] + b.at[k] + c.at[k]) / 3;
  return m;
}
} // namespace msl
