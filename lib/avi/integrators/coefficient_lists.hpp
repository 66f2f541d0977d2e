#pragma once
#include "avi/core/require.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <numeric>
#include <string_view>

/// @file
/// Coefficient lists for methods that alternate two exact flows, including published ones. A test verifies
/// the order of each from the order conditions.

namespace avi {

/// Lengths of flows, as fractions of a step: a list of at most 36 numbers, stored without allocation.
template <class Number>
class Lengths {
 public:
  static constexpr std::size_t most = 36;  ///< Number of drifts in the longest list, sofroniou_spaletta10.

  /// A list of `count` zeros.
  /// @throws std::invalid_argument for more than 36.
  constexpr explicit Lengths(std::size_t count) : size_(count) {
    require(count <= most, "Length of a list of coefficients", count, "at most 36");
  }
  /// The same numbers, rounded to this type.
  template <class Other>
  constexpr explicit Lengths(const Lengths<Other>& other) : Lengths(other.size()) {
    std::transform(other.begin(), other.end(), values_.begin(),
                   [](Other x) { return static_cast<Number>(x); });
  }

  [[nodiscard]] constexpr std::size_t size() const { return size_; }              ///< Number of entries.
  constexpr Number& operator[](std::size_t i) { return values_[i]; }              ///< Entry i.
  constexpr const Number& operator[](std::size_t i) const { return values_[i]; }  ///< Entry i.
  [[nodiscard]] constexpr const Number* begin() const { return values_.data(); }  ///< First entry.
  /// Past the last entry.
  [[nodiscard]] constexpr const Number* end() const { return values_.data() + size_; }
  [[nodiscard]] constexpr const Number& back() const { return values_[size_ - 1]; }  ///< Last entry.

  /// Checks that the list is a palindrome and that its entries add up to one step. @param what name of the
  /// list for the message
  /// @throws std::invalid_argument unless the list is symmetric and its sum is 1 to the rounding of a double.
  void validate(std::string_view what) const {
    require(std::equal(begin(), end(), std::make_reverse_iterator(end())), what, "not symmetric",
            "the same read backwards");
    const auto sum = static_cast<double>(std::accumulate(begin(), end(), Number{}));
    require(std::abs(sum - 1.0) < 1e-12, what, sum, "1 in sum");
  }

 private:
  std::array<Number, most> values_{};
  std::size_t size_;
};

/// Coefficients of one step \f$A(a_0 h)\, B(b_0 h)\, A(a_1 h) \cdots B(b_{m-1} h)\, A(a_m h)\f$, applied from
/// left to right, where A is the drift and B the kick. They are in extended precision, so that a test can
/// distinguish a wrong digit from rounding.
struct SplitCoefficients {
  int order;               ///< Order of the method.
  Lengths<long double> a;  ///< Lengths of the m + 1 drifts, with sum 1.
  Lengths<long double> b;  ///< Lengths of the m kicks, with sum 1.
};

/// Coefficients of a symmetric composition \f$S(c_1 h)\, S(c_2 h) \cdots S(c_m h)\f$ of a symmetric step S of
/// order 2.
struct CompositionCoefficients {
  int order;               ///< Order of the composition.
  Lengths<long double> c;  ///< Lengths of the m steps, with sum 1.
};

/// Coefficients of the composition of S(h) = A(h/2) B(h) A(h/2), with neighbouring drifts merged.
constexpr SplitCoefficients split(const CompositionCoefficients& composition) {
  const auto& c = composition.c;
  SplitCoefficients merged{composition.order, Lengths<long double>(c.size() + 1), c};
  for (std::size_t i = 0; i < c.size(); ++i) {
    merged.a[i] += 0.5L * c[i];
    merged.a[i + 1] += 0.5L * c[i];
  }
  return merged;
}

/// Builds a palindrome from the entries before its middle one; the middle entry makes the sum 1.
constexpr CompositionCoefficients palindrome(int order, std::initializer_list<long double> outer) {
  CompositionCoefficients whole{order, Lengths<long double>(2 * outer.size() + 1)};
  long double rest = 1.0L;
  std::size_t i = 0;
  for (const long double length : outer) {
    whole.c[i] = whole.c[whole.c.size() - 1 - i] = length;
    rest -= 2.0L * length;
    ++i;
  }
  whole.c[i] = rest;
  return whole;
}

/// Builds a symmetric list A B A ... B A with an even number of kicks from its outer entries; the middle
/// drift and the two middle kicks make both sums 1.
constexpr SplitCoefficients palindrome(int order, std::initializer_list<long double> drifts,
                                       std::initializer_list<long double> kicks) {
  const CompositionCoefficients a = palindrome(order, drifts);
  SplitCoefficients whole{order, a.c, Lengths<long double>(2 * drifts.size())};
  long double rest = 0.5L;
  std::size_t i = 0;
  for (const long double length : kicks) {
    whole.b[i] = whole.b[whole.b.size() - 1 - i] = length;
    rest -= length;
    ++i;
  }
  whole.b[i] = whole.b[i + 1] = rest;
  return whole;
}

}  // namespace avi

namespace avi::compositions {

/// The base step itself, order 2.
inline constexpr auto strang = palindrome(2, {});

/// The triple jump of order 4: outer steps 1 / (2 - 2^(1/3)) (Forest and Ruth 1990; Suzuki 1990; Yoshida
/// 1990).
inline constexpr auto yoshida4 = palindrome(4, {1.35120719195965763404768780897146L});

/// Five steps of order 4: outer steps 1 / (4 - 4^(1/3)), all forwards except the middle one (Suzuki 1990).
inline constexpr auto suzuki4 =
    palindrome(4, {0.414490771794375737142354062860761L, 0.414490771794375737142354062860761L});

/// Seven steps of order 6, solution A (Yoshida 1990).
inline constexpr auto yoshida6 = palindrome(
    6, {0.78451361047755726381949763L, 0.23557321335935813368479318L, -1.17767998417887100694641568L});

/// Nine steps of order 6 (Kahan and Li 1997).
inline constexpr auto kahan_li6 =
    palindrome(6, {0.39216144400731413927925056L, 0.33259913678935943859974864L,
                   -0.70624617255763935980996482L, 0.08221359629355080023149045L});

/// Seventeen steps of order 8 (Kahan and Li 1997).
inline constexpr auto kahan_li8 = palindrome(
    8, {0.13020248308889008087881763L, 0.56116298177510838456196441L, -0.38947496264484728640807860L,
        0.15884190655515560089621075L, -0.39590389413323757733623154L, 0.18453964097831570709183254L,
        0.25837438768632204729397911L, 0.29501172360931029887096624L});

/// Thirty-five steps of order 10 (Sofroniou and Spaletta 2005).
inline constexpr auto sofroniou_spaletta10 = palindrome(
    10, {0.07879572252168641926390768L, 0.31309610341510852776481247L, 0.02791838323507806610952027L,
         -0.22959284159390709415121340L, 0.13096206107716486317465686L, -0.26973340565451071434460973L,
         0.07497334315589143566613711L, 0.11199342399981020488957508L, 0.36613344954622675119314812L,
         -0.39910563013603589787862981L, 0.10308739852747107731580277L, 0.41143087395589023782070412L,
         -0.00486636058313526176219566L, -0.39203335370863990644808194L, 0.05194250296244964703718290L,
         0.05066509075992449633587434L, 0.04967437063972987905456880L});

}  // namespace avi::compositions

namespace avi::splittings {

/// Six kicks of order 4, S6 (Blanes and Moan, Practical symplectic partitioned Runge-Kutta and
/// Runge-Kutta-Nystrom methods, 2002).
inline constexpr auto blanes_moan4 =
    palindrome(4, {0.0792036964311957L, 0.353172906049774L, -0.0420650803577195L},
               {0.209515106613362L, -0.143851773179818L});

/// Ten kicks of order 6, S10 (Blanes and Moan 2002).
inline constexpr auto blanes_moan6 = palindrome(
    6,
    {0.0502627644003922L, 0.413514300428344L, 0.0450798897943977L, -0.188054853819569L, 0.541960678450780L},
    {0.148816447901042L, -0.132385865767784L, 0.067307604692185L, 0.432666402578175L});

/// Fourteen kicks of order 6, SRKN14a (Blanes and Moan 2002). It has this order only if the kinetic energy is
/// quadratic in p (Runge-Kutta-Nystrom); otherwise its order is 4 at most.
inline constexpr auto blanes_moan6_nystrom =
    palindrome(6,
               {0.0378593198406116L, 0.102635633102435L, -0.0258678882665587L, 0.314241403071447L,
                -0.130144459517415L, 0.106417700369543L, -0.00879424312851058L},
               {0.09171915262446165L, 0.183983170005006L, -0.05653436583288827L, 0.004914688774712854L,
                0.143761127168358L, 0.328567693746804L});

}  // namespace avi::splittings
