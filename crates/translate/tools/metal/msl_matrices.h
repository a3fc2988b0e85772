// Matrices: columns as in Metal, a column of three takes the room of four.
#pragma once

#include "msl_conversions.h"

#define MSL_MATRIX(T, C, R) \
struct T##C##x##R { \
  T##R column[C]; \
  T##C##x##R() = default; \
  template <class... A, class = typename only<sizeof...(A) == C>::type> T##C##x##R(const A&... a) : column{T##R(a)...} {} \
  T##R& operator[](int i) { return column[i]; } \
  const T##R& operator[](int i) const { return column[i]; } \
  friend T##R operator*(const T##C##x##R& m, T##C v) { T##R r = m.column[0] * v[0]; for (int i = 1; i < C; i++) r = r + m.column[i] * v[i]; return r; } \
  friend T##C operator*(T##R v, const T##C##x##R& m) { T##C r; for (int i = 0; i < C; i++) { T s = v[0] * m.column[i][0]; for (int j = 1; j < R; j++) s = s + v[j] * m.column[i][j]; r[i] = s; } return r; } \
  friend T##C##x##R operator*(const T##C##x##R& m, T s) { T##C##x##R r; for (int i = 0; i < C; i++) r.column[i] = m.column[i] * s; return r; } \
  friend T##C##x##R operator*(T s, const T##C##x##R& m) { return m * s; } \
  friend T##C##x##R operator+(const T##C##x##R& a, const T##C##x##R& b) { T##C##x##R r; for (int i = 0; i < C; i++) r.column[i] = a.column[i] + b.column[i]; return r; } \
  friend T##C##x##R operator-(const T##C##x##R& a, const T##C##x##R& b) { T##C##x##R r; for (int i = 0; i < C; i++) r.column[i] = a.column[i] - b.column[i]; return r; } \
};
#define MSL_TRANSPOSE(T, C, R) inline T##R##x##C transpose(const T##C##x##R& m) { T##R##x##C r; for (int i = 0; i < R; i++) for (int j = 0; j < C; j++) r[i][j] = m[j][i]; return r; }
#define MSL_PRODUCT(T, I, R, C) inline T##C##x##R operator*(const T##I##x##R& a, const T##C##x##I& b) { T##C##x##R r; for (int i = 0; i < C; i++) r[i] = a * b[i]; return r; }
#define MSL_SIZES(M, T) M(T, 2, 2) M(T, 2, 3) M(T, 2, 4) M(T, 3, 2) M(T, 3, 3) M(T, 3, 4) M(T, 4, 2) M(T, 4, 3) M(T, 4, 4)
#define MSL_PRODUCTS(T) \
  MSL_PRODUCT(T, 2, 2, 2) MSL_PRODUCT(T, 2, 2, 3) MSL_PRODUCT(T, 2, 2, 4) MSL_PRODUCT(T, 2, 3, 2) MSL_PRODUCT(T, 2, 3, 3) MSL_PRODUCT(T, 2, 3, 4) MSL_PRODUCT(T, 2, 4, 2) MSL_PRODUCT(T, 2, 4, 3) MSL_PRODUCT(T, 2, 4, 4) \
  MSL_PRODUCT(T, 3, 2, 2) MSL_PRODUCT(T, 3, 2, 3) MSL_PRODUCT(T, 3, 2, 4) MSL_PRODUCT(T, 3, 3, 2) MSL_PRODUCT(T, 3, 3, 3) MSL_PRODUCT(T, 3, 3, 4) MSL_PRODUCT(T, 3, 4, 2) MSL_PRODUCT(T, 3, 4, 3) MSL_PRODUCT(T, 3, 4, 4) \
  MSL_PRODUCT(T, 4, 2, 2) MSL_PRODUCT(T, 4, 2, 3) MSL_PRODUCT(T, 4, 2, 4) MSL_PRODUCT(T, 4, 3, 2) MSL_PRODUCT(T, 4, 3, 3) MSL_PRODUCT(T, 4, 3, 4) MSL_PRODUCT(T, 4, 4, 2) MSL_PRODUCT(T, 4, 4, 3) MSL_PRODUCT(T, 4, 4, 4)
MSL_SIZES(MSL_MATRIX, float) MSL_SIZES(MSL_MATRIX, half)
MSL_PRODUCTS(float) MSL_PRODUCTS(half)
