#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "flexura/core/pack2.hpp"

namespace flexura {

/// A number that carries its gradient and Hessian with respect to N variables: second-order
/// forward differentiation, fixed in size and eager, so that the compiler sees plain arithmetic. T
/// is double, or a Pack2 to differentiate at two points at once. The Hessian is packed by rows of
/// the lower triangle, entry (i, j) with i >= j at i(i+1)/2 + j.
template <std::size_t N, class T = double>
struct Jet2 {
  static constexpr std::size_t hessian_size = N * (N + 1) / 2;

  T value{};
  std::array<T, N> gradient{};
  std::array<T, hessian_size> hessian{};

  constexpr Jet2() = default;
  constexpr explicit Jet2(T constant) : value(constant) {}

  /// The k-th variable, at the given value.
  static constexpr Jet2 variable(std::size_t k, T at) {
    Jet2 jet(at);
    jet.gradient[k] += 1.0;
    return jet;
  }

  constexpr T second(std::size_t i, std::size_t j) const {
    return i >= j ? hessian[i * (i + 1) / 2 + j] : hessian[j * (j + 1) / 2 + i];
  }

  /// g(*this) by the chain rule, from g, g' and g'' at the value.
  constexpr Jet2 chain(T g, T g1, T g2) const {
    Jet2 out(g);
    std::size_t k = 0;
    for (std::size_t i = 0; i < N; ++i) {
      out.gradient[i] = g1 * gradient[i];
      for (std::size_t j = 0; j <= i; ++j, ++k)
        out.hessian[k] = g1 * hessian[k] + g2 * gradient[i] * gradient[j];
    }
    return out;
  }

  constexpr Jet2& operator+=(const Jet2& b) {
    value += b.value;
    for (std::size_t i = 0; i < N; ++i) gradient[i] += b.gradient[i];
    for (std::size_t k = 0; k < hessian_size; ++k) hessian[k] += b.hessian[k];
    return *this;
  }
  constexpr Jet2& operator*=(T b) {
    value *= b;
    for (T& g : gradient) g *= b;
    for (T& h : hessian) h *= b;
    return *this;
  }
};

template <std::size_t N, class T>
constexpr Jet2<N, T> operator+(Jet2<N, T> a, const Jet2<N, T>& b) {
  return a += b;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator+(Jet2<N, T> a, double b) {
  a.value += b;
  return a;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator+(double a, const Jet2<N, T>& b) {
  return b + a;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator*(Jet2<N, T> a, double b) {
  return a *= T{} + b;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator*(double a, Jet2<N, T> b) {
  return b *= T{} + a;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator-(Jet2<N, T> a) {
  return a *= T{} - 1.0;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator-(Jet2<N, T> a, const Jet2<N, T>& b) {
  a.value -= b.value;
  for (std::size_t i = 0; i < N; ++i) a.gradient[i] -= b.gradient[i];
  for (std::size_t k = 0; k < Jet2<N, T>::hessian_size; ++k) a.hessian[k] -= b.hessian[k];
  return a;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator-(Jet2<N, T> a, double b) {
  a.value -= b;
  return a;
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator-(double a, const Jet2<N, T>& b) {
  return -b + a;
}

template <std::size_t N, class T>
constexpr Jet2<N, T> operator*(const Jet2<N, T>& a, const Jet2<N, T>& b) {
  Jet2<N, T> out(a.value * b.value);
  std::size_t k = 0;
  for (std::size_t i = 0; i < N; ++i) {
    out.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
    for (std::size_t j = 0; j <= i; ++j, ++k)
      out.hessian[k] = a.hessian[k] * b.value + a.value * b.hessian[k] +
                       a.gradient[i] * b.gradient[j] + a.gradient[j] * b.gradient[i];
  }
  return out;
}

template <std::size_t N, class T>
constexpr Jet2<N, T> inverse(const Jet2<N, T>& a) {
  const T r = 1.0 / a.value;
  return a.chain(r, -r * r, 2.0 * r * r * r);
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator/(const Jet2<N, T>& a, const Jet2<N, T>& b) {
  return a * inverse(b);
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator/(const Jet2<N, T>& a, double b) {
  return a * (1.0 / b);
}
template <std::size_t N, class T>
constexpr Jet2<N, T> operator/(double a, const Jet2<N, T>& b) {
  return a * inverse(b);
}

template <std::size_t N, class T>
Jet2<N, T> sqrt(const Jet2<N, T>& a) {
  const T r = sqrt_of(a.value);
  return a.chain(r, 0.5 / r, -0.25 / (r * a.value));
}
template <std::size_t N, class T>
Jet2<N, T> log(const Jet2<N, T>& a) {
  const T r = 1.0 / a.value;
  return a.chain(std::log(a.value), r, -r * r);
}
template <std::size_t N, class T>
Jet2<N, T> sin(const Jet2<N, T>& a) {
  const T s = sin_of(a.value);
  return a.chain(s, cos_of(a.value), -s);
}
template <std::size_t N, class T>
Jet2<N, T> cos(const Jet2<N, T>& a) {
  const T c = cos_of(a.value);
  return a.chain(c, -sin_of(a.value), -c);
}

/// weight a^2/2.
template <std::size_t N, class T, class Weight>
constexpr Jet2<N, T> half_square(const Weight& weight, const Jet2<N, T>& a) {
  const T w = T{} + weight;
  const T slope = w * a.value;
  return a.chain(0.5 * slope * a.value, slope, w);
}

/// A vector's components in axes that are turned by an angle.
template <class Scalar>
struct TurnedComponents {
  Scalar along;   ///< x cos(angle) + y sin(angle)
  Scalar across;  ///< y cos(angle) - x sin(angle)
};

/// Both at once: each is the other's derivative by the angle, but for its sign, so the chain rule
/// takes half of what the sines, products and sums would.
template <std::size_t N, class T>
TurnedComponents<Jet2<N, T>> in_turned_axes(const Jet2<N, T>& angle, const Jet2<N, T>& x,
                                            const Jet2<N, T>& y) {
  const T c = cos_of(angle.value);
  const T s = sin_of(angle.value);
  TurnedComponents<Jet2<N, T>> turned{Jet2<N, T>(x.value * c + y.value * s),
                                      Jet2<N, T>(y.value * c - x.value * s)};
  auto& [u, v] = turned;
  std::size_t k = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const T by_angle = angle.gradient[i];
    const T p = x.gradient[i] * c + y.gradient[i] * s;
    const T q = y.gradient[i] * c - x.gradient[i] * s;
    u.gradient[i] = p + v.value * by_angle;
    v.gradient[i] = q - u.value * by_angle;
    for (std::size_t j = 0; j <= i; ++j, ++k) {
      u.hessian[k] = x.hessian[k] * c + y.hessian[k] * s + v.value * angle.hessian[k] +
                     by_angle * v.gradient[j] + q * angle.gradient[j];
      v.hessian[k] = y.hessian[k] * c - x.hessian[k] * s - u.value * angle.hessian[k] -
                     by_angle * u.gradient[j] - p * angle.gradient[j];
    }
  }
  return turned;
}

}  // namespace flexura
