#include "avi/diagnostics/order.hpp"

#include "avi/core/require.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace avi {

OrderFit fit_order(std::span<const double> h, std::span<const double> error, OrderOptions options) {
  require(h.size() == error.size(), "Number of errors", error.size(), "the number of step sizes");
  require(options.at_least >= 2, "Least number of points", options.at_least, "at least 2");
  require(options.at_most >= 1, "Largest number of points", options.at_most, "at least 1");
  std::vector<std::pair<double, double>> all, kept;
  for (std::size_t i = 0; i < h.size(); ++i) {
    require(std::isfinite(h[i]) && h[i] != 0.0, "Step size h", h[i], "finite and not zero");
    all.emplace_back(std::log(std::abs(h[i])), error[i]);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 1; i < all.size(); ++i)
    require(all[i].first < all[i - 1].first, "Second step size of one length",
            std::abs(*std::ranges::find(
                h, all[i].first, [](double x) { return std::log(std::abs(x)); })),
            "different from the others");
  double steepest = 0.0;
  for (const auto& [x, value] : all) {
    if (!std::isfinite(value) && kept.empty()) continue;
    if (!(std::isfinite(value) && value > options.floor && value > 0.0)) break;
    const double y = std::log(value);
    if (!kept.empty()) {
      const double slope = (y - kept.back().second) / (x - kept.back().first);
      if (slope < 0.5 * steepest || slope <= 0.0) break;
      steepest = std::max(steepest, slope);
    }
    kept.emplace_back(x, y);
  }
  if (kept.size() > static_cast<std::size_t>(options.at_most))
    kept.erase(kept.begin(), kept.end() - options.at_most);
  OrderFit fit{.points = static_cast<int>(kept.size())};
  if (fit.points < options.at_least) return fit;
  const double n = fit.points;
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [x, y] : kept)
    mean_x += x / n, mean_y += y / n;
  for (const auto& [x, y] : kept)
    xx += (x - mean_x) * (x - mean_x), xy += (x - mean_x) * (y - mean_y);
  fit.order = xy / xx;
  return fit;
}

}  // namespace avi
