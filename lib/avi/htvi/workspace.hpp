#pragma once
#include "avi/core/slopes.hpp"

#include <array>
#include <type_traits>
#include <vector>

/// @file
/// Storage of an expansion: on the stack where the dimension is known to the compiler, else allocated once.

namespace avi {

/// n objects.
template <class T, int n>
using Many = std::conditional_t<n == dynamic, std::vector<T>, std::array<T, n == dynamic ? 0 : n>>;

/// n = `size` objects.
template <class T, int n>
Many<T, n> many(int size) {
  if constexpr (n == dynamic)
    return Many<T, n>(static_cast<std::size_t>(size));
  else
    return {};
}

/// What the field of a problem is evaluated with, at scalar S.
template <class S, int n>
struct FieldArguments {
  Vector<S, n> q;   ///< Position.
  Vector<S, n> p;   ///< Momentum.
  Vector<S, n> dq;  ///< q'.
  Vector<S, n> dp;  ///< -p', as Poincare::field() gives it.
  Room<S, n> room;  ///< For the gradients of H and g.
  /// Vectors of `size` entries each.
  explicit FieldArguments(int size)
      : q(Vector<S, n>(size)), p(Vector<S, n>(size)), dq(Vector<S, n>(size)), dp(Vector<S, n>(size)),
        room(size) {}
};

/// Hands out FieldArguments: new ones where n is known to the compiler, which then keeps them in registers.
template <class S, int n>
class Workspace {
 public:
  explicit Workspace(int) {}  ///< Keeps nothing.
  /// New arguments of n entries.
  FieldArguments<S, n> at() { return FieldArguments<S, n>(n); }
};

/// Hands out the same FieldArguments each time.
template <class S>
class Workspace<S, dynamic> {
 public:
  explicit Workspace(int size) : kept_(size) {}  ///< Allocates vectors of `size` entries.
  /// The arguments kept.
  FieldArguments<S, dynamic>& at() { return kept_; }

 private:
  FieldArguments<S, dynamic> kept_;
};

}  // namespace avi
