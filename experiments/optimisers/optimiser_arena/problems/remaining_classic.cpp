#include "optimisers/optimiser_arena/problems/problem.hpp"

#include "avi/optim/recorded_objective.hpp"

#include <memory>

// More, Garbow and Hillstrom's problems (1981) that classic.cpp lacks and that need no table of measured
// numbers, the linear ones apart; 10 dimensions where it is free, 6 for Watson's. Their gradients are
// automatic.

namespace arena {

namespace {

template <avi::Formula F>
Problem formula(std::string name, VectorX x0, const F& f) {
  const auto recorded = std::make_shared<avi::RecordedObjective>(f, x0.size());
  return {.name = std::move(name),
          .kind = "classic",
          .x0 = std::move(x0),
          .f = [recorded](const VectorX& x, VectorX& g) { return (*recorded)(x, g); }};
}

auto square(const auto& r) { return r * r; }

Problem freudenstein_roth() {
  return formula("freudenstein_roth", Eigen::Vector2d(0.5, -2.0), [](const auto& x) {
    return square(-13.0 + x[0] + ((5.0 - x[1]) * x[1] - 2.0) * x[1]) +
           square(-29.0 + x[0] + ((x[1] + 1.0) * x[1] - 14.0) * x[1]);
  });
}

Problem powell_badly_scaled() {
  return formula("powell_badly_scaled", Eigen::Vector2d(0.0, 1.0), [](const auto& x) {
    return square(1e4 * x[0] * x[1] - 1.0) + square(exp(-x[0]) + exp(-x[1]) - 1.0001);
  });
}

Problem jennrich_sampson() {
  return formula("jennrich_sampson", Eigen::Vector2d(0.3, 0.4), [](const auto& x) {
    auto f = x[0] * 0.0;
    for (int i = 1; i <= 10; ++i)
      f += square(2.0 + 2.0 * i - exp(i * 1.0 * x[0]) - exp(i * 1.0 * x[1]));
    return f;
  });
}

Problem gulf() {
  return formula("gulf", Eigen::Vector3d(5.0, 2.5, 0.15), [](const auto& x) {
    auto f = x[0] * 0.0;
    for (int i = 1; i <= 99; ++i) {
      const double t = 0.01 * i, y = 25.0 + std::cbrt(square(-50.0 * std::log(t)));
      f += square(exp(-exp(x[2] * log(abs(y - x[1]))) / x[0]) - t);
    }
    return f;
  });
}

Problem box() {
  return formula("box", Eigen::Vector3d(0.0, 10.0, 20.0), [](const auto& x) {
    auto f = x[0] * 0.0;
    for (int i = 1; i <= 10; ++i) {
      const double t = 0.1 * i;
      f += square(exp(-t * x[0]) - exp(-t * x[1]) - (std::exp(-t) - std::exp(-10.0 * t)) * x[2]);
    }
    return f;
  });
}

Problem brown_dennis() {
  return formula("brown_dennis", Eigen::Vector4d(25.0, 5.0, -5.0, -1.0), [](const auto& x) {
    auto f = x[0] * 0.0;
    for (int i = 1; i <= 20; ++i) {
      const double t = 0.2 * i;
      f += square(square(x[0] + t * x[1] - std::exp(t)) + square(x[2] + std::sin(t) * x[3] - std::cos(t)));
    }
    return f;
  });
}

Problem watson(Eigen::Index n) {
  return formula("watson", VectorX::Zero(n), [](const auto& x) {
    auto f = square(x[0]) + square(x[1] - x[0] * x[0] - 1.0);
    for (int i = 1; i <= 29; ++i) {
      const double t = i / 29.0;
      auto sum = x[x.size() - 1] * 1.0, slope = x[x.size() - 1] * static_cast<double>(x.size() - 1);
      for (Eigen::Index j = x.size() - 1; j-- > 0;) {
        sum = sum * t + x[j];
        if (j > 0) slope = slope * t + x[j] * static_cast<double>(j);
      }
      f += square(slope - sum * sum - 1.0);
    }
    return f;
  });
}

Problem penalty_2(Eigen::Index n) {
  return formula("penalty_2", VectorX::Constant(n, 0.5), [](const auto& x) {
    const Eigen::Index size = x.size();
    auto f = square(x[0] - 0.2), weighed = x[0] * x[0] * static_cast<double>(size);
    for (Eigen::Index i = 1; i < size; ++i) {
      const double k = static_cast<double>(i + 1);
      const auto now = exp(x[i] * 0.1);
      f += 1e-5 * square(now + exp(x[i - 1] * 0.1) - std::exp(0.1 * k) - std::exp(0.1 * (k - 1.0)));
      f += 1e-5 * square(now - std::exp(-0.1));
      weighed += x[i] * x[i] * static_cast<double>(size - i);
    }
    return f + square(weighed - 1.0);
  });
}

Problem brown_almost_linear(Eigen::Index n) {
  return formula("brown_almost_linear", VectorX::Constant(n, 0.5), [](const auto& x) {
    const Eigen::Index size = x.size();
    auto sum = x[0] * 1.0, product = x[0] * 1.0;
    for (Eigen::Index i = 1; i < size; ++i)
      sum += x[i], product = product * x[i];
    auto f = square(product - 1.0);
    for (Eigen::Index i = 0; i + 1 < size; ++i)
      f += square(x[i] + sum - static_cast<double>(size + 1));
    return f;
  });
}

double node(Eigen::Index i, Eigen::Index n) {
  return static_cast<double>(i + 1) / static_cast<double>(n + 1);
}

Problem integral_equation(Eigen::Index n) {
  VectorX x0(n);
  for (Eigen::Index i = 0; i < n; ++i)
    x0[i] = node(i, n) * (node(i, n) - 1.0);
  return formula("integral_equation", x0, [](const auto& x) {
    const Eigen::Index size = x.size();
    auto f = x[0] * 0.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      const double t = node(i, size), h = 1.0 / static_cast<double>(size + 1);
      auto r = x[i] * 1.0;
      for (Eigen::Index j = 0; j < size; ++j) {
        const double u = node(j, size), weight = j <= i ? (1.0 - t) * u : t * (1.0 - u);
        const auto c = x[j] + (u + 1.0);
        r += 0.5 * h * weight * c * c * c;
      }
      f += square(r);
    }
    return f;
  });
}

Problem broyden_banded(Eigen::Index n) {
  return formula("broyden_banded", VectorX::Constant(n, -1.0), [](const auto& x) {
    const Eigen::Index size = x.size();
    auto f = x[0] * 0.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      auto r = x[i] * (2.0 + 5.0 * x[i] * x[i]) + 1.0;
      for (Eigen::Index j = std::max<Eigen::Index>(0, i - 5); j <= std::min(size - 1, i + 1); ++j)
        if (j != i) r = r - x[j] * (1.0 + x[j]);
      f += square(r);
    }
    return f;
  });
}

}  // namespace

std::vector<Problem> remaining_classic_problems() {
  return {freudenstein_roth(),
          powell_badly_scaled(),
          jennrich_sampson(),
          gulf(),
          box(),
          brown_dennis(),
          watson(6),
          penalty_2(10),
          brown_almost_linear(10),
          integral_equation(10),
          broyden_banded(10)};
}

}  // namespace arena
