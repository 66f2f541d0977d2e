#pragma once
#include "avi/autodiff/operation.hpp"
#include "avi/autodiff/pack.hpp"
#include "src/autodiff/machine_code.hpp"

#include <array>

/// @file
/// The functions that machine code calls.

namespace avi::detail {

/// Operations on packs of w numbers, as functions for MachineCode to call.
template <int w>
const PackFunction* pack_functions() {
  static const auto all = [] {
    std::array<PackFunction, static_cast<std::size_t>(Operation::sum_of_products)> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const auto operation = static_cast<Operation>(i);
      if (operands(operation) > 0 && operation != Operation::nothing && operation != Operation::subtract_from)
        with_operation(operation, [&]<Operation known>() {
          table[i] = [](double* a, const double* b) {
            auto& x = *reinterpret_cast<Pack<w>*>(a);
            x = apply<known>(x, *reinterpret_cast<const Pack<w>*>(b));
          };
        });
    }
    return table;
  }();
  return all.data();
}

}  // namespace avi::detail
