#pragma once

/// Derivative of f at 0 by differences of fourth order, h apart.
double difference(const auto& f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}
