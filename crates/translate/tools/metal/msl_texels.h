// Texels: where an address is beyond an edge, what a comparison gives, and reading one.
#pragma once

#include "msl_interface.h"
#include "msl_traits.h"

namespace msl {
struct texel4 { double at[4]; };
inline int wrap(long i, int n, uint mode) {
  if (mode == 0) return i < 0 ? 0 : i >= n ? n - 1 : (int)i;
  if (mode == 1) { i %= n; return (int)(i < 0 ? i + n : i); }
  i %= 2l * n; if (i < 0) i += 2l * n; return (int)(i < n ? i : 2l * n - 1 - i);
}
inline bool compares(uint function, float reference, float kept) {
  switch (function) {
    case 1: return reference < kept;
    case 2: return reference == kept;
    case 3: return reference <= kept;
    case 4: return reference > kept;
    case 5: return reference != kept;
    case 6: return reference >= kept;
    case 7: return true;
    default: return false;
  }
}
inline uint at_level(uint size, uint level) { uint s = size >> level; return s ? s : 1; }
// One reading of a texture: from which slice, compared with what.
struct reading {
  const msl_texture* texture;
  const msl_sampler* sampler;
  uint slice;           // of a plane, a face of a cube
  bool is_cube, is_volume, compared;
  float reference;
  int offset[3];
  texel4 texel(uint level, uint slice, int x, int y) const {
    uint w = at_level(texture->width, level), h = at_level(texture->height, level);
    const float* p = texture->level[level] + 4ul * (((unsigned long)slice * h + y) * w + x);
    if (compared) return {{compares(sampler->compare, reference, p[0]) ? 1.0 : 0.0, 0, 0, 0}};
    return {{p[0], p[1], p[2], p[3]}};
  }
};
} // namespace msl
