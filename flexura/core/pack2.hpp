#pragma once

#include <cmath>

namespace flexura {

/// Two doubles that go through the same arithmetic: one instruction for both on every x86-64 and
/// ARM64, with the operators of the compiler's vector types.
using Pack2 = double __attribute__((vector_size(16)));

/// Functions of both scalars, under names that `using std::sin` does not hide.
inline double sin_of(double a) { return std::sin(a); }
inline double cos_of(double a) { return std::cos(a); }
inline double sqrt_of(double a) { return std::sqrt(a); }
inline Pack2 sin_of(Pack2 a) { return Pack2{std::sin(a[0]), std::sin(a[1])}; }
inline Pack2 cos_of(Pack2 a) { return Pack2{std::cos(a[0]), std::cos(a[1])}; }
inline Pack2 sqrt_of(Pack2 a) { return Pack2{std::sqrt(a[0]), std::sqrt(a[1])}; }

}  // namespace flexura
