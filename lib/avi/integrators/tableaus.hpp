#pragma once
#include <array>
#include <string_view>

/// @file
/// Explicit Runge-Kutta tableaus: \f$k_i = F(z_0 + h \sum_{j<i} a_{ij} k_j)\f$, \f$z_1 = z_0 + h \sum_i b_i
/// k_i\f$ with \f$i = 1, \ldots, s\f$. The nodes are \f$c_i = \sum_j a_{ij}\f$. For a pair, `embedded` are
/// the weights of the solution of the other order. `name` is that in data files.

namespace avi {

/// Euler's method, order 1.
struct ExplicitEuler {
  static constexpr std::string_view name = "euler";  ///< In data files.
  static constexpr int stages = 1;                   ///< s.
  static constexpr int order = 1;                    ///< With the weights b.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 1>, 1> a{{{0.0}}};
  /// b_i.
  static constexpr std::array<double, 1> b{1.0};
};

/// The classical method of order 4 (Kutta 1901).
struct ClassicalRungeKutta {
  static constexpr std::string_view name = "rk4";  ///< In data files.
  static constexpr int stages = 4;                 ///< s.
  static constexpr int order = 4;                  ///< With the weights b.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 4>, 4> a{{{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}};
  /// b_i.
  static constexpr std::array<double, 4> b{1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
};

/// Bogacki and Shampine's pair 3(2) (1989), which MATLAB's ode23 uses; the last stage is the next first.
struct BogackiShampine {
  static constexpr std::string_view name = "bogacki_shampine32";  ///< In data files.
  static constexpr int stages = 4;                                ///< s.
  static constexpr int order = 3;                                 ///< With the weights b.
  static constexpr int embedded_order = 2;                        ///< With the embedded weights.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 4>, 4> a{
      {{}, {1.0 / 2.0}, {0.0, 3.0 / 4.0}, {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0}}};
  /// b_i.
  static constexpr std::array<double, 4> b{2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0};
  /// The weights of the other order.
  static constexpr std::array<double, 4> embedded{7.0 / 24.0, 1.0 / 4.0, 1.0 / 3.0, 1.0 / 8.0};
};

/// Dormand and Prince's pair 5(4) (1980), which MATLAB's ode45 uses; the last stage is the next first.
struct DormandPrince {
  static constexpr std::string_view name = "dormand_prince54";  ///< In data files.
  static constexpr int stages = 7;                              ///< s.
  static constexpr int order = 5;                               ///< With the weights b.
  static constexpr int embedded_order = 4;                      ///< With the embedded weights.
  /// a_ij, by rows.
  static constexpr std::array<std::array<double, 7>, 7> a{
      {{},
       {1.0 / 5.0},
       {3.0 / 40.0, 9.0 / 40.0},
       {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
       {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
       {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
       {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}}};
  /// b_i.
  static constexpr std::array<double, 7> b{35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0,
                                           11.0 / 84.0,  0.0};
  /// The weights of the other order.
  static constexpr std::array<double, 7> embedded{
      5179.0 / 57600.0, 0.0,       7571.0 / 16695.0, 393.0 / 640.0, -92097.0 / 339200.0,
      187.0 / 2100.0,   1.0 / 40.0};
};

}  // namespace avi
